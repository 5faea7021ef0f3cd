#pragma once
/// \file
/// Element residual and tangent of the immersed solid: one cell, or W cells at once when T is a Pack<W>.

#include <algorithm>
#include <type_traits>

#include "ifsi/element/geometry.hpp"
#include "ifsi/quadrature/basis_table.hpp"
#include "ifsi/quadrature/coordinates.hpp"
#include "ifsi/solid/formulation.hpp"
#include "ifsi/solid/solid_point.hpp"

namespace ifsi {

/// Nodal data of a cell, gathered by the caller: reference position, displacement, velocity, acceleration.
template <class Element, class T>
struct SolidCellData {
  static constexpr int n = Element::n_nodes, dim = Element::dim;
  std::array<Vec<T, dim>, n> X, u, v, a;
};

/// What a cell adds to the balances of the body.
template <class T, int dim>
struct SolidCellTotals {
  T volume, reference_volume, elastic, kinetic;
  Vec<T, dim> momentum;
  T min_det_F;
};

/// The solid kernel of one cell.
template <class Element, class Law, class Formulation, class Coordinates, class Rule, class T>
class SolidCell {
  static constexpr bool axisymmetric = Coordinates::axisymmetric;
  static constexpr int n_nodes = Element::n_nodes, dim = Element::dim, n_points = Rule::n;
  static constexpr int n = axisymmetric ? 3 : dim;  ///< rows of F
  /// Entries of F that a displacement can change: all dim x dim, and the hoop stretch F_33.
  static constexpr int n_slots = dim * dim + (axisymmetric ? 1 : 0);
  static constexpr int hoop_slot = dim * dim;
  static constexpr bool mean_dilatation = Formulation::mean_dilatation;
  static_assert(!axisymmetric || dim == 2, "bodies of revolution are meshed in (r, z)");
  static_assert(!Formulation::sheet || (dim == 3 && Element::n_nodes != 4 && Element::n_nodes != 10),
                "curved sheets are meshed by hexes or wedges");
  static_assert(!mean_dilatation || Element::order == 1, "mean dilatation is for elements of order 1");

  using Table = BasisTable<Element, Rule>;
  using Data = SolidCellData<Element, T>;
  using Response = typename Formulation::template Response<Law, T, n, dim, n_points>;
  using Stresses = std::array<Mat<T, n>, n_points>;

 public:
  /// Kinematics at all points. \pre the law outlives the cell
  SolidCell(const Data& cell, const Law& law) : cell_(cell), law_(law) {
    using std::min;
    for (int q = 0; q < n_points; ++q) evaluate_kinematics(q);
    min_det_F_ = det(deformation_.F[0]);
    for (int q = 1; q < n_points; ++q) min_det_F_ = min(min_det_F_, det(deformation_.F[q]));
  }

  /// Smallest volume ratio; when it is not positive (in a lane), the other results are meaningless (there).
  [[nodiscard]] T min_det_F() const { return min_det_F_; }

  /// sink(a, R_a) receives the residual of node a.
  template <class Sink>
  void residual(const SolidParameters<dim>& solid, Sink&& sink) const {
    residual_of_nodes(stresses(solid, Response(law_, deformation_)), solid, sink);
  }

  /// Also tangent(a, b, K_ab): the dim x dim block of each node pair.
  /// Mean dilatation only: a pressure to take the place of the present one in the geometric part of the
  /// tangent, see predicted_pressure.
  template <class ResidualSink, class TangentSink>
  void residual_and_tangent(const SolidParameters<dim>& solid, const StateSlopes& slopes,
                            ResidualSink&& residual, TangentSink&& tangent,
                            const T* pressure = nullptr) const {
    Response response(law_, deformation_);
    residual_of_nodes(stresses(solid, response), solid, residual);
    if constexpr (mean_dilatation)
      if (pressure != nullptr) response.set_tangent_pressure(*pressure);
    const Stiffness stiffness(*this, solid, slopes, response);
    for (int b = 0; b < n_nodes; ++b) {
      const auto trial = stiffness.trial(b);
      for (int a = 0; a < n_nodes; ++a) tangent(a, b, stiffness.block(a, b, trial));
    }
  }

  /// Pressure (positive in tension) that the linearisation here predicts for the displacement u + du.
  ///
  /// A Newton step that rotates nearly incompressible material changes its volume by the square of the
  /// rotation; the pressure of that spoils the next tangent. With the pressure predicted here in the
  /// geometric part of that tangent (residual and solution are the same) the iteration is that of the mixed
  /// method with the pressure as an unknown of its own, and converges over far larger steps.
  [[nodiscard]] T predicted_pressure(const std::array<Vec<T, dim>, n_nodes>& du) const
      requires(mean_dilatation) {
    std::array<Mat<T, n>, n_points> dF;
    for (int q = 0; q < n_points; ++q) dF[q] = gradient(q, du);
    return Response(law_, deformation_).predicted_pressure(dF);
  }

