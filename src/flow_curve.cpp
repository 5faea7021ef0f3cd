#include "ifsi/simulation/flow_curve.hpp"

#include <algorithm>
#include <cmath>

#include "ifsi/core/error.hpp"
#include "ifsi/simulation/profiles.hpp"

namespace ifsi {

namespace {

[[noreturn]] void refuse(const std::string& file, int line, const std::string& what) {
  throw Error(ExitCode::file, file + ":" + std::to_string(line) + ": " + what);
}

/// Times ascend without gaps.
void check_times(const std::string& file, const std::vector<CurvePoint>& points) {
  constexpr double gap = 5.0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double dt = points[k].x - points[k - 1].x;
    if (!(dt > 0.0))
      refuse(file, points[k].line,
             "time " + std::to_string(points[k].x) + " after " + std::to_string(points[k - 1].x) +
                 "; expected ascending times");
    if (k < 2) continue;
    const double before = points[k - 1].x - points[k - 2].x;
    if (dt > gap * before || before > gap * dt)
      refuse(file, points[k].line,
             "a gap: steps of " + std::to_string(before) + " and " + std::to_string(dt) +
                 " in time follow each other; expected neighbours to differ by a factor of 5 at most");
  }
}

}  // namespace

FlowCurve::FlowCurve(const std::string& file) {
  const std::vector<CurvePoint> points = read_curve(file);
  if (points.size() < 2)
    throw Error(ExitCode::file, file + ": found " + std::to_string(points.size()) +
                                    " points of a curve; expected at least 2");
  check_times(file, points);
  for (const CurvePoint& p : points) t_.push_back(p.x), value_.push_back(p.y);
  slope_.assign(t_.size(), 0.0);
  for (std::size_t k = 1; k + 1 < t_.size(); ++k) {
    const double h_0 = t_[k] - t_[k - 1], h_1 = t_[k + 1] - t_[k];
    const double d_0 = (value_[k] - value_[k - 1]) / h_0, d_1 = (value_[k + 1] - value_[k]) / h_1;
    if (d_0 * d_1 > 0.0) slope_[k] = (h_1 * d_0 + h_0 * d_1) / (h_0 + h_1);
  }
}

double FlowCurve::operator()(double t) const {
  if (t <= t_.front()) return value_.front();
  if (t >= t_.back()) return value_.back();
  const std::size_t k = std::upper_bound(t_.begin(), t_.end(), t) - t_.begin() - 1;
  const double h = t_[k + 1] - t_[k], s = (t - t_[k]) / h;
  const double rise = s * s * (3.0 - 2.0 * s);
  return (1.0 - rise) * value_[k] + rise * value_[k + 1] +
         h * s * (1.0 - s) * ((1.0 - s) * slope_[k] - s * slope_[k + 1]);
}

double FlowCurve::max() const { return *std::max_element(value_.begin(), value_.end()); }

FlowCurve::Volumes FlowCurve::volumes() const {
  Volumes sum{};
  constexpr int n = 20;  // midpoints per interval
  for (std::size_t k = 0; k + 1 < t_.size(); ++k)
    for (int i = 0; i < n; ++i) {
      const double dt = (t_[k + 1] - t_[k]) / n, q = (*this)(t_[k] + (i + 0.5) * dt);
      (q > 0.0 ? sum.forward : sum.backward) += dt * std::abs(q);
    }
  return sum;
}

}  // namespace ifsi
