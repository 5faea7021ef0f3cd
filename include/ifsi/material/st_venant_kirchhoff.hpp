#pragma once
/// \file
/// St Venant-Kirchhoff solid: large rotations, small strains.

#include "ifsi/material/moduli.hpp"
#include "ifsi/material/solid_law.hpp"

namespace ifsi {

/// psi = mu E:E + lambda/2 (tr E)^2 with the Green-Lagrange strain E = (F^T F - I)/2.
/// It softens under strong compression: det F -> 0 costs finite energy.
class StVenantKirchhoff {
 public:
  /// \throws Error (configuration) when mu or the bulk modulus is not positive.
  explicit StVenantKirchhoff(Lame lame) : mu_(lame.checked().mu), lambda_(lame.lambda) {}

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>&) const {
    const Mat<T, n> E = green_lagrange(F);
    const T tr_E = trace(E);
    return T(mu_ * inner(E, E) + 0.5 * lambda_ * tr_E * tr_E);
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>&) const {
    return F * second_piola(F);
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>&) const {
    const Mat<T, n> mu_B = mu_ * (F * transpose(F));
    Tangent<T, n> A = tangent_from<T, n>(
        [&](int i, int J, int k, int L) { return T(lambda_ * F(i, J) * F(k, L) + mu_ * F(i, L) * F(k, J)); });
    add_spatial(A, mu_B);
    add_geometric(A, second_piola(F));
    return A;
  }
  [[nodiscard]] double young_modulus() const { return Lame{mu_, lambda_}.young_modulus(); }

 private:
  template <class T, int n>
  static Mat<T, n> green_lagrange(const Mat<T, n>& F) {
    return 0.5 * (transpose(F) * F - Mat<T, n>::identity());
  }
  /// S = 2 mu E + lambda tr(E) I.
  template <class T, int n>
  Mat<T, n> second_piola(const Mat<T, n>& F) const {
    const Mat<T, n> E = green_lagrange(F);
    return (2 * mu_) * E + T(lambda_ * trace(E)) * Mat<T, n>::identity();
  }

  double mu_;
  double lambda_;
};

}  // namespace ifsi
