#pragma once
/// \file
/// How the elastic energy of a cell follows from its displacement: policies of the solid kernel.

#include <array>
#include <cmath>

#include "ifsi/material/solid_law.hpp"
#include "ifsi/solid/solid_point.hpp"

namespace ifsi {

/// What a formulation sees of a cell: deformation gradients, positions and volume elements at its points.
template <class T, int n, int dim, int n_points>
struct CellDeformation {
  std::array<Mat<T, n>, n_points> F;
  std::array<Vec<T, dim>, n_points> X;
  std::array<T, n_points> dV;
  std::array<Vec<T, n>, n_points> N, A;  ///< unit normal of a sheet, direction of fibres: where asked for
};

/// Second derivatives of an energy psi(F, theta).
template <class T, int n>
struct DilatedTangent {
  Tangent<T, n> FF;
  Mat<T, n> F_theta;
  T theta_theta;
};

namespace detail {
/// sigma = P F^T / J in all three directions.
template <class Law, class T, int n, int dim>
Mat<T, 3> cauchy(const Law& law, const Mat<T, n>& F_n, const Vec<T, dim>& X) {
  const Mat<T, 3> F = in_space(F_n, 1.0);
  return T(1.0 / det(F)) * (law.first_piola(F, X) * transpose(F));
}
}  // namespace detail

/// Energy, P and dP/dF from the law at each point on its own: exact for compressible solids, locks towards
/// incompressibility on elements of order 1.
struct Displacement {
  static constexpr bool mean_dilatation = false, sheet = false, fibred = false;

  template <SolidLaw Law, class T, int n, int dim, int n_points>
  class Response {
   public:
    using Cell = CellDeformation<T, n, dim, n_points>;
    Response(const Law& law, const Cell& cell) : law_(law), cell_(cell) {}

    [[nodiscard]] T energy(int q) const { return law_.psi(cell_.F[q], cell_.X[q]); }
    [[nodiscard]] Mat<T, n> first_piola(int q) const { return law_.first_piola(cell_.F[q], cell_.X[q]); }
    [[nodiscard]] Tangent<T, n> tangent(int q) const { return law_.tangent(cell_.F[q], cell_.X[q]); }
    /// Cauchy stress in all three directions.
    [[nodiscard]] Mat<T, 3> cauchy(int q) const { return detail::cauchy(law_, cell_.F[q], cell_.X[q]); }

   private:
    const Law& law_;
    const Cell& cell_;
  };
};

/// Laws that are told directions of the cell, a curved sheet of hexes: the direction of fibres, which is that
/// of the first local axis, and the normal of the sheet, whose plane is that of the first two.
template <bool sheet_, bool fibred_>
struct Directed {
  static constexpr bool mean_dilatation = false, sheet = sheet_, fibred = fibred_;

  template <SolidLaw Law, class T, int n, int dim, int n_points>
  class Response {
   public:
    using Cell = CellDeformation<T, n, dim, n_points>;
    Response(const Law& law, const Cell& cell) : law_(law), cell_(cell) {}

    [[nodiscard]] T energy(int q) const {
      return told(q, [&](const auto&... d) { return law_.psi(cell_.F[q], cell_.X[q], d...); });
    }
    [[nodiscard]] Mat<T, n> first_piola(int q) const {
      return told(q, [&](const auto&... d) { return law_.first_piola(cell_.F[q], cell_.X[q], d...); });
    }
    [[nodiscard]] Tangent<T, n> tangent(int q) const {
      return told(q, [&](const auto&... d) { return law_.tangent(cell_.F[q], cell_.X[q], d...); });
    }
    /// Cauchy stress.
    [[nodiscard]] Mat<T, 3> cauchy(int q) const {
      const Mat<T, n>& F = cell_.F[q];
      return T(1.0 / det(F)) * (first_piola(q) * transpose(F));
    }

   private:
    template <class Call>
    [[nodiscard]] auto told(int q, Call&& call) const {
      if constexpr (sheet && fibred) {
        return call(cell_.A[q], cell_.N[q]);
      } else if constexpr (sheet) {
        return call(cell_.N[q]);
      } else {
        return call(cell_.A[q]);
      }
    }

