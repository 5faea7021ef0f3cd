#include "ifsi/core/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace ifsi {
namespace {

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Least number of insertions, deletions and replacements that turn a into b (Levenshtein).
int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (same_letter(a[i], b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  std::string nearest;
  int smallest = 1 + std::max(1, static_cast<int>(name.size()) / 2);
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(name, candidate);
    if (distance < smallest) {
      smallest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates) {
  constexpr std::size_t most_listed = 40;
  if (candidates.empty()) return "; there are none";
  const std::string nearest = nearest_name(name, candidates);
  std::string text = nearest.empty() ? "; there are: " : "; did you mean '" + nearest + "'? there are: ";
  for (std::size_t i = 0; i < std::min(candidates.size(), most_listed); ++i)
    text += (i > 0 ? ", " : "") + candidates[i];
  return candidates.size() > most_listed ? text + ", ..." : text;
}

}  // namespace ifsi
