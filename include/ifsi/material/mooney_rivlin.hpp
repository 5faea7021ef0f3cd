#pragma once
/// \file
/// Nearly incompressible Mooney-Rivlin solid.

#include "ifsi/material/isochoric_invariants.hpp"

namespace ifsi {

/// W = C10 (I1bar - 3) + C01 (I2bar - 3).
struct MooneyRivlinEnergy {
  double C10, C01;

  template <class T>
  T energy(const T& I1, const T& I2) const {
    return T(C10 * (I1 - 3.0) + C01 * (I2 - 3.0));
  }
  template <class T>
  InvariantSlopes<T> slopes(const T&, const T&) const {
    return {T(C10), T(C01), T(0.0), T(0.0), T(0.0)};
  }
  [[nodiscard]] double shear_modulus() const { return 2 * (C10 + C01); }
};

/// psi = C10 (I1bar - 3) + C01 (I2bar - 3) + kappa/2 ( (J^2 - 1)/2 - ln J ).
struct MooneyRivlin : Uncoupled<IsochoricInvariants<MooneyRivlinEnergy>> {
  /// \throws Error (configuration) unless the shear modulus 2 (C10 + C01) and kappa are positive.
  MooneyRivlin(double C10, double C01, double kappa)
      : Uncoupled(IsochoricInvariants<MooneyRivlinEnergy>({C10, C01}), kappa) {
    positive_modulus("shear modulus 2 (C10 + C01)", isochoric.shear_modulus());
  }
};

}  // namespace ifsi
