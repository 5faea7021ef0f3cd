/// \file
/// Names that are not there, and the nearest that is.

#include "ifsi/mesh/names.hpp"

#include <algorithm>
#include <numeric>

#include "ifsi/core/error.hpp"

namespace ifsi {

namespace {

/// Least number of insertions, deletions and replacements that turn a into b (Levenshtein).
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

int find_name(const std::string& kind, const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  std::string message = "mesh: there is no " + kind + " named \"" + name + "\"; ";
  if (names.empty()) throw Error(ExitCode::configuration, message + "this mesh has none");
  message += "expected one of";
  for (const auto& n : names) message += " \"" + n + "\"";
  const auto nearest = *std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  if (edit_distance(name, nearest) <= std::max<size_t>(2, name.size() / 3))
    message += " (did you mean \"" + nearest + "\"?)";
  throw Error(ExitCode::configuration, message);
}

}  // namespace ifsi
