#pragma once
/// \file
/// Principal values of symmetric tensors.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// Eigenvalues of a symmetric 3 x 3 tensor, largest first, by cyclic Jacobi rotations (each sweep at least
/// squares the off-diagonal part once that is small).
inline std::array<double, 3> principal_values(Mat<double, 3> a) {
  const auto rotate = [&a](int p, int q) {
    if (a(p, q) == 0) return;
    const double angle = 0.5 * std::atan2(2 * a(p, q), a(q, q) - a(p, p));
    Mat<double, 3> Q = Mat<double, 3>::identity();
    Q(p, p) = Q(q, q) = std::cos(angle);
    Q(p, q) = std::sin(angle);
    Q(q, p) = -std::sin(angle);
    a = transpose(Q) * a * Q;
    a(p, q) = a(q, p) = 0;
  };
  for (int sweep = 0; sweep < 6; ++sweep) {
    rotate(0, 1);
    rotate(0, 2);
    rotate(1, 2);
  }
  std::array<double, 3> values = {a(0, 0), a(1, 1), a(2, 2)};
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

}  // namespace ifsi
