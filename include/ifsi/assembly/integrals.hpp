#pragma once
/// \file
/// Integrals of nodal fields over the mesh: volumes, means, error norms.

#include <array>
#include <span>
#include <vector>

#include "ifsi/element/geometry.hpp"
#include "ifsi/mesh/mesh.hpp"
#include "ifsi/quadrature/coordinates.hpp"
#include "ifsi/quadrature/quadrature.hpp"

namespace ifsi {

/// One quadrature point of a cell.
template <class Element>
struct CellPoint {
  static constexpr int dim = Element::dim, n = Element::n_nodes;
  int cell;
  const std::array<int, n>& nodes;
  const std::array<double, n>& N;
  std::array<Vec<double, dim>, n> grad_N;
  Vec<double, dim> x;
  double JxW;
};

/// Visits the quadrature points of local cells, of owned ones only if asked.
template <class Coordinates, class Rule, class Element, class Visit>
void for_each_cell_point(const Mesh<Element>& mesh, bool owned_only, Visit&& visit) {
  // Tabulated at run time: high degrees would keep the compiler busy for long, and this is no hot loop.
  std::array<std::array<double, Element::n_nodes>, Rule::n> N;
  std::array<std::array<Vec<double, Element::dim>, Element::n_nodes>, Rule::n> dN;
  for (int q = 0; q < Rule::n; ++q) {
    Element::shape_functions(Rule::points[q], N[q]);
    Element::gradients(Rule::points[q], dN[q]);
  }
  const int n_cells = owned_only ? mesh.n_owned_cells : mesh.n_cells();
  for (int c = 0; c < n_cells; ++c) {
    const auto X = mesh.cell_coordinates(c);
    for (int q = 0; q < Rule::n; ++q) {
      const auto J = jacobian(dN[q], X);
      const auto x = interpolate(N[q], X);
      visit(CellPoint<Element>{c, mesh.cells[c], N[q], physical_gradients(dN[q], inverse(J)), x,
                               Rule::weights[q] * det(J) * Coordinates::measure(x[0])});
    }
  }
}

/// Volume of each owned node: the integral of its shape function.
template <class Coordinates, class Element>
[[nodiscard]] std::vector<double> nodal_volumes(const Mesh<Element>& mesh) {
  std::vector<double> volume(mesh.n_nodes(), 0.0);
  for_each_cell_point<Coordinates, DefaultQuadrature<Element>>(mesh, false, [&](const CellPoint<Element>& q) {
    for (int a = 0; a < Element::n_nodes; ++a) volume[q.nodes[a]] += q.N[a] * q.JxW;
  });
  volume.resize(mesh.n_owned_nodes());
  return volume;
}

/// Momentum and kinetic energy of a flow, and the rate at which viscosity dissipates it, summed over the
/// ranks.
template <int dim>
struct FlowTotals {
  Vec<double, dim> momentum{};
  double kinetic = 0.0;      ///< rho/2 |v|^2 [energy]
  double dissipation = 0.0;  ///< 2 mu eps : eps [energy/time]
};

/// \param u interleaved nodal velocity and pressure.
template <class Coordinates, class Element, class Rheology>
[[nodiscard]] FlowTotals<Element::dim> flow_totals(const Mesh<Element>& mesh, std::span<const double> u,
                                                   double rho, const Rheology& rheology) {
  constexpr int dim = Element::dim, B = dim + 1;
  std::array<double, dim + 2> sums{};
  for_each_cell_point<Coordinates, DefaultQuadrature<Element>>(mesh, true, [&](const CellPoint<Element>& q) {
    auto v = Vec<double, dim>::zero();
    auto grad_v = Mat<double, dim>::zero();
    for (int a = 0; a < Element::n_nodes; ++a)
      for (int i = 0; i < dim; ++i) {
        const double v_ai = u[static_cast<std::size_t>(q.nodes[a]) * B + i];
        v[i] += q.N[a] * v_ai;
        for (int j = 0; j < dim; ++j) grad_v(i, j) += v_ai * q.grad_N[a][j];
      }
    const auto eps = 0.5 * (grad_v + transpose(grad_v));
    double eps2 = inner(eps, eps);
    if constexpr (Coordinates::axisymmetric) eps2 += (v[0] / q.x[0]) * (v[0] / q.x[0]);
    for (int i = 0; i < dim; ++i) sums[i] += rho * v[i] * q.JxW;
    sums[dim] += 0.5 * rho * dot(v, v) * q.JxW;
    sums[dim + 1] += 2.0 * rheology.viscosity(2.0 * eps2) * eps2 * q.JxW;
  });
  mesh.comm.sum_in_place(sums.data(), dim + 2);
  FlowTotals<dim> totals{{}, sums[dim], sums[dim + 1]};
  for (int i = 0; i < dim; ++i) totals.momentum[i] = sums[i];
  return totals;
}

/// Errors of an interleaved (velocity, pressure) field against an exact one, over all ranks.
struct FlowErrors {
  double v_l2 = 0.0;  ///< L2 norm of the velocity error
  double v_h1 = 0.0;  ///< L2 norm of its gradient, when the exact gradient is given
  double p_l2 = 0.0;  ///< L2 norm of the pressure error
};

/// \param v, p exact velocity and pressure at x; grad_v exact gradient (d v_i / d x_j) or null.
/// The rule has two degrees more than assembly, so that the norms themselves are exact enough.
template <class Coordinates, class Element, class Velocity, class Pressure, class Gradient>
[[nodiscard]] FlowErrors flow_errors(const Mesh<Element>& mesh, std::span<const double> u, const Velocity& v,
                                     const Pressure& p, const Gradient& grad_v) {
  constexpr int dim = Element::dim, B = dim + 1;
  using Rule = Quadrature<Element, 2 * Element::order + 3>;
  double squares[3] = {};
  for_each_cell_point<Coordinates, Rule>(mesh, true, [&](const CellPoint<Element>& q) {
    auto e_v = -1.0 * v(q.x);
    auto e_grad = -1.0 * grad_v(q.x);
    double e_p = -p(q.x);
    for (int a = 0; a < Element::n_nodes; ++a) {
      const double* u_a = &u[static_cast<std::size_t>(q.nodes[a]) * B];
      for (int i = 0; i < dim; ++i) {
        e_v[i] += q.N[a] * u_a[i];
        for (int j = 0; j < dim; ++j) e_grad(i, j) += u_a[i] * q.grad_N[a][j];
      }
      e_p += q.N[a] * u_a[dim];
    }
    squares[0] += dot(e_v, e_v) * q.JxW;
    squares[1] += inner(e_grad, e_grad) * q.JxW;
    squares[2] += e_p * e_p * q.JxW;
  });
  mesh.comm.sum_in_place(squares, 3);
  return {std::sqrt(squares[0]), std::sqrt(squares[1]), std::sqrt(squares[2])};
}

}  // namespace ifsi
