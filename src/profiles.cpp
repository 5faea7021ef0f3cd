#include "ifsi/simulation/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "ifsi/core/error.hpp"

namespace ifsi {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

double number(const std::vector<std::string>& words, std::size_t column, const std::string& where) {
  try {
    const double x = std::stod(words.at(column));
    if (std::isfinite(x)) return x;
  } catch (const std::exception&) {  // told below
  }
  throw Error(ExitCode::file, where + ": expected a finite number in column " + std::to_string(column + 1));
}

/// The first column against column `index_of(names)`; nothing when that is none of them.
template <class IndexOf>
std::vector<CurvePoint> read_columns(const std::string& file, IndexOf&& index_of) {
  std::ifstream stream(file);
  if (!stream) throw Error(ExitCode::file, file + ": cannot be read; expected a CSV table");
  std::vector<CurvePoint> points;
  std::vector<std::string> names;
  std::size_t index = 0;
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (line.empty() || line[0] == '#') continue;
    const auto words = split(line);
    if (names.empty()) {
      names = words;
      index = index_of(names);
      if (index == names.size()) return {};
      continue;
    }
    const std::string where = file + ":" + std::to_string(line_number);
    points.push_back({number(words, 0, where), number(words, index, where), line_number});
  }
  return points;
}

}  // namespace

std::optional<std::vector<std::pair<double, double>>> read_profile(const std::string& file,
                                                                   const std::string& column) {
  bool known = false;
  const auto points = read_columns(file, [&](const std::vector<std::string>& names) {
    const std::size_t index = std::find(names.begin(), names.end(), column) - names.begin();
    known = index < names.size();
    return index;
  });
  if (!known) return std::nullopt;
  std::vector<std::pair<double, double>> profile;
  for (const CurvePoint& p : points) profile.emplace_back(p.x, p.y);
  return profile;
}

std::vector<CurvePoint> read_curve(const std::string& file) {
  return read_columns(file, [](const std::vector<std::string>&) { return std::size_t{1}; });
}

}  // namespace ifsi
