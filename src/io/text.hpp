#pragma once
/// \file
/// Text forms shared by the TOML, JSON and log writers.

#include <string>
#include <vector>

#include "ifsi/io/parameters.hpp"

namespace ifsi::detail {

/// "text" with quotes and escapes that TOML and JSON both read.
std::string quoted(const std::string& text);
/// Shortest text that reads back as the same double; "null" in place of NaN and infinity.
std::string json_number(double x);
/// A value as TOML writes it (which JSON reads too, but for inf and nan).
std::string toml_value(const Parameters::Value& value);

}  // namespace ifsi::detail
