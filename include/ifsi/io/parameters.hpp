#pragma once
/// \file
/// Parameters of a case: each is declared once, bound to a variable, with key, default, unit, range and help.

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ifsi {

/// Range a number has to lie in; an open end is itself excluded.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;
  bool open_max = false;
  [[nodiscard]] bool contain(double x) const {
    return (open_min ? x > min : x >= min) && (open_max ? x < max : x <= max);
  }
};
inline constexpr Bounds positive{0.0, std::numeric_limits<double>::infinity(), true};
inline constexpr Bounds non_negative{0.0};

/// Registry of the keys of a case. Keys are dotted ("time.dt") and written as such or as tables in TOML.
///
/// A file may hold named sets of values, `[presets.fine]`, of which the key `preset = "fine"` picks one; the
/// values of the preset win over the rest of the file. All errors are ifsi::Error with
/// ExitCode::configuration, naming the origin (file:line or command line), the value, and what was expected.
class Parameters {
 public:
  using Value = std::variant<bool, long, double, std::string, std::vector<double>>;

  Parameters() = default;
  Parameters(const Parameters&) = delete;  // the entries point to variables, one of them its own
  Parameters& operator=(const Parameters&) = delete;

  /// Declares a key; the present value of `variable` is the default. T is bool, int, long, double,
  /// std::string or std::vector<double> (bounds hold for each entry).
  template <class T>
  void add(std::string key, T& variable, std::string unit, std::string help, Bounds bounds = {}) {
    declare({std::move(key), &variable, std::move(unit), std::move(help), bounds, {}});
  }
  /// Declares a key whose value is one of a few words.
  void add_choice(std::string key, std::string& variable, std::vector<std::string> allowed, std::string help);

  /// Reads a TOML file and sets its keys (its preset, if any, waits for apply_preset).
  void read_toml(const std::string& file);
  /// Sets one key from "key=value", as given on the command line.
  void set(const std::string& assignment, const std::string& origin = "--set");
  /// Sets the values of the preset the key `preset` names; does nothing when the file had no presets.
  void apply_preset();
  /// What a run does: file (may be empty), then its preset, then the assignments of the command line.
  void load(const std::string& file, const std::vector<std::string>& assignments);

  [[nodiscard]] bool has(const std::string& key) const { return find(key) != nullptr; }
  [[nodiscard]] std::vector<std::string> keys() const;
  [[nodiscard]] Value value(const std::string& key) const;
  /// Table of all keys: key, default (the present value), unit, range, help.
  [[nodiscard]] std::string table() const;
  /// The present values as TOML, with help as comments; read_toml of it gives the same values.
  [[nodiscard]] std::string to_toml() const;

 private:
  using Target = std::variant<bool*, int*, long*, double*, std::string*, std::vector<double>*>;
  struct Entry {
    std::string key;
    Target target;
    std::string unit, help;
    Bounds bounds;
    std::vector<std::string> allowed;
  };
  struct Assignment {
    std::string key;
    Value value;
    std::string origin;
  };

  void declare(Entry entry);
  void declare_preset(const std::string& file);
  [[nodiscard]] const Entry* find(const std::string& key) const;
  [[nodiscard]] const Entry& require(const std::string& key, const std::string& origin) const;
  void assign(const Assignment& assignment);
  static Value read(const Target& target);

  std::vector<Entry> entries_;
  std::map<std::string, std::vector<Assignment>> presets_;
  std::string preset_ = "none";
};

}  // namespace ifsi
