#pragma once
/// \file
/// Tissue with fibres that carry tension and nothing else.

#include <algorithm>
#include <cmath>
#include <string>

#include "ifsi/core/error.hpp"
#include "ifsi/material/moduli.hpp"
#include "ifsi/material/solid_law.hpp"

namespace ifsi {

/// A law for the matrix, and fibres in one direction (eq. 43):
///
///     psi(F) = psi_matrix(F) + E_f / (2 a) (exp(a e^2) - 1),    e = max(|F A|^2 - 1, 0) / 2,
///
/// and E_f e^2 / 2, its limit, for a = 0. A is the unit direction of the fibres in the undeformed body, e
/// their Green-Lagrange strain, E_f their modulus at small stretch, a how fast they stiffen. Shorter than
/// undeformed they are slack, as the collagen of a leaflet is while the leaflet turns inside out: it opens as
/// softly as its matrix allows and still holds the pressure when it is closed. In a sheet of known normal N a
/// second family, with a modulus of its own, runs along N x A.
template <class Law>
requires SolidLaw<Law> || SurfaceLaw<Law>
class TensionFibres {
 public:
  /// \param modulus E_f, a stress
  /// \param direction where the caller knows no other
  /// \param stiffening a
  /// \param across E_f of the second family of a sheet
  /// \throws Error (configuration) for a negative number
  TensionFibres(Law law, double modulus, Vec<double, 3> direction, double stiffening = 0.0,
                double across = 0.0)
      : law_(law),
        modulus_(not_negative("modulus of fibres", modulus)),
        stiffening_(not_negative("stiffening of fibres", stiffening)),
        across_(not_negative("modulus of fibres across", across)),
        direction_(direction) {}

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return psi(F, X, direction<T, n>());
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return first_piola(F, X, direction<T, n>());
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return tangent(F, X, direction<T, n>());
  }
  [[nodiscard]] double young_modulus() const { return law_.young_modulus(); }

  // The same where the caller knows the direction A at X, and what the matrix asks for (a sheet: its normal).
  template <class T, int n, int dim, class... Known>
  T psi(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& A, const Known&... of_matrix) const {
    T sum = law_.psi(F, X, of_matrix...);
    for_each_family(A, of_matrix..., [&](double E_f, const Vec<T, n>& D) {
      const T e = strain(F, D);
      sum += E_f * (stiffening_ > 0.0 ? T((growth(e) - 1.0) / (2.0 * stiffening_)) : T(0.5 * e * e));
    });
    return sum;
  }
  template <class T, int n, int dim, class... Known>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& A,
                        const Known&... of_matrix) const {
    Mat<T, n> P = law_.first_piola(F, X, of_matrix...);
    for_each_family(A, of_matrix..., [&](double E_f, const Vec<T, n>& D) {
      const T e = strain(F, D);
      P += T(E_f * e * growth(e)) * outer(F * D, D);
    });
    return P;
  }
  template <class T, int n, int dim, class... Known>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& A,
                        const Known&... of_matrix) const {
    Tangent<T, n> K = law_.tangent(F, X, of_matrix...);
    for_each_family(A, of_matrix..., [&](double E_f, const Vec<T, n>& D) {
      const Vec<T, n> d = F * D;
      const T e = strain(F, D), taut = e / (e + 1e-14);  // 1 or 0
      const T S = E_f * e * growth(e);
      const T dS_de = E_f * taut * (1.0 + 2.0 * stiffening_ * e * e) * growth(e);
      K += tangent_from<T, n>(
          [&](int i, int J, int k, int L) { return T(dS_de * d[i] * D[J] * d[k] * D[L]); });
      add_geometric(K, S * outer(D, D));
    });
    return K;
  }

  /// In a surface (PlaneStress): fibres lie in its plane, where the director does not stretch them.
  template <class T, int n, int dim>
  [[nodiscard]] Mat<T, n> relaxed(const Mat<T, n>& F, const Vec<T, dim>& X,
                                  const Vec<T, n>& N) const requires SurfaceLaw<Law> {
    return law_.relaxed(F, X, N);
  }

 private:
  static double not_negative(const char* what, double value) {
    if (value >= 0.0) return value;
    throw Error(ExitCode::configuration,
                std::string(what) + " = " + std::to_string(value) + "; expected 0 or more");
  }
  template <class T, int n>
  [[nodiscard]] Vec<T, n> direction() const {
    Vec<T, n> A;
    for (int i = 0; i < n; ++i) A[i] = T(direction_[i]);
    return A;
  }
  /// visit(E_f, direction) for those along A, and those across where the normal is known.
  template <class T, int n, class Visit>
  void for_each_family(const Vec<T, n>& A, Visit&& visit) const {
    visit(modulus_, A);
  }
  template <class T, int n, class Visit>
  void for_each_family(const Vec<T, n>& A, const Vec<T, n>& N, Visit&& visit) const {
    visit(modulus_, A);
    if constexpr (n == 3)
      if (across_ > 0.0) visit(across_, cross(N, A));
  }
  /// e.
  template <class T, int n>
  [[nodiscard]] static T strain(const Mat<T, n>& F, const Vec<T, n>& A) {
    using std::max;
    const Vec<T, n> a = F * A;
    return max(T(0.5 * (dot(a, a) - 1.0)), T(0.0));
  }
  /// exp(a e^2).
  template <class T>
  [[nodiscard]] T growth(const T& e) const {
    using std::exp;
    return stiffening_ > 0.0 ? T(exp(T(stiffening_ * e * e))) : T(1.0);
  }

  Law law_;
  double modulus_, stiffening_, across_;
  Vec<double, 3> direction_;
};

}  // namespace ifsi