    const Law& law_;
    const Cell& cell_;
  };
};

using Sheet = Directed<true, false>;       ///< a law of thin sheets (eq. 29)
using Fibred = Directed<false, true>;      ///< a law with fibres (eq. 43)
using FibredSheet = Directed<true, true>;  ///< fibres in a thin sheet

namespace detail {

/// Energy psi(F, theta) of a law whose dilatation is replaced by theta, and its derivatives, at one point.
/// Any law: psi((theta/J)^(1/n) F), in the plane for plane strain.
template <SolidLaw Law, class T, int n, int dim>
class DilatedLaw {
 public:
  DilatedLaw(const Law& law, const Mat<T, n>& F, const Vec<T, dim>& X, const T& theta)
      : law_(law), F_(F), X_(X), theta_(theta) {
    using std::pow;
    scale_ = pow(T(theta / det(F)), 1.0 / n);
    F_bar_ = scale_ * F;
  }
  [[nodiscard]] T psi() const { return law_.psi(F_bar_, X_); }
  [[nodiscard]] Mat<T, 3> cauchy() const { return detail::cauchy(law_, F_bar_, X_); }

  /// First derivatives: psi_F = Q - t/n F^-T, psi_theta = t / (n theta), with Q = scale P(F_bar), t = Q : F.
  void first(Mat<T, n>& psi_F, T& psi_theta) const {
    const Mat<T, n> Q = scale_ * law_.first_piola(F_bar_, X_);
    const T mean = inner(Q, F_) / double(n);
    psi_F = Q - mean * transpose(inverse(F_));
    psi_theta = mean / theta_;
  }
  /// Second derivatives, by the chain rule through dF_bar = scale (dF - (G:dF)/n F + d theta/(n theta) F).
  [[nodiscard]] DilatedTangent<T, n> second() const {
    const Mat<T, n> G = transpose(inverse(F_));
    const Mat<T, n> Q = scale_ * law_.first_piola(F_bar_, X_);
    const Tangent<T, n> B = T(scale_ * scale_) * law_.tangent(F_bar_, X_);
    const Mat<T, n> M = contract(B, F_) + Q;  // B has major symmetry: F : B is the same as B : F
    const T t = inner(Q, F_), M_F = inner(F_, M), per_n = T(1.0 / n);
    DilatedTangent<T, n> psi;
    psi.FF = B + tangent_from<T, n>([&](int i, int J, int k, int L) {
               return T(per_n * (t * G(i, L) * G(k, J) - M(i, J) * G(k, L) - G(i, J) * M(k, L)) +
                        per_n * per_n * M_F * G(i, J) * G(k, L));
             });
    psi.F_theta = T(per_n / theta_) * (M - T(per_n * M_F) * G);
    psi.theta_theta = per_n / (theta_ * theta_) * (per_n * M_F - t);
    return psi;
  }

 private:
  const Law& law_;
  const Mat<T, n>& F_;
  const Vec<T, dim>& X_;
  T theta_, scale_;
  Mat<T, n> F_bar_;
};

/// Uncoupled laws: W(F) + U(theta), no mixed derivative.
template <UncoupledLaw Law, class T, int n, int dim>
class DilatedLaw<Law, T, n, dim> {
 public:
  DilatedLaw(const Law& law, const Mat<T, n>& F, const Vec<T, dim>& X, const T& theta)
      : law_(law), F_(F), X_(X), theta_(theta) {}
  [[nodiscard]] T psi() const { return law_.isochoric.psi(F_, X_) + law_.volumetric.U(theta_); }
  [[nodiscard]] Mat<T, 3> cauchy() const {
    return detail::cauchy(law_.isochoric, F_, X_) + law_.volumetric.dU(theta_) * Mat<T, 3>::identity();
  }
  void first(Mat<T, n>& psi_F, T& psi_theta) const {
    psi_F = law_.isochoric.first_piola(F_, X_);
    psi_theta = law_.volumetric.dU(theta_);
  }
  [[nodiscard]] DilatedTangent<T, n> second() const {
    return {law_.isochoric.tangent(F_, X_), Mat<T, n>::zero(), law_.volumetric.ddU(theta_)};
  }

