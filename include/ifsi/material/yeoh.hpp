#pragma once
/// \file
/// Nearly incompressible Yeoh solid: stiffens with stretch, as rubber and soft tissue do.

#include "ifsi/material/isochoric_invariants.hpp"

namespace ifsi {

/// W = c1 (I1bar - 3) + c2 (I1bar - 3)^2 + c3 (I1bar - 3)^3.
struct YeohEnergy {
  double c1, c2, c3;

  template <class T>
  T energy(const T& I1, const T&) const {
    const T x = I1 - 3.0;
    return T(x * (c1 + x * (c2 + x * c3)));
  }
  template <class T>
  InvariantSlopes<T> slopes(const T& I1, const T&) const {
    const T x = I1 - 3.0;
    return {T(c1 + x * (2 * c2 + x * (3 * c3))), T(0.0), T(2 * c2 + x * (6 * c3)), T(0.0), T(0.0)};
  }
  [[nodiscard]] double shear_modulus() const { return 2 * c1; }
};

/// psi = sum_i c_i (I1bar - 3)^i + kappa/2 ( (J^2 - 1)/2 - ln J ).
struct Yeoh : Uncoupled<IsochoricInvariants<YeohEnergy>> {
  /// \throws Error (configuration) unless c1 and kappa are positive.
  Yeoh(double c1, double c2, double c3, double kappa)
      : Uncoupled(IsochoricInvariants<YeohEnergy>({positive_modulus("c1", c1), c2, c3}), kappa) {}
};

}  // namespace ifsi
