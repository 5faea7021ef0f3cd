#pragma once
/// \file
/// Nearly incompressible solids: an isochoric energy plus a volumetric one.

#include "ifsi/material/moduli.hpp"
#include "ifsi/material/solid_law.hpp"

namespace ifsi {

/// U(J) = kappa/2 ( (J^2 - 1)/2 - ln J ), in units of stress.
struct VolumetricEnergy {
  double kappa;

  template <class T>
  T U(const T& J) const {
    using std::log;
    return T(0.5 * kappa * (0.5 * (J * J - 1.0) - log(J)));
  }
  template <class T>
  T dU(const T& J) const {
    return T(0.5 * kappa * (J - 1.0 / J));
  }
  template <class T>
  T ddU(const T& J) const {
    return T(0.5 * kappa * (1.0 + 1.0 / (J * J)));
  }
};

/// psi = W(J^(-1/3) F) + U(J). `IsochoricPart` has psi, first_piola and tangent like a SolidLaw, and
/// shear_modulus().
template <class IsochoricPart>
class Uncoupled {
 public:
  using Isochoric = IsochoricPart;
  Isochoric isochoric;
  VolumetricEnergy volumetric;

  /// \throws Error (configuration) unless the bulk modulus kappa > 0.
  Uncoupled(Isochoric part, double kappa)
      : isochoric(part), volumetric{positive_modulus("bulk modulus kappa", kappa)} {}

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return isochoric.psi(F, X) + volumetric.U(det(F));
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    const T J = det(F);
    return isochoric.first_piola(F, X) + T(J * volumetric.dU(J)) * transpose(inverse(F));
  }
  /// With G = F^-T: d(U' J G) = (U'' J + U') J G (x) G - U' J G_iL G_kJ.
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    const Mat<T, n> G = transpose(inverse(F));
    const T J = det(F);
    const T JdU = J * volumetric.dU(J);
    const T a = J * J * volumetric.ddU(J) + JdU;
    return isochoric.tangent(F, X) + tangent_from<T, n>([&](int i, int M, int k, int L) {
             return T(a * G(i, M) * G(k, L) - JdU * G(i, L) * G(k, M));
           });
  }
  [[nodiscard]] double young_modulus() const {
    return ifsi::young_modulus(isochoric.shear_modulus(), volumetric.kappa);
  }
};

}  // namespace ifsi