 private:
  const Law& law_;
  const Mat<T, n>& F_;
  const Vec<T, dim>& X_;
  T theta_;
};

}  // namespace detail

/// Mean dilatation (Simo, Taylor & Pister 1985, doi:10.1016/0045-7825(85)90033-7): the three-field
/// functional with dilatation and pressure constant in the cell, both condensed. The energy is
/// sum_q psi(F_q, theta) dV_q with theta = int J dV / V, the mean volume ratio. For elements of order 1.
struct MeanDilatation {
  static constexpr bool mean_dilatation = true, sheet = false, fibred = false;

  template <SolidLaw Law, class T, int n, int dim, int n_points>
  class Response {
   public:
    using Cell = CellDeformation<T, n, dim, n_points>;

    Response(const Law& law, const Cell& cell) : law_(law), cell_(cell) {
      T V = T(0.0), v = T(0.0);
      for (int q = 0; q < n_points; ++q) {
        V += cell.dV[q];
        v += det(cell.F[q]) * cell.dV[q];
      }
      theta_ = v / V;
      T total = T(0.0);
      for (int q = 0; q < n_points; ++q) {
        at(q).first(psi_F_[q], psi_theta_);
        total += psi_theta_ * cell.dV[q];
      }
      psi_theta_ = tangent_pressure_ = total / V;
      inverse_V_ = T(1.0) / V;
    }

    [[nodiscard]] T energy(int q) const { return at(q).psi(); }
    /// psi_F + p dJ/dF, p the mean of psi_theta.
    [[nodiscard]] Mat<T, n> first_piola(int q) const { return psi_F_[q] + psi_theta_ * cofactor(q); }
    /// Second derivatives at point q, with p d2J/dF2 in FF. Through theta the points feel each other: see
    /// dtheta().
    [[nodiscard]] DilatedTangent<T, n> tangent(int q) const {
      DilatedTangent<T, n> psi = at(q).second();
      const Mat<T, n> G = transpose(inverse(cell_.F[q]));
      const T pJ = tangent_pressure_ * det(cell_.F[q]);
      psi.FF += tangent_from<T, n>(
          [&](int i, int J, int k, int L) { return T(pJ * (G(i, J) * G(k, L) - G(i, L) * G(k, J))); });
      return psi;
    }
    /// Pressure, the mean of psi_theta, after the linearised change dF of all deformation gradients.
    [[nodiscard]] T predicted_pressure(const std::array<Mat<T, n>, n_points>& dF) const {
      T d_theta = T(0.0), sum = T(0.0);
      for (int q = 0; q < n_points; ++q) d_theta += inner(dtheta(q), dF[q]);
      for (int q = 0; q < n_points; ++q) {
        const DilatedTangent<T, n> psi = at(q).second();
        sum += cell_.dV[q] * (inner(psi.F_theta, dF[q]) + psi.theta_theta * d_theta);
      }
      return psi_theta_ + inverse_V_ * sum;
    }
    /// Pressure to be used by tangent() instead of the present one.
    void set_tangent_pressure(const T& p) { tangent_pressure_ = p; }
    /// Cauchy stress in all three directions, the law's at the mean dilatation.
    [[nodiscard]] Mat<T, 3> cauchy(int q) const { return at(q).cauchy(); }

    /// d theta / dF at point q.
    [[nodiscard]] Mat<T, n> dtheta(int q) const { return T(inverse_V_ * cell_.dV[q]) * cofactor(q); }

   private:
    [[nodiscard]] detail::DilatedLaw<Law, T, n, dim> at(int q) const {
      return {law_, cell_.F[q], cell_.X[q], theta_};
    }
    /// dJ/dF = J F^-T.
    [[nodiscard]] Mat<T, n> cofactor(int q) const { return det(cell_.F[q]) * transpose(inverse(cell_.F[q])); }

    const Law& law_;
    const Cell& cell_;
    T theta_, psi_theta_, tangent_pressure_, inverse_V_;
    std::array<Mat<T, n>, n_points> psi_F_;
  };
};

}  // namespace ifsi
