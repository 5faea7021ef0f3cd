#pragma once
/// \file
/// Isochoric laws given by an energy W(I1bar, I2bar): stress and tangent from its derivatives.

#include "ifsi/material/uncoupled.hpp"

namespace ifsi {

/// First and second derivatives of an energy W(I1bar, I2bar).
template <class T>
struct InvariantSlopes {
  T W1, W2, W11, W12, W22;
};

/// The isochoric part of a law from `Energy`, which offers energy(I1, I2), slopes(I1, I2) and
/// shear_modulus(). I1bar = J^(-2/3) tr C and I2bar = J^(-4/3) (tr^2 C - tr C^2)/2, C = F^T F; in plane
/// strain the third stretch counts as 1.
template <class Energy>
class IsochoricInvariants {
 public:
  explicit IsochoricInvariants(Energy energy) : energy_(energy) {}

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>&) const {
    const Point<T, n> x(F);
    return energy_.energy(x.I1_bar, x.I2_bar);
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>&) const {
    const Point<T, n> x(F);
    const InvariantSlopes<T> W = energy_.slopes(x.I1_bar, x.I2_bar);
    return W.W1 * x.dI1_bar() + W.W2 * x.dI2_bar();
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>&) const {
    const Point<T, n> x(F);
    const InvariantSlopes<T> W = energy_.slopes(x.I1_bar, x.I2_bar);
    const Mat<T, n> a = x.dI1_bar(), b = x.dI2_bar();
    const Mat<T, n> Wa = W.W11 * a + W.W12 * b, Wb = W.W12 * a + W.W22 * b;
    Tangent<T, n> A = tangent_from<T, n>(
        [&](int i, int J, int k, int L) { return T(a(i, J) * Wa(k, L) + b(i, J) * Wb(k, L)); });
    x.add_second_I1_bar(A, W.W1);
    x.add_second_I2_bar(A, W.W2);
    return A;
  }
  [[nodiscard]] double shear_modulus() const { return energy_.shear_modulus(); }

 private:
  /// The invariants and their derivatives at one F. G = F^-T, H = I1 F - F C = dI2/dF / 2.
  template <class T, int n>
  struct Point {
    Mat<T, n> F, G, C, H;
    T s, I1, I2, I1_bar, I2_bar;

    explicit Point(const Mat<T, n>& F_) : F(F_), G(transpose(inverse(F_))), C(transpose(F_) * F_) {
      using std::pow;
      s = pow(det(F), -2.0 / 3.0);
      I1 = trace(C) + double(3 - n);
      I2 = 0.5 * (I1 * I1 - inner(C, C) - double(3 - n));
      H = I1 * F - F * C;
      I1_bar = s * I1;
      I2_bar = s * s * I2;
    }
    [[nodiscard]] Mat<T, n> dI1_bar() const { return T(2.0 * s) * (F - T(I1 / 3.0) * G); }
    [[nodiscard]] Mat<T, n> dI2_bar() const { return T(2.0 * s * s) * (H - T(2.0 / 3.0 * I2) * G); }

    /// A += W d2 I1bar / dF2.
    void add_second_I1_bar(Tangent<T, n>& A, const T& W) const {
      const T f = 2.0 * W * s, third = 1.0 / 3.0 * f;
      A += tangent_from<T, n>([&](int i, int J, int k, int L) {
        return T(third * (I1 * (2.0 / 3.0 * G(i, J) * G(k, L) + G(i, L) * G(k, J)) -
                          2.0 * (F(i, J) * G(k, L) + G(i, J) * F(k, L))));
      });
      add_identity(A, f);
    }
    /// A += W d2 I2bar / dF2.
    void add_second_I2_bar(Tangent<T, n>& A, const T& W) const {
      const T f = 2.0 * W * s * s;
      A += tangent_from<T, n>([&](int i, int J, int k, int L) {
        return T(f * (2.0 * F(i, J) * F(k, L) - F(i, L) * F(k, J) -
                      4.0 / 3.0 * (H(i, J) * G(k, L) + G(i, J) * H(k, L)) +
                      I2 * (8.0 / 9.0 * G(i, J) * G(k, L) + 2.0 / 3.0 * G(i, L) * G(k, J))));
      });
      add_identity(A, T(f * I1));
      add_geometric(A, T(-f) * C);
      add_spatial(A, T(-f) * (F * transpose(F)));
    }
  };

  Energy energy_;
};

}  // namespace ifsi