  /// Volume, energies and momentum of the solid itself (density rho_s).
  [[nodiscard]] SolidCellTotals<T, dim> totals(const SolidParameters<dim>& solid) const {
    const Response response(law_, deformation_);
    SolidCellTotals<T, dim> sum{T(0.0), T(0.0), T(0.0), T(0.0), Vec<T, dim>::zero(), min_det_F_};
    for (int q = 0; q < n_points; ++q) {
      const Vec<T, dim> v = interpolate(Table::N[q], cell_.v);
      const T dV = deformation_.dV[q], dm = solid.rho_s * dV;
      sum.reference_volume += dV;
      sum.volume += det(deformation_.F[q]) * dV;
      sum.elastic += response.energy(q) * dV;
      sum.kinetic += 0.5 * dot(v, v) * dm;
      sum.momentum += dm * v;
    }
    return sum;
  }

  /// Deformation gradient at point q in all three directions.
  [[nodiscard]] Mat<T, 3> deformation_gradient(int q) const { return in_space(deformation_.F[q], 1.0); }
  /// E = (F^T F - I) / 2 at point q.
  [[nodiscard]] Mat<T, 3> green_lagrange(int q) const {
    const Mat<T, 3> F = deformation_gradient(q);
    return T(0.5) * (transpose(F) * F - Mat<T, 3>::identity());
  }
  [[nodiscard]] T reference_volume(int q) const { return deformation_.dV[q]; }
  /// Elastic Cauchy stress at each point in all three directions.
  [[nodiscard]] std::array<Mat<T, 3>, n_points> cauchy_stresses() const {
    const Response response(law_, deformation_);
    std::array<Mat<T, 3>, n_points> sigma;
    for (int q = 0; q < n_points; ++q) sigma[q] = response.cauchy(q);
    return sigma;
  }

 private:
  /// dF/du_b,k at a point: grad_N in row k, and N/R in F_33 for the radial displacement.
  struct Gradient {
    Vec<T, dim> grad;
    T hoop;
  };

  void evaluate_kinematics(int q) {
    const Mat<T, dim> J = jacobian(Table::dN[q], cell_.X);
    const auto grad_N = physical_gradients(Table::dN[q], inverse(J));
    const Vec<T, dim> X = interpolate(Table::N[q], cell_.X);
    for (int a = 0; a < n_nodes; ++a) {
      grad_N_[q][a].grad = grad_N[a];
      if constexpr (axisymmetric) grad_N_[q][a].hoop = Table::N[q][a] / X[0];
    }
    deformation_.X[q] = X;
    if constexpr (Formulation::sheet) deformation_.N[q] = unit_normal(J);
    if constexpr (Formulation::fibred) deformation_.A[q] = unit_tangent(J);
    deformation_.dV[q] = Table::weights[q] * det(J) * Coordinates::measure(X[0]);
    deformation_.F[q] = gradient(q, cell_.u) + Mat<T, n>::identity();
  }

  /// Of the surface along the first two local axes.
  [[nodiscard]] static Vec<T, dim> unit_normal(const Mat<T, dim>& J) {
    using std::sqrt;
    const Mat<T, dim> G = transpose(inverse(J));  // grad of the third local coordinate in its third column
    const Vec<T, dim> N{G(0, 2), G(1, 2), G(2, 2)};
    return T(1.0 / sqrt(dot(N, N))) * N;
  }

  /// Of the first local axis.
  [[nodiscard]] static Vec<T, dim> unit_tangent(const Mat<T, dim>& J) {
    using std::sqrt;
    Vec<T, dim> A;
    for (int i = 0; i < dim; ++i) A[i] = J(i, 0);
    return T(1.0 / sqrt(dot(A, A))) * A;
  }

  /// Reference gradient of a nodal vector field.
  [[nodiscard]] Mat<T, n> gradient(int q, const std::array<Vec<T, dim>, n_nodes>& w) const {
    Mat<T, n> g = Mat<T, n>::zero();
    for (int a = 0; a < n_nodes; ++a) {
      for (int i = 0; i < dim; ++i)
        for (int J = 0; J < dim; ++J) g(i, J) += w[a][i] * grad_N_[q][a].grad[J];
      if constexpr (axisymmetric) g(2, 2) += w[a][0] * grad_N_[q][a].hoop;
    }
    return g;
  }

