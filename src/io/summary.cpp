#include "ifsi/io/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ifsi/io/build_info.hpp"
#include "text.hpp"

namespace ifsi {
namespace {

using detail::json_number;
using detail::quoted;

using Fields = std::vector<std::string>;

std::string field(const std::string& name, const std::string& value) { return quoted(name) + ": " + value; }

std::string block(char open, const Fields& fields, char close, const std::string& indent) {
  if (fields.empty()) return {open, close};
  return fmt::format("{}\n{}  {}\n{}{}", open, indent, fmt::join(fields, ",\n" + indent + "  "), indent,
                     close);
}

std::string numbers(const std::vector<std::pair<std::string, double>>& named) {
  Fields fields;
  for (const auto& [name, x] : named) fields.push_back(field(name, json_number(x)));
  return block('{', fields, '}', "  ");
}

std::string checks(const std::vector<Check>& list) {
  Fields fields;
  for (const Check& c : list)
    fields.push_back(fmt::format(
        "{{\"name\": {}, \"value\": {}, \"reference\": {}, \"tolerance\": {}, \"pass\": {}, \"source\": {}}}",
        quoted(c.name), json_number(c.value), json_number(c.reference), json_number(c.tolerance), c.pass,
        quoted(c.source)));
  return block('[', fields, ']', "  ");
}

std::string parameters(const std::vector<std::pair<std::string, Parameters::Value>>& list) {
  Fields fields;
  for (const auto& [key, value] : list) fields.push_back(field(key, detail::toml_value(value)));
  return block('{', fields, '}', "  ");
}

}  // namespace

std::string to_json(const Summary& s) {
  const BuildInfo& build = build_info();
  const Fields fields{field("case", quoted(s.case_name)),
                      field("ranks", std::to_string(s.ranks)),
                      field("threads", std::to_string(s.threads)),
                      field("dofs", std::to_string(s.dofs)),
                      field("steps", std::to_string(s.steps)),
                      field("newton_total", std::to_string(s.newton_total)),
                      field("gmres_total", std::to_string(s.gmres_total)),
                      field("wall_s", json_number(s.wall_s)),
                      field("cpu_s", json_number(s.cpu_s)),
                      field("peak_rss_mb", json_number(s.peak_rss_mb)),
                      field("metrics", numbers(s.metrics)),
                      field("checks", checks(s.checks)),
                      field("timers", numbers(s.timers)),
                      field("version", quoted(build.version)),
                      field("commit", quoted(build.commit)),
                      field("compiler", quoted(build.compiler)),
                      field("flags", quoted(build.flags)),
                      field("processor", quoted(processor_name())),
                      field("date", quoted(s.date)),
                      field("parameters", parameters(s.parameters))};
  return block('{', fields, '}', "") + "\n";
}

}  // namespace ifsi
