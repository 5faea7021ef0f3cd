#pragma once
/// \file
/// Compressible neo-Hookean solid.

#include "ifsi/material/moduli.hpp"
#include "ifsi/material/solid_law.hpp"

namespace ifsi {

/// psi = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2
/// (Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., eq. 6.27).
class NeoHookean {
 public:
  /// \throws Error (configuration) when mu or the bulk modulus is not positive.
  explicit NeoHookean(Lame lame) : mu_(lame.checked().mu), lambda_(lame.lambda) {}

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>&) const {
    using std::log;
    const T ln_J = log(det(F));
    return T(0.5 * mu_ * (inner(F, F) - double(n)) - mu_ * ln_J + 0.5 * lambda_ * ln_J * ln_J);
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>&) const {
    using std::log;
    const T ln_J = log(det(F));
    const Mat<T, n> F_inv_T = transpose(inverse(F));
    return mu_ * F + T(lambda_ * ln_J - mu_) * F_inv_T;
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>&) const {
    using std::log;
    const Mat<T, n> G = transpose(inverse(F));
    const T m = mu_ - lambda_ * log(det(F));
    Tangent<T, n> A = tangent_from<T, n>(
        [&](int i, int J, int k, int L) { return T(lambda_ * G(i, J) * G(k, L) + m * G(i, L) * G(k, J)); });
    add_identity(A, T(mu_));
    return A;
  }
  [[nodiscard]] double young_modulus() const { return Lame{mu_, lambda_}.young_modulus(); }

 private:
  double mu_;
  double lambda_;
};

}  // namespace ifsi
