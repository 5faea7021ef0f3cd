#include "ifsi/io/parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "ifsi/core/error.hpp"
#include "ifsi/core/suggestion.hpp"
#include "text.hpp"
#include "toml_file.hpp"

namespace ifsi {
namespace {

using detail::toml_value;

[[noreturn]] void fail(const std::string& message) { throw Error(ExitCode::configuration, message); }

const char* type_name(const bool*) { return "true or false"; }
const char* type_name(const int*) { return "an integer"; }
const char* type_name(const long*) { return "an integer"; }
const char* type_name(const double*) { return "a number"; }
const char* type_name(const std::string*) { return "a string"; }
const char* type_name(const std::vector<double>*) { return "a list of numbers [a, b, ...]"; }

std::string range_text(const Bounds& b, const std::vector<std::string>& allowed) {
  if (!allowed.empty()) return fmt::format("{}", fmt::join(allowed, " | "));
  const bool below = std::isfinite(b.min), above = std::isfinite(b.max);
  if (below && above)
    return fmt::format("{}{}, {}{}", b.open_min ? '(' : '[', b.min, b.max, b.open_max ? ')' : ']');
  if (below) return fmt::format("{} {}", b.open_min ? ">" : ">=", b.min);
  if (above) return fmt::format("{} {}", b.open_max ? "<" : "<=", b.max);
  return "";
}

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
  return s;
}

template <class T>
std::optional<T> number_from(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  T x{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return x;
}

std::optional<std::vector<double>> list_from(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']')
    text = trimmed(text.substr(1, text.size() - 2));
  std::vector<double> list;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto x = number_from<double>(text.substr(0, comma));
    if (!x) return std::nullopt;
    list.push_back(*x);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return list;
}

/// Reads command-line text as the type of its target; text of another type stays text, for assign to refuse.
struct FromText {
  std::string_view text;
  Parameters::Value operator()(const bool*) const {
    if (text == "true" || text == "false") return text == "true";
    return std::string(text);
  }
  Parameters::Value operator()(const int*) const { return or_text(number_from<long>(text)); }
  Parameters::Value operator()(const long*) const { return or_text(number_from<long>(text)); }
  Parameters::Value operator()(const double*) const { return or_text(number_from<double>(text)); }
  Parameters::Value operator()(const std::vector<double>*) const { return or_text(list_from(text)); }
  Parameters::Value operator()(const std::string*) const {
    const bool in_quotes = text.size() >= 2 && text.front() == '"' && text.back() == '"';
    return std::string(in_quotes ? text.substr(1, text.size() - 2) : text);
  }

 private:
  template <class T>
  Parameters::Value or_text(const std::optional<T>& x) const {
    if (x) return *x;
    return std::string(text);
  }
};

/// Stores a value in a variable when the types agree (an integer is a number too) and it fits.
struct Store {
  const Parameters::Value& value;
  bool operator()(bool* x) const { return exact(x); }
  bool operator()(long* x) const { return exact(x); }
  bool operator()(std::string* x) const { return exact(x); }
  bool operator()(std::vector<double>* x) const { return exact(x); }
  bool operator()(int* x) const {
    const long* i = std::get_if<long>(&value);
    if (i == nullptr || static_cast<int>(*i) != *i) return false;
    *x = static_cast<int>(*i);
    return true;
  }
  bool operator()(double* x) const {
    if (const long* i = std::get_if<long>(&value)) return *x = static_cast<double>(*i), true;
    return exact(x);
  }

 private:
  template <class T>
  bool exact(T* x) const {
    const T* same = std::get_if<T>(&value);
    if (same != nullptr) *x = *same;
    return same != nullptr;
  }
};

struct InBounds {
  const Bounds& bounds;
  bool operator()(bool) const { return true; }
  bool operator()(const std::string&) const { return true; }
  bool operator()(long i) const { return bounds.contain(static_cast<double>(i)); }
  bool operator()(double x) const { return std::isfinite(x) && bounds.contain(x); }
  bool operator()(const std::vector<double>& list) const {
    return std::all_of(list.begin(), list.end(), *this);
  }
};

std::string joined(const std::vector<std::string>& path, std::size_t first) {
  return fmt::format("{}", fmt::join(path.begin() + static_cast<long>(first), path.end(), "."));
}

}  // namespace

void Parameters::add_choice(std::string key, std::string& variable, std::vector<std::string> allowed,
                            std::string help) {
  declare({std::move(key), &variable, "-", std::move(help), {}, std::move(allowed)});
}

void Parameters::declare(Entry entry) {
  if (has(entry.key)) throw std::logic_error("parameter '" + entry.key + "' is declared twice");
  entries_.push_back(std::move(entry));
}

const Parameters::Entry* Parameters::find(const std::string& key) const {
  const auto it =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  return it == entries_.end() ? nullptr : &*it;
}

const Parameters::Entry& Parameters::require(const std::string& key, const std::string& origin) const {
  const Entry* entry = find(key);
  if (entry == nullptr) fail(origin + ": unknown key '" + key + "'" + suggestion(key, keys()));
  return *entry;
}

