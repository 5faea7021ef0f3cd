#pragma once
/// \file
/// Exact solutions of the incompressible Navier-Stokes equations, the measure of the solver.

#include <cmath>
#include <numbers>

#include "ifsi/core/tensor.hpp"
#include "ifsi/mesh/generators.hpp"

namespace ifsi {

/// Decaying vortices of Taylor and Green (1937) in the plane, one vortex per unit square; rho = 1.
struct TaylorGreen {
  static constexpr int dim = 2;
  double nu;
  static constexpr double k = std::numbers::pi;

  [[nodiscard]] Vec<double, 2> v(const Vec<double, 2>& x, double t) const {
    const double decay = std::exp(-2.0 * nu * k * k * t);
    return {decay * std::sin(k * x[0]) * std::cos(k * x[1]),
            -decay * std::cos(k * x[0]) * std::sin(k * x[1])};
  }
  [[nodiscard]] Vec<double, 2> v_dot(const Vec<double, 2>& x, double t) const {
    return -2.0 * nu * k * k * v(x, t);
  }
  [[nodiscard]] Mat<double, 2> grad_v(const Vec<double, 2>& x, double t) const {
    const double decay = k * std::exp(-2.0 * nu * k * k * t);
    const double cc = decay * std::cos(k * x[0]) * std::cos(k * x[1]);
    const double ss = decay * std::sin(k * x[0]) * std::sin(k * x[1]);
    return {cc, -ss, ss, -cc};
  }
  [[nodiscard]] double p(const Vec<double, 2>& x, double t) const {
    return 0.25 * std::exp(-4.0 * nu * k * k * t) * (std::cos(2.0 * k * x[0]) + std::cos(2.0 * k * x[1]));
  }
};

/// The three-dimensional flow of Ethier & Steinman (1994), doi:10.1002/fld.1650190502, with a = pi/4, d =
/// pi/2 on
/// [-1, 1]^3; rho = 1. Convection balances the pressure gradient, time dependence is viscous decay.
struct EthierSteinman {
  static constexpr int dim = 3;
  double nu;
  static constexpr double a = std::numbers::pi / 4.0, d = std::numbers::pi / 2.0;

  [[nodiscard]] Vec<double, 3> v(const Vec<double, 3>& x, double t) const {
    const double decay = -a * std::exp(-nu * d * d * t);
    Vec<double, 3> r;
    for (int i = 0; i < 3; ++i) {
      const double xi = x[i], yi = x[(i + 1) % 3], zi = x[(i + 2) % 3];
      r[i] = decay *
             (std::exp(a * xi) * std::sin(a * yi + d * zi) + std::exp(a * zi) * std::cos(a * xi + d * yi));
    }
    return r;
  }
  [[nodiscard]] Vec<double, 3> v_dot(const Vec<double, 3>& x, double t) const {
    return -nu * d * d * v(x, t);
  }
  [[nodiscard]] Mat<double, 3> grad_v(const Vec<double, 3>& x, double t) const {
    const double decay = -a * std::exp(-nu * d * d * t);
    Mat<double, 3> g;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double ex = std::exp(a * x[i]), ez = std::exp(a * x[k]);
      const double s1 = std::sin(a * x[j] + d * x[k]), c1 = std::cos(a * x[j] + d * x[k]);
      const double s2 = std::sin(a * x[i] + d * x[j]), c2 = std::cos(a * x[i] + d * x[j]);
      g(i, i) = decay * (a * ex * s1 - a * ez * s2);
      g(i, j) = decay * (a * ex * c1 - d * ez * s2);
      g(i, k) = decay * (d * ex * c1 + a * ez * c2);
    }
    return g;
  }
  /// Zero at no point in particular: compare after removing the mean.
  [[nodiscard]] double p(const Vec<double, 3>& x, double t) const {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double xi = x[i], yi = x[(i + 1) % 3], zi = x[(i + 2) % 3];
      sum += std::exp(2.0 * a * xi) +
             2.0 * std::sin(a * xi + d * yi) * std::cos(a * zi + d * xi) * std::exp(a * (yi + zi));
    }
    return -0.5 * a * a * std::exp(-2.0 * nu * d * d * t) * sum;
  }
};

/// Steady flow behind a grid, Kovasznay (1948), on [-0.5, 1] x [-0.5, 1.5]; rho = 1, Re = 1 / nu.
struct Kovasznay {
  static constexpr int dim = 2;
  double Re;

  [[nodiscard]] double lambda() const {
    return 0.5 * Re - std::sqrt(0.25 * Re * Re + 4.0 * std::numbers::pi * std::numbers::pi);
  }
  [[nodiscard]] Vec<double, 2> v(const Vec<double, 2>& x, double) const {
    const double l = lambda(), k = 2.0 * std::numbers::pi, e = std::exp(l * x[0]);
    return {1.0 - e * std::cos(k * x[1]), l / k * e * std::sin(k * x[1])};
  }
  [[nodiscard]] Mat<double, 2> grad_v(const Vec<double, 2>& x, double) const {
    const double l = lambda(), k = 2.0 * std::numbers::pi, e = std::exp(l * x[0]);
    const double c = e * std::cos(k * x[1]), s = e * std::sin(k * x[1]);
    return {-l * c, k * s, l * l / k * s, l * c};
  }
  [[nodiscard]] double p(const Vec<double, 2>& x, double) const {
    return -0.5 * std::exp(2.0 * lambda() * x[0]);
  }
};

/// The box of TaylorGreen or EthierSteinman with n cells per side.
template <class Element>
GlobalMesh<Element> exact_domain(int n) {
  if constexpr (Element::dim == 2)
    return box<Element>({0.0, 0.0}, {1.0, 1.0}, {n, n});
  else
    return box<Element>({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}, {n, n, n});
}

}  // namespace ifsi
