#include "ifsi/mesh/axis.hpp"

#include <algorithm>
#include <cmath>

#include "ifsi/core/error.hpp"

namespace ifsi {
namespace {

void check_axis(double lower, double upper, int n) {
  if (n >= 1 && lower < upper) return;
  throw Error(ExitCode::configuration, "axis: found the interval [" + std::to_string(lower) + ", " +
                                           std::to_string(upper) + "] with " + std::to_string(n) +
                                           " cells; expected lower < upper and at least one cell");
}

/// Sum of 1 + g + ... + g^(n-1).
double geometric_sum(double g, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum = 1 + g * sum;
  return sum;
}

/// n cells, each `growth` times as long as the one before.
Axis growing_axis(double lower, double upper, int n, double growth) {
  Axis x{lower};
  double size = (upper - lower) / geometric_sum(growth, n);
  for (int i = 1; i < n; ++i, size *= growth) x.push_back(x.back() + size);
  x.push_back(upper);
  return x;
}

}  // namespace

void check_increasing(const Axis& axis, const std::string& what) {
  if (axis.size() < 2) throw Error(ExitCode::configuration, what + " has no cells; expected at least one");
  for (size_t i = 0; i + 1 < axis.size(); ++i)
    if (!(axis[i] < axis[i + 1]) || !std::isfinite(axis[i + 1] - axis[i]))
      throw Error(ExitCode::configuration, what + " goes from " + std::to_string(axis[i]) + " to " +
                                               std::to_string(axis[i + 1]) + " in cell " + std::to_string(i) +
                                               "; expected increasing finite coordinates");
}

Axis uniform_axis(double lower, double upper, int n) {
  check_axis(lower, upper, n);
  Axis x(n + 1);
  for (int i = 0; i <= n; ++i) x[i] = i == n ? upper : lower + (upper - lower) * i / n;
  return x;
}

Axis geometric_axis(double lower, double upper, int n, double ratio) {
  check_axis(lower, upper, n);
  if (!(ratio > 0)) throw Error(ExitCode::configuration, "geometric_axis: expected a ratio above 0");
  return growing_axis(lower, upper, n, n > 1 ? std::pow(ratio, 1.0 / (n - 1)) : 1);
}

Axis axis_from_first_cell(double lower, double upper, int n, double first) {
  check_axis(lower, upper, n);
  const double target = (upper - lower) / first;
  if (!(first > 0) || target <= 1)
    throw Error(ExitCode::configuration, "axis_from_first_cell: the first cell, " + std::to_string(first) +
                                             ", must be positive and shorter than the interval, " +
                                             std::to_string(upper - lower));
  double low = 0, high = n > 1 ? target : 1;
  for (int i = 0; i < 200; ++i) {
    const double growth = 0.5 * (low + high);
    (geometric_sum(growth, n) < target ? low : high) = growth;
  }
  return growing_axis(lower, upper, n, high);
}

Axis symmetric_axis(double lower, double upper, int n, double ratio) {
  check_axis(lower, upper, n);
  if (!(ratio > 0)) throw Error(ExitCode::configuration, "symmetric_axis: expected a ratio above 0");
  const int pairs = (n - 1) / 2;
  std::vector<double> size(n, 1.0);
  for (int i = 0; i < n; ++i)
    if (pairs > 0) size[i] = std::pow(ratio, static_cast<double>(std::min(i, n - 1 - i)) / pairs);
  double total = 0;
  for (double s : size) total += s;
  Axis x{lower};
  for (int i = 0; i + 1 < n; ++i) x.push_back(x.back() + size[i] * (upper - lower) / total);
  x.push_back(upper);
  return x;
}

Axis join(Axis first, const Axis& second) {
  if (first.empty() || second.empty() ||
      std::abs(first.back() - second.front()) > 1e-12 * (1 + std::abs(first.back())))
    throw Error(ExitCode::configuration, "join: the second axis must begin where the first ends");
  first.insert(first.end(), second.begin() + 1, second.end());
  return first;
}

Axis reflect(const Axis& axis) {
  Axis x(axis.rbegin(), axis.rend());
  for (double& c : x) c = -c;
  return x;
}

Axis shift(Axis axis, double offset) {
  for (double& c : axis) c += offset;
  return axis;
}

}  // namespace ifsi
