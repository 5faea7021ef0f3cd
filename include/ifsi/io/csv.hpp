#pragma once
/// \file
/// Tables of numbers over time, one CSV file each, readable while the run goes on.

#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace ifsi {

struct Column {
  std::string name, unit;
};

/// CSV file whose first line names columns and units, "t [s],drag [N]". Each row is flushed. Numbers are
/// written with the digits that read back the same double.
class CsvFile {
 public:
  /// A file nobody writes: what the other ranks hold.
  CsvFile() = default;
  /// Starts the file anew, or keeps the rows up to `resume_at` in the first column (a restart). Throws
  /// Error(file) when it cannot be written or when the file to resume has other columns.
  CsvFile(const std::string& file, const std::vector<Column>& columns);
  CsvFile(const std::string& file, const std::vector<Column>& columns, double resume_at);

  /// Appends one row; throws std::logic_error when the number of values is not that of the columns.
  void row(std::initializer_list<double> values) { row(values.begin(), values.size()); }
  void row(const std::vector<double>& values) { row(values.data(), values.size()); }

 private:
  struct Stream;
  void row(const double* values, std::size_t n);
  std::shared_ptr<Stream> stream_;
};

}  // namespace ifsi
