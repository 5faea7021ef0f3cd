#pragma once
/// \file
/// Nearly incompressible neo-Hookean solid.

#include "ifsi/material/uncoupled.hpp"

namespace ifsi {

/// W = C0/2 (I1bar - 3), I1bar = J^(-2/3) tr(F^T F); in plane strain the third stretch counts as 1.
class IsochoricNeoHookean {
 public:
  /// C0 is the shear modulus. \throws Error (configuration) unless C0 > 0.
  explicit IsochoricNeoHookean(double C0) : C0_(positive_modulus("shear modulus C0", C0)) {}

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>&) const {
    return T(0.5 * (scale(F) * I1(F) - 3.0 * C0_));
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>&) const {
    const Mat<T, n> F_inv_T = transpose(inverse(F));
    return scale(F) * (F - T(I1(F) / 3.0) * F_inv_T);
  }
  /// dP/dF = C0 J^(-2/3) [ I - 2/3 (F (x) G + G (x) F) + 2/9 I1 G (x) G + 1/3 I1 G_iL G_kJ ], G = F^-T.
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>&) const {
    const T s = scale(F), third_I1 = s * I1(F) / 3.0;
    const Mat<T, n> G = transpose(inverse(F)), H = T(2.0 / 3.0 * s) * F;
    const Mat<T, n> D = T(2.0 / 3.0 * third_I1) * G - H;
    Tangent<T, n> A = tangent_from<T, n>([&](int i, int J, int k, int L) {
      return T(G(i, J) * D(k, L) - H(i, J) * G(k, L) + third_I1 * G(i, L) * G(k, J));
    });
    add_identity(A, s);
    return A;
  }
  [[nodiscard]] double shear_modulus() const { return C0_; }

 private:
  /// C0 J^(-2/3).
  template <class T, int n>
  T scale(const Mat<T, n>& F) const {
    using std::pow;
    return T(C0_ * pow(det(F), -2.0 / 3.0));
  }
  template <class T, int n>
  static T I1(const Mat<T, n>& F) {
    return T(inner(F, F) + double(3 - n));
  }

  double C0_;
};

/// psi = C0/2 (I1bar - 3) + kappa/2 ( (J^2 - 1)/2 - ln J ).
struct UncoupledNeoHookean : Uncoupled<IsochoricNeoHookean> {
  UncoupledNeoHookean(double C0, double kappa) : Uncoupled(IsochoricNeoHookean(C0), kappa) {}
};

}  // namespace ifsi
