#pragma once
/// \file
/// Tissue with fibres that carry tension and nothing else.

#include <algorithm>
#include <array>

#include "ifsi/material/moduli.hpp"
#include "ifsi/material/solid_law.hpp"

namespace ifsi {

/// A law for the matrix, and fibres in one direction (eq. 43):
///
///     psi(F) = psi_matrix(F) + E_f / 8 max(|F A|^2 - 1, 0)^2
///
/// A is the unit direction of the fibres in the undeformed body, E_f their modulus at small stretch. Shorter
/// than undeformed they are slack, as the collagen of a leaflet is while the leaflet turns inside out: it
/// opens as softly as its matrix allows and still holds the pressure when it is closed.
template <SolidLaw Law>
class TensionFibres {
 public:
  /// \param direction where the caller knows no other \throws Error (configuration) for a negative modulus
  TensionFibres(Law law, double modulus, Vec<double, 3> direction)
      : law_(law), modulus_(modulus), direction_(direction) {
    if (!(modulus >= 0.0))
      throw Error(ExitCode::configuration,
                  "modulus of fibres = " + std::to_string(modulus) + "; expected 0 or more");
  }

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
    const T s = stretched(F, A);
    return T(law_.psi(F, X, of_matrix...) + 0.125 * modulus_ * s * s);
  }
  template <class T, int n, int dim, class... Known>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& A,
                        const Known&... of_matrix) const {
    return law_.first_piola(F, X, of_matrix...) + T(0.5 * modulus_ * stretched(F, A)) * outer(F * A, A);
  }
  template <class T, int n, int dim, class... Known>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>& X, const Vec<T, n>& A,
                        const Known&... of_matrix) const {
    Tangent<T, n> K = law_.tangent(F, X, of_matrix...);
    const Vec<T, n> a = F * A;
    const T s = stretched(F, A), taut = s / (s + 1e-14);  // 1 or 0
    K += tangent_from<T, n>(
        [&](int i, int J, int k, int L) { return T(modulus_ * taut * a[i] * A[J] * a[k] * A[L]); });
    add_geometric(K, T(0.5 * modulus_ * s) * outer(A, A));
    return K;
  }

 private:
  template <class T, int n>
  [[nodiscard]] Vec<T, n> direction() const {
    Vec<T, n> A;
    for (int i = 0; i < n; ++i) A[i] = T(direction_[i]);
    return A;
  }
  /// max(|F A|^2 - 1, 0).
  template <class T, int n>
  [[nodiscard]] static T stretched(const Mat<T, n>& F, const Vec<T, n>& A) {
    using std::max;
    const Vec<T, n> a = F * A;
    return max(T(dot(a, a) - 1.0), T(0.0));
  }

  Law law_;
  double modulus_;
  Vec<double, 3> direction_;
};

}  // namespace ifsi
