#include "ifsi/io/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "ifsi/core/error.hpp"

namespace ifsi {

struct CsvFile::Stream {
  std::string file;
  std::size_t n_columns;
  std::ofstream out;
};

namespace {

std::string header(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& c : columns) names.push_back(c.name + " [" + c.unit + "]");
  return fmt::format("{}", fmt::join(names, ","));
}

/// Header and the rows whose first number is at most `last` (with room for rounding).
std::string kept_part(const std::string& file, const std::string& expected_header, double last) {
  std::ifstream old(file);
  std::string line, text;
  if (!std::getline(old, line)) return expected_header + "\n";
  if (line != expected_header)
    throw Error(ExitCode::file, file + ":1: cannot be continued: its columns are '" + line + "'; expected '" +
                                    expected_header + "'");
  text = line + "\n";
  const double tolerance = 1e-9 * std::abs(last);
  while (std::getline(old, line) && std::strtod(line.c_str(), nullptr) <= last + tolerance)
    text += line + "\n";
  return text;
}

}  // namespace

CsvFile::CsvFile(const std::string& file, const std::vector<Column>& columns)
    : stream_(std::make_shared<Stream>(Stream{file, columns.size(), std::ofstream(file)})) {
  stream_->out << header(columns) << std::endl;
  if (!stream_->out) throw Error(ExitCode::file, "cannot write '" + file + "'");
}

CsvFile::CsvFile(const std::string& file, const std::vector<Column>& columns, double resume_at) {
  const std::string kept = kept_part(file, header(columns), resume_at);
  stream_ = std::make_shared<Stream>(Stream{file, columns.size(), std::ofstream(file)});
  stream_->out << kept << std::flush;
  if (!stream_->out) throw Error(ExitCode::file, "cannot write '" + file + "'");
}

void CsvFile::row(const double* values, std::size_t n) {
  if (stream_ == nullptr) return;
  if (n != stream_->n_columns)
    throw std::logic_error(
        fmt::format("{}: a row of {} values in {} columns", stream_->file, n, stream_->n_columns));
  stream_->out << fmt::format("{}\n", fmt::join(values, values + n, ",")) << std::flush;
  if (!stream_->out) throw Error(ExitCode::file, "cannot write '" + stream_->file + "' (is the disk full?)");
}

}  // namespace ifsi
