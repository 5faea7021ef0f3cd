#pragma once
/// \file
/// Orthogonal projectors onto the directions that are left free.

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// Takes a direction out of the range of a symmetric projector P. A direction that is out already, but for
/// 1e-5 of its length, changes nothing: planes may coincide.
template <int n>
constexpr void remove_direction(Mat<double, n>& P, const Vec<double, n>& direction) {
  const Vec<double, n> rest = P * direction;
  const double size2 = dot(rest, rest);
  if (size2 <= 1e-10 * dot(direction, direction)) return;
  P -= (1.0 / size2) * outer(rest, rest);
  if (trace(P) < 0.5) P = Mat<double, n>::zero();  // nothing is left: exactly nothing
}

/// Projector onto the range of a symmetric, positive semidefinite matrix; what is below `tolerance` counts as
/// zero.
template <int n>
constexpr Mat<double, n> projector_onto_range(const Mat<double, n>& A, double tolerance) {
  Mat<double, n> P = Mat<double, n>::identity();  // onto what has not been found yet
  for (int found = 0; found < n; ++found) {
    const Mat<double, n> rest = P * A * P;
    int k = 0;
    for (int i = 1; i < n; ++i)
      if (rest(i, i) > rest(k, k)) k = i;
    if (rest(k, k) <= tolerance) break;
    Vec<double, n> column;
    for (int i = 0; i < n; ++i) column[i] = rest(i, k);
    remove_direction(P, column);
  }
  return Mat<double, n>::identity() - P;
}

}  // namespace ifsi
