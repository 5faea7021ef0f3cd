#pragma once
/// \file
/// A law of three dimensions in a surface that nothing pulls at across.

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "ifsi/material/solid_law.hpp"
#include "ifsi/material/tangent.hpp"

namespace ifsi {

/// Plane stress of a law in a surface of unit normal N, Q = I - N (x) N:
///
///     psi_2(F Q) = min over d of psi(F Q + d (x) N)
///
/// The director d, where it is least, takes the place of F N, which counts for nothing. relaxed() finds it;
/// all else is asked of a deformation gradient that relaxed() returned.
template <SolidLaw Law>
class PlaneStress {
 public:
  explicit PlaneStress(Law law) : law_(law) {}

  /// F Q + d (x) N with the director of least energy, by Newton's method from along the normal.
  /// \pre F Q stretches no line of the surface to nothing and some director balances it; that of
  /// StVenantKirchhoff does not where the squares of both stretches add up to more than 1 + 1 / nu
  template <class T, int n, int dim>
  [[nodiscard]] Mat<T, n> relaxed(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& N) const {
    using std::min, std::sqrt;
    const Mat<T, n> F_Q = F * in_plane(N);
    Vec<T, n> d = cofactor(F_Q) * N;
    // No longer than the normal, nor than what keeps the volume: from beyond J = e a logarithm of J would
    // make Newton's method run away.
    const T area_2 = dot(d, d);
    d = T(min(T(1.0 / sqrt(area_2)), T(1.0 / area_2))) * d;
    // Quadratic: round-off after 4 at strains of 10 %. A number stops there, at stretches of 4 after 10.
    constexpr int iterations = std::is_same_v<T, double> ? 30 : 10;
    for (int k = 0; k < iterations; ++k) {
      const Mat<T, n> F_d = F_Q + outer(d, N);
      const Vec<T, n> step =
          inverse(normal_stiffness(law_.tangent(F_d, X), N)) * (law_.first_piola(F_d, X) * N);
      // By half of its length at most, so that no stretch of the plane turns the sheet inside out.
      const T part = min(T(1.0), T(0.5 * sqrt(dot(d, d) / (dot(step, step) + 1e-300))));
      d = d - part * step;
      if constexpr (std::is_same_v<T, double>)
        if (dot(step, step) < 1e-18 * dot(d, d)) break;  // what is left is of the order of its square
    }
    return F_Q + outer(d, N);
  }

  template <class T, int n, int dim>
  [[nodiscard]] T psi(const Mat<T, n>& F_d, const Vec<T, dim>& X, const Vec<T, n>&) const {
    return law_.psi(F_d, X);
  }
  template <class T, int n, int dim>
  [[nodiscard]] Mat<T, n> first_piola(const Mat<T, n>& F_d, const Vec<T, dim>& X, const Vec<T, n>& N) const {
    return law_.first_piola(F_d, X) * in_plane(N);
  }
  /// In the plane, less what the director yields: A_QQ - A_QN (A_NN)^-1 A_NQ.
  template <class T, int n, int dim>
  [[nodiscard]] Tangent<T, n> tangent(const Mat<T, n>& F_d, const Vec<T, dim>& X, const Vec<T, n>& N) const {
    const Tangent<T, n> A = law_.tangent(F_d, X);
    const Mat<T, n> Q = in_plane(N), K_inverse = inverse(normal_stiffness(A, N));
    std::array<Mat<T, n>, n> A_N;  // per k: A_iMkL N_L, M in the plane
    for (int k = 0; k < n; ++k) {
      A_N[k] = Mat<T, n>::zero();
      for (int i = 0; i < n; ++i)
        for (int M = 0; M < n; ++M)
          for (int L = 0; L < n; ++L) A_N[k](i, M) += N[L] * A(i * n + M, k * n + L);
      A_N[k] = A_N[k] * Q;
    }
    return tangent_from<T, n>([&](int i, int M, int k, int L) {
      T a = T(0.0);
      for (int P = 0; P < n; ++P)
        for (int R = 0; R < n; ++R) {
          a += A(i * n + P, k * n + R) * Q(P, M) * Q(R, L);
          a -= A_N[P](i, M) * K_inverse(P, R) * A_N[R](k, L);
        }
      return a;
    });
  }
  [[nodiscard]] double young_modulus() const { return law_.young_modulus(); }

  /// Q.
  template <class T, int n>
  [[nodiscard]] static Mat<T, n> in_plane(const Vec<T, n>& N) {
    return Mat<T, n>::identity() - outer(N, N);
  }

 private:
  /// A_iMkL N_M N_L.
  template <class T, int n>
  [[nodiscard]] static Mat<T, n> normal_stiffness(const Tangent<T, n>& A, const Vec<T, n>& N) {
    Mat<T, n> K = Mat<T, n>::zero();
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k)
        for (int M = 0; M < n; ++M)
          for (int L = 0; L < n; ++L) K(i, k) += T(N[M] * N[L]) * A(i * n + M, k * n + L);
    return K;
  }

  Law law_;
};

}  // namespace ifsi
