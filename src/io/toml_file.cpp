#include "toml_file.hpp"

#define TOML_HEADER_ONLY 0  // its code comes from libtomlplusplus
#define TOML_SHARED_LIB 1
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "ifsi/core/error.hpp"

namespace ifsi::detail {
namespace {

std::string place(const std::string& file, const toml::source_region& source) {
  return file + ":" + std::to_string(source.begin.line) + ": ";
}

std::vector<double> numbers(const toml::array& array, const std::string& where) {
  std::vector<double> x;
  for (const toml::node& node : array) {
    const auto number = node.is_number() ? node.value<double>() : std::nullopt;
    if (!number) throw Error(ExitCode::configuration, where + "an array has to hold numbers only");
    x.push_back(*number);
  }
  return x;
}

Parameters::Value value_of(const toml::node& node, const std::string& where) {
  if (const auto* b = node.as_boolean()) return b->get();
  if (const auto* i = node.as_integer()) return static_cast<long>(i->get());
  if (const auto* d = node.as_floating_point()) return d->get();
  if (const auto* s = node.as_string()) return s->get();
  if (const auto* a = node.as_array()) return numbers(*a, where);
  throw Error(
      ExitCode::configuration,
      where +
          "dates and times are no parameter values; expected a number, true/false, a string or [numbers]");
}

void flatten(const toml::table& table, const std::vector<std::string>& path, const std::string& file,
             std::vector<TomlEntry>& entries) {
  for (const auto& [key, node] : table) {
    std::vector<std::string> here = path;
    here.emplace_back(key.str());
    if (const toml::table* inner = node.as_table())
      flatten(*inner, here, file, entries);
    else
      entries.push_back(
          {here, value_of(node, place(file, node.source())), static_cast<int>(node.source().begin.line)});
  }
}

std::string contents(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream || !text)
    throw Error(ExitCode::file,
                "cannot read '" + file + "'; expected a TOML file with the parameters of the case");
  return text.str();
}

}  // namespace

std::vector<TomlEntry> read_toml_file(const std::string& file) {
  const std::string text = contents(file);
  std::vector<TomlEntry> entries;
  try {
    flatten(toml::parse(text), {}, file, entries);
  } catch (const toml::parse_error& e) {
    throw Error(ExitCode::configuration,
                place(file, e.source()) + "not valid TOML: " + std::string(e.description()));
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.line < b.line; });
  return entries;
}

}  // namespace ifsi::detail
