#pragma once
/// \file
/// Reference curves from CSV files.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ifsi {

/// The first column of a CSV file against the named one; nothing when the file has no such column. Lines that
/// begin with # are comments, the first other line names the columns. \throws Error (file) for a missing file
/// or a line that is not finite numbers, with file and line.
[[nodiscard]] std::optional<std::vector<std::pair<double, double>>> read_profile(const std::string& file,
                                                                                 const std::string& column);

struct CurvePoint {
  double x, y;
  int line;  ///< of the file
};
/// The first two columns of such a file. \throws as above.
[[nodiscard]] std::vector<CurvePoint> read_curve(const std::string& file);

}  // namespace ifsi
