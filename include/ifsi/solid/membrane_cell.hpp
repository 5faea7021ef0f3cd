#pragma once
/// \file
/// Element residual and tangent of an immersed membrane: one cell of a surface in space.
///
///     R(w) = int_A t [ (rho_s - rho_f) w.(a - g) + Grad w : P ] dA
///
/// over the reference surface A, t its thickness: (eq. 17) of a sheet in plane stress that keeps its volume,
/// without the viscosity of the fluid in its place.

#include <array>
#include <cmath>

#include "ifsi/element/geometry.hpp"
#include "ifsi/material/solid_law.hpp"
#include "ifsi/material/tangent.hpp"
#include "ifsi/quadrature/basis_table.hpp"
#include "ifsi/solid/solid_point.hpp"

namespace ifsi {

/// Nodal data of a cell, gathered by the caller: reference position, displacement, velocity, acceleration.
template <class Element>
struct MembraneCellData {
  std::array<Vec<double, 3>, Element::n_nodes> X, u, v, a;
};

/// The kernel of one cell. \tparam Element of two dimensions; \tparam Law as TensionFibres of PlaneStress:
/// asked with the direction of fibres, which is that of the first local axis, and the unit normal.
template <class Element, FibredSurfaceLaw Law>
class MembraneCell {
  static_assert(Element::dim == 2, "a membrane is meshed by cells of a surface");
  using Table = BasisTable<Element>;
  using Point = Vec<double, 3>;
  using Tensor = Mat<double, 3>;

 public:
  static constexpr int n_nodes = Element::n_nodes, n_points = Table::n_points;
  using Data = MembraneCellData<Element>;

  /// Kinematics at all points. \pre data and law outlive the cell
  MembraneCell(const Data& data, const Law& law, double thickness) : data_(data), law_(law) {
    for (int q = 0; q < n_points; ++q) evaluate_kinematics(q, thickness);
  }

  /// residual(a, R_a) receives the residual of node a.
  template <class Sink>
  void residual(const SolidParameters<3>& solid, Sink&& residual) const {
    std::array<Tensor, n_points> P;
    std::array<Point, n_points> b;
    for (int q = 0; q < n_points; ++q) {
      P[q] = dV_[q] * first_piola(q);
      b[q] = excess_mass(q, solid) * (interpolate(Table::N[q], data_.a) - solid.gravity);
    }
    for (int a = 0; a < n_nodes; ++a) {
      Point R = Point::zero();
      for (int q = 0; q < n_points; ++q) R += Table::N[q][a] * b[q] + P[q] * grad_N_[q][a];
      residual(a, R);
    }
  }

  /// tangent(a, b, K_ab) receives the block of each node pair.
  template <class Sink>
  void tangent(const SolidParameters<3>& solid, const StateSlopes& slopes, Sink&& tangent) const {
    std::array<Tangent<double, 3>, n_points> A;
    std::array<double, n_points> mass;
    for (int q = 0; q < n_points; ++q) {
      A[q] = (slopes.u * dV_[q]) * law_.tangent(F_[q], X_[q], A_[q], N_[q]);
      mass[q] = slopes.a * excess_mass(q, solid);
    }
    for (int b = 0; b < n_nodes; ++b) {
      std::array<Mat<double, 9, 3>, n_points> dP;  // of P with the displacement of node b
      for (int q = 0; q < n_points; ++q) dP[q] = contract_trial(A[q], grad_N_[q][b]);
      for (int a = 0; a < n_nodes; ++a) tangent(a, b, block(a, b, dP, mass));
    }
  }

  [[nodiscard]] const Tensor& deformation_gradient(int q) const { return F_[q]; }
  [[nodiscard]] double reference_volume(int q) const { return dV_[q]; }
  [[nodiscard]] Tensor green_lagrange(int q) const {
    return 0.5 * (transpose(F_[q]) * F_[q] - Tensor::identity());
  }
  /// sigma = P F^T / det F.
  [[nodiscard]] Tensor cauchy(int q) const {
    return (1.0 / det(F_[q])) * (first_piola(q) * transpose(F_[q]));
  }
  [[nodiscard]] double energy(int q) const { return law_.psi(F_[q], X_[q], A_[q], N_[q]); }
  [[nodiscard]] Point velocity(int q) const { return interpolate(Table::N[q], data_.v); }

 private:
  void evaluate_kinematics(int q, double thickness) {
    const Mat<double, 3, 2> J = jacobian(Table::dN[q], data_.X);
    const Point normal = area_normal(J), along{J(0, 0), J(1, 0), J(2, 0)};
    const double area = std::sqrt(dot(normal, normal));
    N_[q] = (1.0 / area) * normal;
    A_[q] = (1.0 / std::sqrt(dot(along, along))) * along;
    X_[q] = interpolate(Table::N[q], data_.X);
    dV_[q] = thickness * Table::weights[q] * area;
    // Gradients along the surface: dN/dX = J (J^T J)^-1 dN/dxi.
    const Mat<double, 3, 2> inverse_J = J * inverse(Mat<double, 2>(transpose(J) * J));
    Tensor F = Tensor::zero();
    for (int a = 0; a < n_nodes; ++a) {
      grad_N_[q][a] = inverse_J * Table::dN[q][a];
      F += outer(data_.X[a] + data_.u[a], grad_N_[q][a]);
    }
    F_[q] = law_.relaxed(F, X_[q], N_[q]);
  }
  [[nodiscard]] Tensor first_piola(int q) const { return law_.first_piola(F_[q], X_[q], A_[q], N_[q]); }
  [[nodiscard]] double excess_mass(int q, const SolidParameters<3>& solid) const {
    return (solid.rho_s - solid.rho_f) * dV_[q];
  }
  /// dP_iJ = A_iJkL grad_L for a displacement along k.
  static Mat<double, 9, 3> contract_trial(const Tangent<double, 3>& A, const Point& grad) {
    Mat<double, 9, 3> dP;
    for (int s = 0; s < 9; ++s)
      for (int k = 0; k < 3; ++k)
        dP(s, k) = A(s, 3 * k) * grad[0] + A(s, 3 * k + 1) * grad[1] + A(s, 3 * k + 2) * grad[2];
    return dP;
  }
  [[nodiscard]] Tensor block(int a, int b, const std::array<Mat<double, 9, 3>, n_points>& dP,
                             const std::array<double, n_points>& mass) const {
    Tensor K = Tensor::zero();
    for (int q = 0; q < n_points; ++q) {
      const Point& w = grad_N_[q][a];
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          K(i, k) += w[0] * dP[q](3 * i, k) + w[1] * dP[q](3 * i + 1, k) + w[2] * dP[q](3 * i + 2, k);
      add_to_diagonal(K, Table::N[q][a] * Table::N[q][b] * mass[q]);
    }
    return K;
  }

  const Data& data_;
  const Law& law_;
  std::array<std::array<Point, n_nodes>, n_points> grad_N_;
  std::array<Point, n_points> X_, N_, A_;
  std::array<Tensor, n_points> F_;
  std::array<double, n_points> dV_;
};

}  // namespace ifsi
