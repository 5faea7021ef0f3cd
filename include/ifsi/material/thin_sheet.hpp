#pragma once
/// \file
/// Laws of thin bodies: plane stress, and next to no stiffness against transverse shear.

#include <algorithm>
#include <array>

#include "ifsi/material/moduli.hpp"
#include "ifsi/material/plane_stress.hpp"
#include "ifsi/material/solid_law.hpp"

namespace ifsi {

/// A law of the sheet's own plane, with little stiffness against shear through the thickness (eq. 29):
///
///     psi~(F) = min over d of psi(F Q + d (x) N) + shear / 2 |Q F^T F N|^2 + kappa / 4 (J^2 - 1 - 2 ln J),
///     Q = I - N (x) N
///
/// The director d replaces F N: stretched or bent, the sheet is in plane stress. In an immersed thin body
/// this cures two errors of a three-dimensional law. Its nodes move as the fluid's shape functions allow,
/// linearly within a cell, and a sheet thinner than a cell then bends with shear only, too stiff by the
/// square of the ratio of cell to thickness. And a bent body that the fluid keeps incompressible asks for a
/// pressure that jumps at its faces; a continuous pressure smears the jump over the cells outside. kappa
/// keeps det F near one, where the fluid's pressure alone does so in the mean of a cell.
template <SolidLaw Law>
class ThinSheet {
 public:
  /// \param normal unit normal N of the undeformed sheet
  /// \param shear, kappa stresses; of the order of 1/20 and 1/3 of Young's modulus
  /// \throws Error (configuration) unless both are positive and |normal| = 1
  ThinSheet(Law law, Vec<double, 3> normal, double shear, double kappa)
      : plane_(law),
        normal_(normal),
        shear_(positive_modulus("shear stiffness of a thin sheet", shear)),
        kappa_(positive_modulus("kappa of a thin sheet", kappa)) {
    if (!(std::abs(dot(normal, normal) - 1.0) < 1e-12))
      throw Error(ExitCode::configuration, "the normal of a thin sheet has the square " +
                                               std::to_string(dot(normal, normal)) + "; expected 1");
  }

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return psi(F, X, normal<T, n>());
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return first_piola(F, X, normal<T, n>());
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return tangent(F, X, normal<T, n>());
  }
  [[nodiscard]] double young_modulus() const { return plane_.young_modulus(); }

  // The same where the sheet is curved and the caller knows its unit normal N at X.
  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& N) const {
    using std::log;
    const Vec<T, n> g = shear_strain(F, N);
    const T J = det(F);
    return T(plane_.psi(plane_.relaxed(F, X, N), X, N) + 0.5 * shear_ * dot(g, g) +
             0.25 * kappa_ * (J * J - 1.0 - 2.0 * log(J)));
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& N) const {
    const Vec<T, n> g = shear_strain(F, N);
    const T J = det(F);
    return plane_.first_piola(plane_.relaxed(F, X, N), X, N) +
           T(shear_) * (outer(F * N, g) + outer(F * g, N)) +
           T(0.5 * kappa_ * (J * J - 1.0)) * transpose(inverse(F));
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& N) const {
    Tangent<T, n> A = plane_.tangent(plane_.relaxed(F, X, N), X, N);
    add_shear(F, N, A);
    const T J = det(F), k_2 = kappa_ * J * J, k_1 = 0.5 * kappa_ * (J * J - 1.0);
    const Mat<T, n> G = transpose(inverse(F));
    return A + tangent_from<T, n>([&](int i, int M, int k, int L) {
             return T(k_2 * G(i, M) * G(k, L) - k_1 * G(i, L) * G(k, M));
           });
  }

 private:
  template <class T, int n>
  [[nodiscard]] Vec<T, n> normal() const {
    Vec<T, n> N;
    for (int i = 0; i < n; ++i) N[i] = T(normal_[i]);
    return N;
  }
  /// Q F^T F N, twice the Green-Lagrange shear strains between the sheet's plane and its normal.
  template <class T, int n>
  [[nodiscard]] static Vec<T, n> shear_strain(const Mat<T, n>& F, const Vec<T, n>& N) {
    return PlaneStress<Law>::in_plane(N) * (transpose(F) * (F * N));
  }

  /// Of shear / 2 |g|^2, g = Q F^T F N.
  template <class T, int n>
  void add_shear(const Mat<T, n>& F, const Vec<T, n>& N, Tangent<T, n>& A) const {
    const Vec<T, n> f = F * N, g = shear_strain(F, N);
    const Mat<T, n> Q = PlaneStress<Law>::in_plane(N), F_Q = F * Q;
    for (int i = 0; i < n; ++i)
      for (int M = 0; M < n; ++M)
        for (int k = 0; k < n; ++k)
          for (int L = 0; L < n; ++L) {
            // dg_P/dF_kL = Q_PL f_k + F_kP N_L with P in the plane; g itself weighs the second derivatives
            T a = T(Q(M, L) * f[i] * f[k]) + T(f[i] * F_Q(k, M) * N[L]) + T(N[M] * F_Q(i, L) * f[k]);
            for (int P = 0; P < n; ++P) a += T(N[M] * N[L]) * F_Q(i, P) * F_Q(k, P);
            if (i == k) a += T(g[M] * N[L]) + T(N[M] * g[L]);
            A(i * n + M, k * n + L) += T(shear_ * a);
          }
  }

  PlaneStress<Law> plane_;
  Vec<double, 3> normal_;
  double shear_, kappa_;
};

}  // namespace ifsi
