#pragma once
/// \file
/// A flow over time, from a file.

#include <string>
#include <vector>

namespace ifsi {

/// A smooth curve through the points of a CSV file (t, value): cubic between them, with the slope of the
/// parabola through the neighbours, and none at points that are extremes or belong to a constant stretch, so
/// that rest stays rest. Zero change beyond the ends.
class FlowCurve {
 public:
  /// Reads the first two columns; lines that begin with # are comments, the first other line names the
  /// columns. \throws Error (file), naming file and line, for fewer than two points, values that are missing,
  /// no numbers or not finite, times that do not ascend, and gaps: intervals of more than five times the one
  /// before or after.
  explicit FlowCurve(const std::string& file);

  [[nodiscard]] double operator()(double t) const;
  [[nodiscard]] double begin() const { return t_.front(); }
  [[nodiscard]] double end() const { return t_.back(); }
  /// Largest value.
  [[nodiscard]] double max() const;
  /// Integrals over time of the positive and of the negative part, the latter as a positive number.
  struct Volumes {
    double forward, backward;
  };
  [[nodiscard]] Volumes volumes() const;

 private:
  std::vector<double> t_, value_, slope_;
};

}  // namespace ifsi
