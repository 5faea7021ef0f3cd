#pragma once
/// \file
/// Loads on one boundary face of a solid, as residual contributions -int w . h with their tangents.

#include <cmath>

#include "ifsi/element/geometry.hpp"
#include "ifsi/quadrature/basis_table.hpp"
#include "ifsi/quadrature/coordinates.hpp"

namespace ifsi {

/// Residual and tangent of a face; K[a][b] = dR_a / d(unknown_b).
template <class Face>
struct FaceResidual {
  static constexpr int n = Face::n_nodes, dim = Face::dim + 1;
  std::array<Vec<double, dim>, n> R;
  std::array<std::array<Mat<double, dim>, n>, n> K;
};

/// A face of a solid with reference nodes X.
template <ReferenceElement Face, class Coordinates = Cartesian>
class SurfaceLoad {
  static constexpr int n = Face::n_nodes, dim = Face::dim + 1;
  using Table = BasisTable<Face>;
  using Nodes = std::array<Vec<double, dim>, n>;

 public:
  /// Traction (force per *reference* area) that keeps its direction: R_a = -int N_a traction dA.
  static FaceResidual<Face> dead(const Nodes& X, const Vec<double, dim>& traction) {
    FaceResidual<Face> r{};
    for (int q = 0; q < Table::n_points; ++q) {
      const Vec<double, dim> normal = area_normal(jacobian(Table::dN[q], X));
      const double dA = Table::weights[q] * measure(q, X) * std::sqrt(dot(normal, normal));
      for (int a = 0; a < n; ++a) r.R[a] -= (Table::N[q][a] * dA) * traction;
    }
    return r;
  }

  /// Pressure (force per *current* area, against the outward normal): R_a = int N_a p n da, with x the
  /// current nodes and slope = du/d(unknown).
  static FaceResidual<Face> pressure(const Nodes& x, double p, double slope) {
    FaceResidual<Face> r{};
    for (int q = 0; q < Table::n_points; ++q) {
      const auto J = jacobian(Table::dN[q], x);
      const Vec<double, dim> n_da = area_normal(J);
      const double p_w = p * Table::weights[q], m = measure(q, x);
      for (int a = 0; a < n; ++a) {
        const double w = p_w * Table::N[q][a];
        r.R[a] += (w * m) * n_da;
        for (int b = 0; b < n; ++b) {
          r.K[a][b] += (slope * w * m) * normal_slope(J, Table::dN[q][b]);
          if constexpr (Coordinates::axisymmetric)
            for (int i = 0; i < dim; ++i)
              r.K[a][b](i, 0) += slope * w * Coordinates::measure(Table::N[q][b]) * n_da[i];
        }
      }
    }
    return r;
  }

 private:
  static double measure(int q, const Nodes& x) {
    return Coordinates::measure(interpolate(Table::N[q], x)[0]);
  }

  /// d(area_normal)_i / dx_k for the node whose shape function has the derivatives dN.
  static Mat<double, 2> normal_slope(const Mat<double, 2, 1>&, const Vec<double, 1>& dN) {
    return {0, dN[0], -dN[0], 0};
  }
  static Mat<double, 3> normal_slope(const Mat<double, 3, 2>& J, const Vec<double, 2>& dN) {
    Mat<double, 3> D;  // x_,xi x (dN_eta e_k) + (dN_xi e_k) x x_,eta
    for (int k = 0; k < 3; ++k) {
      Mat<double, 3, 2> J_k = J, J_xi = J;
      for (int i = 0; i < 3; ++i) {
        J_k(i, 1) = i == k ? dN[1] : 0;
        J_xi(i, 0) = i == k ? dN[0] : 0;
      }
      const Vec<double, 3> d = area_normal(J_k) + area_normal(J_xi);
      for (int i = 0; i < 3; ++i) D(i, k) = d[i];
    }
    return D;
  }
};

}  // namespace ifsi
