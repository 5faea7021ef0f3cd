#include "text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace ifsi::detail {
namespace {

std::string escaped(char c) {
  if (c == '"' || c == '\\') return {'\\', c};
  if (c == '\n') return "\\n";
  if (c == '\t') return "\\t";
  if (static_cast<unsigned char>(c) < 0x20) return fmt::format("\\u{:04x}", static_cast<int>(c));
  return {c};
}

struct TomlText {
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(long i) const { return fmt::format("{}", i); }
  std::string operator()(double x) const { return fmt::format("{}", x); }
  std::string operator()(const std::string& s) const { return quoted(s); }
  std::string operator()(const std::vector<double>& x) const {
    return fmt::format("[{}]", fmt::join(x, ", "));
  }
};

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += escaped(c);
  return result + "\"";
}

std::string json_number(double x) { return std::isfinite(x) ? fmt::format("{}", x) : "null"; }

std::string toml_value(const Parameters::Value& value) { return std::visit(TomlText{}, value); }

}  // namespace ifsi::detail
