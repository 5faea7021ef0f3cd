#pragma once
/// \file
/// A TOML file as a flat list of values with their lines; the only door to toml++.

#include <string>
#include <vector>

#include "ifsi/io/parameters.hpp"

namespace ifsi::detail {

struct TomlEntry {
  std::vector<std::string> path;  ///< table names, then the key
  Parameters::Value value;
  int line;
};

/// All values of a file in the order of their lines. Throws Error(file) when it cannot be read, and
/// Error(configuration) with file:line for a syntax error or a kind of value no parameter has.
std::vector<TomlEntry> read_toml_file(const std::string& file);

}  // namespace ifsi::detail