Parameters::Value Parameters::read(const Target& target) {
  const auto value_of = [](const auto* x) -> Value {
    if constexpr (std::is_same_v<decltype(x), const int*>)
      return static_cast<long>(*x);
    else
      return *x;
  };
  return std::visit(value_of, target);
}

void Parameters::assign(const Assignment& a) {
  const Entry& entry = require(a.key, a.origin);
  const std::string expected =
      std::visit([](const auto* t) { return std::string(type_name(t)); }, entry.target);
  const std::string range = range_text(entry.bounds, entry.allowed);
  const std::string found = fmt::format("{}: {} = {}", a.origin, a.key, toml_value(a.value));
  const std::string unit = entry.unit.empty() || entry.unit == "-" ? "" : " (unit: " + entry.unit + ")";
  const Value before = read(entry.target);
  if (!std::visit(Store{a.value}, entry.target))
    fail(found + " has the wrong type; expected " + expected + (range.empty() ? "" : ", " + range) + unit);
  const auto* word = std::get_if<std::string>(&a.value);
  const bool known = entry.allowed.empty() ||
                     std::find(entry.allowed.begin(), entry.allowed.end(), *word) != entry.allowed.end();
  if (known && std::visit(InBounds{entry.bounds}, a.value)) return;
  std::visit(Store{before}, entry.target);
  if (!known) fail(found + " is not a choice" + suggestion(*word, entry.allowed));
  fail(found + " is out of range; expected " +
       (range.empty() ? "a finite number" : "a finite number, " + range) + unit);
}

void Parameters::read_toml(const std::string& file) {
  std::vector<Assignment> assignments;
  for (detail::TomlEntry& e : detail::read_toml_file(file)) {
    const std::string origin = file + ":" + std::to_string(e.line);
    if (e.path[0] != "presets")
      assignments.push_back({joined(e.path, 0), std::move(e.value), origin});
    else if (e.path.size() > 2)
      presets_[e.path[1]].push_back({joined(e.path, 2), std::move(e.value), origin});
    else
      fail(origin + ": presets." + e.path[1] + " is no table; expected [presets.<name>] with keys below it");
  }
  if (!presets_.empty()) declare_preset(file);
  for (const auto& [name, values] : presets_)
    for (const Assignment& a : values) static_cast<void>(require(a.key, a.origin));
  for (const Assignment& a : assignments) assign(a);
}

void Parameters::declare_preset(const std::string& file) {
  if (has("preset")) return;
  std::vector<std::string> names{preset_};
  for (const auto& [name, values] : presets_) names.push_back(name);
  add_choice("preset", preset_, std::move(names), "named set of values in " + file);
}

void Parameters::apply_preset() {
  if (presets_.empty()) return;
  const std::string name = std::get<std::string>(value("preset"));
  const auto preset = presets_.find(name);
  if (preset == presets_.end()) return;
  for (const Assignment& a : preset->second) assign(a);
}

void Parameters::set(const std::string& assignment, const std::string& origin) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    fail(fmt::format("{}: '{}' is no assignment; expected key=value", origin, assignment));
  const std::string key(trimmed(std::string_view(assignment).substr(0, equals)));
  const Entry& entry = require(key, origin);
  const std::string_view text = trimmed(std::string_view(assignment).substr(equals + 1));
  assign({key, std::visit(FromText{text}, entry.target), origin});
}

void Parameters::load(const std::string& file, const std::vector<std::string>& assignments) {
  if (!file.empty()) read_toml(file);
  for (const std::string& a : assignments) set(a);  // they may pick the preset ...
  apply_preset();
  for (const std::string& a : assignments) set(a);  // ... and win over its values
}

std::vector<std::string> Parameters::keys() const {
  std::vector<std::string> names;
  for (const Entry& e : entries_) names.push_back(e.key);
  return names;
}

Parameters::Value Parameters::value(const std::string& key) const {
  return read(require(key, "parameters").target);
}

std::string Parameters::table() const {
  std::vector<std::array<std::string, 5>> rows;
  rows.push_back({"key", "default", "unit", "range", "help"});
  for (const Entry& e : entries_)
    rows.push_back({e.key, toml_value(read(e.target)), e.unit, range_text(e.bounds, e.allowed), e.help});
  std::array<std::size_t, 4> width{};
  for (const auto& row : rows)
    for (std::size_t c = 0; c < width.size(); ++c) width[c] = std::max(width[c], row[c].size());
  std::string text;
  for (const auto& row : rows)
    text += fmt::format("{:<{}}  {:<{}}  {:<{}}  {:<{}}  {}\n", row[0], width[0], row[1], width[1], row[2],
                        width[2], row[3], width[3], row[4]);
  return text;
}

std::string Parameters::to_toml() const {
  std::string text;
  for (const Entry& e : entries_) {
    if (e.target == Target(const_cast<std::string*>(&preset_)))
      continue;  // its values are written one by one
    const std::string range = range_text(e.bounds, e.allowed);
    text += fmt::format("# {} [{}]{}\n{} = {}\n", e.help, e.unit, range.empty() ? "" : ", " + range, e.key,
                        toml_value(read(e.target)));
  }
  return text;
}

}  // namespace ifsi
