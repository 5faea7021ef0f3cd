#pragma once
/// \file
/// Repulsion of surfaces that come close, as energies that depend on one distance.

#include <cmath>
#include <numbers>

namespace ifsi {

/// A function of a distance with its first two derivatives.
struct Potential {
  double value = 0.0, slope = 0.0, curvature = 0.0;
};

/// Energy of two surface points per product of their areas (eq. 32), zero from `range` on: two flat surfaces
/// half of the range apart press on each other with `pressure`. \pre r > 0
template <int dim>
[[nodiscard]] Potential point_repulsion(double r, double range, double pressure) {
  constexpr int m = dim - 1;
  // (eq. 33) of A = 1, range = 1 at half of the range; acosh 2 = log(2 + sqrt 3).
  const double unit = dim == 2 ? 3.0 * (std::numbers::sqrt3 - std::log(2.0 + std::numbers::sqrt3))
                               : 0.5 * std::numbers::pi * range;
  const double s = r / range, t = 1.0 - s;
  if (t <= 0.0) return {};
  const double A = pressure / unit * std::pow(s, -m);
  return {A * t * t * t, -A / range * t * t * (3.0 + m * t / s),
          A / (range * range) * t * (6.0 + 6.0 * m * t / s + m * (m + 1) * t * t / (s * s))};
}

/// Energy of a surface point and a rigid plane, per area of the point (eq. 34). \pre d > 0
[[nodiscard]] inline Potential plane_repulsion(double d, double range, double pressure) {
  const double s = d / range, t = 1.0 - s, p = 4.0 * pressure;
  if (t <= 0.0) return {};
  return {p * range * (-std::log(s) - t * (11.0 - 7.0 * s + 2.0 * s * s) / 6.0), -p * t * t * t / s,
          p / range * t * t * (3.0 + t / s) / s};
}

}  // namespace ifsi