  /// First Piola-Kirchhoff stress times volume element at each point.
  [[nodiscard]] Stresses stresses(const SolidParameters<dim>& solid, const Response& response) const {
    const double eta = solid.mu_s - solid.mu_f;
    Stresses P;
    for (int q = 0; q < n_points; ++q) {
      P[q] = response.first_piola(q);
      if (eta != 0) P[q] += viscous_piola(deformation_.F[q], gradient(q, cell_.v), eta);
      P[q] = deformation_.dV[q] * P[q];
    }
    return P;
  }

  /// a - g at a point.
  [[nodiscard]] Vec<T, dim> inertial_acceleration(int q, const SolidParameters<dim>& solid) const {
    Vec<T, dim> a = interpolate(Table::N[q], cell_.a);
    for (int i = 0; i < dim; ++i) a[i] -= T(solid.gravity[i]);
    return a;
  }

  /// (rho_s - rho_f J) dV: mass of the solid less that of the fluid in its place.
  [[nodiscard]] T excess_mass(int q, const SolidParameters<dim>& solid) const {
    return (solid.rho_s - solid.rho_f * det(deformation_.F[q])) * deformation_.dV[q];
  }

  template <class Sink>
  void residual_of_nodes(const Stresses& P, const SolidParameters<dim>& solid, Sink&& sink) const {
    std::array<Vec<T, dim>, n_points> b;
    for (int q = 0; q < n_points; ++q) b[q] = excess_mass(q, solid) * inertial_acceleration(q, solid);
    for (int a = 0; a < n_nodes; ++a) {
      Vec<T, dim> R = Vec<T, dim>::zero();
      for (int q = 0; q < n_points; ++q) {
        const Gradient& w = grad_N_[q][a];
        for (int i = 0; i < dim; ++i) {
          R[i] += Table::N[q][a] * b[q][i];
          for (int J = 0; J < dim; ++J) R[i] += w.grad[J] * P[q](i, J);
        }
        if constexpr (axisymmetric) R[0] += w.hoop * P[q](2, 2);
      }
      sink(a, R);
    }
  }

  class Stiffness;

  const Data& cell_;
  const Law& law_;
  CellDeformation<T, n, dim, n_points> deformation_;
  std::array<std::array<Gradient, n_nodes>, n_points> grad_N_;
  T min_det_F_;
};

/// Slopes of the stresses and inertia at all points of a cell, ready to be contracted with test and trial
/// gradients. Quadrature is the innermost loop of a block, so that its entries stay in registers.
template <class Element, class Law, class Formulation, class Coordinates, class Rule, class T>
class SolidCell<Element, Law, Formulation, Coordinates, Rule, T>::Stiffness {
 public:
  /// Changes with the displacement of one node, at each point: of the stress (slots x dim) and of J.
  struct Trial {
    std::array<Mat<T, n_slots, dim>, n_points> dP;
    std::array<Vec<T, dim>, n_points> dJ;
  };

  Stiffness(const SolidCell& cell, const SolidParameters<dim>& solid, const StateSlopes& slopes,
            const Response& response)
      : cell_(cell), immersed_(solid.rho_f != 0) {
    if constexpr (mean_dilatation) coupling_.clear();
    for (int q = 0; q < n_points; ++q) {
      const T dV = cell.deformation_.dV[q];
      set_elastic(q, slopes.u, response);
      if (const double eta = solid.mu_s - solid.mu_f; eta != 0) {
        const Mat<T, n> Grad_v = cell.gradient(q, cell.cell_.v);
        const ViscousTangent<T, n> viscous(cell.deformation_.F[q], Grad_v, T(eta * dV), slopes);
        for (int s = 0; s < n_slots; ++s)
          for (int t = 0; t < n_slots; ++t) A_[q](s, t) += viscous(row(s), column(s), row(t), column(t));
      }
      mass_[q] = slopes.a * cell.excess_mass(q, solid);
      if (immersed_) set_fluid_mass_slope(q, solid, slopes.u);
    }
  }

  [[nodiscard]] Trial trial(int b) const {
    Trial r;
    for (int q = 0; q < n_points; ++q) {
      const Gradient& w = cell_.grad_N_[q][b];
      for (int s = 0; s < n_slots; ++s)
        for (int k = 0; k < dim; ++k) {
          T sum = A_[q](s, k * dim) * w.grad[0];
          for (int L = 1; L < dim; ++L) sum += A_[q](s, k * dim + L) * w.grad[L];
          if constexpr (axisymmetric)
            if (k == 0) sum += A_[q](s, hoop_slot) * w.hoop;
          r.dP[q](s, k) = sum;
        }
      if (immersed_) r.dJ[q] = divergence(dJ_dF_[q], w);
    }
    return r;
  }

