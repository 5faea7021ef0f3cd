#include "ifsi/simulation/profiles.hpp"

#include <algorithm>
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
    return std::stod(words.at(column));
  } catch (const std::exception&) {
    throw Error(ExitCode::file, where + ": expected a number in column " + std::to_string(column + 1));
  }
}

}  // namespace

std::optional<std::vector<std::pair<double, double>>> read_profile(const std::string& file,
                                                                   const std::string& column) {
  std::ifstream stream(file);
  if (!stream) throw Error(ExitCode::file, file + ": cannot be read; expected a CSV table");
  std::vector<std::pair<double, double>> profile;
  std::vector<std::string> names;
  std::size_t index = 0;
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (line.empty() || line[0] == '#') continue;
    const auto words = split(line);
    if (names.empty()) {
      names = words;
      index = std::find(names.begin(), names.end(), column) - names.begin();
      if (index == names.size()) return std::nullopt;
      continue;
    }
    const std::string where = file + ":" + std::to_string(line_number);
    profile.emplace_back(number(words, 0, where), number(words, index, where));
  }
  return profile;
}

}  // namespace ifsi
