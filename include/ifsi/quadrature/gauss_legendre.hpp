#pragma once
/// \file
/// Gauss-Legendre rules on [-1,1], their products on [-1,1]^dim, and collapsed products on simplices.

#include "ifsi/element/element.hpp"
#include "ifsi/quadrature/rule.hpp"

namespace ifsi::detail {

/// The rule of n points integrates polynomials of degree 2n - 1 exactly.
template <int n>
constexpr Rule<1, n> gauss_legendre() {
  static_assert(n >= 1 && n <= 6, "Gauss-Legendre rules have 1 to 6 points here: degree 11 at most");
  if constexpr (n == 1) {
    return {{{{0.0}}}, {2.0}};
  } else if constexpr (n == 2) {
    constexpr double a = 0.5773502691896257645091;
    return {{{{-a}, {a}}}, {1.0, 1.0}};
  } else if constexpr (n == 3) {
    constexpr double a = 0.7745966692414833770359;
    return {{{{-a}, {0.0}, {a}}}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
  } else if constexpr (n == 4) {
    constexpr double a = 0.8611363115940525752239, wa = 0.3478548451374538573731;
    constexpr double b = 0.3399810435848562648027, wb = 0.6521451548625461426269;
    return {{{{-a}, {-b}, {b}, {a}}}, {wa, wb, wb, wa}};
  } else if constexpr (n == 5) {
    constexpr double a = 0.9061798459386639927976, wa = 0.2369268850561890875143;
    constexpr double b = 0.5384693101056830910363, wb = 0.4786286704993664680413;
    return {{{{-a}, {-b}, {0.0}, {b}, {a}}}, {wa, wb, 128.0 / 225.0, wb, wa}};
  } else {
    constexpr double a = 0.9324695142031520278123, wa = 0.1713244923791703450403;
    constexpr double b = 0.6612093864662645136614, wb = 0.3607615730481386075698;
    constexpr double c = 0.2386191860831969086305, wc = 0.4679139345726910473899;
    return {{{{-a}, {-b}, {-c}, {c}, {b}, {a}}}, {wa, wb, wc, wc, wb, wa}};
  }
}

/// Product of the n-point rule in each direction of [-1,1]^dim; the first coordinate runs fastest.
template <int dim, int n>
constexpr Rule<dim, power(n, dim)> tensor_rule() {
  constexpr Rule<1, n> line = gauss_legendre<n>();
  Rule<dim, power(n, dim)> r{};
  for (int q = 0; q < power(n, dim); ++q) {
    r.weights[q] = 1.0;
    for (int i = 0, rest = q; i < dim; ++i, rest /= n) {
      r.points[q][i] = line.points[rest % n][0];
      r.weights[q] *= line.weights[rest % n];
    }
  }
  return r;
}

/// Product rule on the unit simplex through xi_i = (1 - xi_0 - ... - xi_(i-1)) (1 + s_i) / 2, s in
/// [-1,1]^dim. Its Jacobian costs dim - 1 degrees of exactness: 2n - dim remain. Inside, positive, but not
/// symmetric.
template <int dim, int n>
constexpr Rule<dim, power(n, dim)> collapsed_rule() {
  Rule<dim, power(n, dim)> r = tensor_rule<dim, n>();
  for (int q = 0; q < power(n, dim); ++q) {
    double rest = 1.0;
    for (int i = 0; i < dim; ++i) {
      r.weights[q] *= 0.5 * rest;
      r.points[q][i] = 0.5 * rest * (1.0 + r.points[q][i]);
      rest -= r.points[q][i];
    }
  }
  return r;
}

}  // namespace ifsi::detail