  [[nodiscard]] Mat<T, dim> block(int a, int b, const Trial& trial) const {
    Mat<T, dim> K = Mat<T, dim>::zero();
    for (int q = 0; q < n_points; ++q) {
      const Gradient& w = cell_.grad_N_[q][a];
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k)
          for (int J = 0; J < dim; ++J) K(i, k) += w.grad[J] * trial.dP[q](i * dim + J, k);
      if constexpr (axisymmetric)
        for (int k = 0; k < dim; ++k) K(0, k) += w.hoop * trial.dP[q](hoop_slot, k);
      const T m = (Table::N[q][a] * Table::N[q][b]) * mass_[q];
      for (int i = 0; i < dim; ++i) K(i, i) += m;
    }
    if (immersed_) add_fluid_mass(a, trial, K);
    if constexpr (mean_dilatation) coupling_.add(a, b, K);
    return K;
  }

 private:
  /// Row and column of the entry of F that slot s stands for.
  static constexpr int row(int s) { return axisymmetric && s == hoop_slot ? n - 1 : s / dim; }
  static constexpr int column(int s) { return axisymmetric && s == hoop_slot ? n - 1 : s % dim; }

  /// B : dF for each displacement component of one node: what the gradient B of a scalar makes of it.
  static Vec<T, dim> divergence(const Mat<T, n>& B, const Gradient& w) {
    Vec<T, dim> r;
    for (int i = 0; i < dim; ++i) {
      r[i] = B(i, 0) * w.grad[0];
      for (int J = 1; J < dim; ++J) r[i] += B(i, J) * w.grad[J];
    }
    if constexpr (axisymmetric) r[0] += B(2, 2) * w.hoop;
    return r;
  }

  void set_elastic(int q, double slope, const Response& response) {
    if constexpr (mean_dilatation) {
      const DilatedTangent<T, n> psi = response.tangent(q);
      coupling_.add_point(cell_, q, slope, response.dtheta(q), psi);
      store(q, slope, psi.FF);
    } else {
      store(q, slope, response.tangent(q));
    }
  }
  void store(int q, double slope, const Tangent<T, n>& A) {
    const T scale = slope * cell_.deformation_.dV[q];
    for (int s = 0; s < n_slots; ++s)
      for (int t = 0; t < n_slots; ++t)
        A_[q](s, t) = scale * A(row(s) * n + column(s), row(t) * n + column(t));
  }

  /// -rho_f (a - g) dJ: the displaced fluid mass changes with the volume of the solid.
  void set_fluid_mass_slope(int q, const SolidParameters<dim>& solid, double slope) {
    const Mat<T, n>& F = cell_.deformation_.F[q];
    const T fluid_mass = slope * solid.rho_f * cell_.deformation_.dV[q];
    dJ_dF_[q] = det(F) * transpose(inverse(F));
    fluid_force_[q] = T(-fluid_mass) * cell_.inertial_acceleration(q, solid);
  }
  void add_fluid_mass(int a, const Trial& trial, Mat<T, dim>& K) const {
    for (int q = 0; q < n_points; ++q) {
      const Vec<T, dim> force = Table::N[q][a] * fluid_force_[q];
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k) K(i, k) += force[i] * trial.dJ[q][k];
    }
  }

  /// What couples the points of a cell through its mean dilatation theta:
  /// K_ab += m_a (x) g_b + g_a (x) m_b + psi_theta_theta g_a (x) g_b, g = d theta/du, m = d2 psi/(du d
  /// theta).
  struct Coupling {
    std::array<Vec<T, dim>, n_nodes> g, m;
    T psi_theta_theta;

    void clear() {
      g.fill(Vec<T, dim>::zero());
      m.fill(Vec<T, dim>::zero());
      psi_theta_theta = T(0.0);
    }
    void add_point(const SolidCell& cell, int q, double slope, const Mat<T, n>& dtheta,
                   const DilatedTangent<T, n>& psi) {
      const T dV = slope * cell.deformation_.dV[q];
      for (int a = 0; a < n_nodes; ++a) {
        g[a] += divergence(dtheta, cell.grad_N_[q][a]);
        m[a] += dV * divergence(psi.F_theta, cell.grad_N_[q][a]);
      }
      psi_theta_theta += dV * psi.theta_theta;
    }
    void add(int a, int b, Mat<T, dim>& K) const {
      const Vec<T, dim> h = m[b] + psi_theta_theta * g[b];
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k) K(i, k) += g[a][i] * h[k] + m[a][i] * g[b][k];
    }
  };
  struct NoCoupling {};

  const SolidCell& cell_;
  bool immersed_;
  std::array<Mat<T, n_slots>, n_points> A_;
  std::array<T, n_points> mass_;
  std::array<Mat<T, n>, n_points> dJ_dF_;
  std::array<Vec<T, dim>, n_points> fluid_force_;
  [[no_unique_address]] std::conditional_t<mean_dilatation, Coupling, NoCoupling> coupling_;
};

}  // namespace ifsi
