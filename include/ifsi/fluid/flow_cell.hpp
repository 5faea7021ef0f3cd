#pragma once
/// \file
/// Element residual and tangent of the flow: quadrature over one cell, or over W cells at once when T is a
/// Pack<W>.

#include <array>
#include <new>

#include "ifsi/core/tensor.hpp"
#include "ifsi/element/geometry.hpp"
#include "ifsi/fluid/vms.hpp"
#include "ifsi/quadrature/basis_table.hpp"

namespace ifsi {

/// Nodal data of a cell (or of W cells): what the kernel reads, gathered by the caller.
template <class Element, class T>
struct FlowCellData {
  static constexpr int n = Element::n_nodes, dim = Element::dim;
  std::array<Vec<T, dim>, n> X;      ///< coordinates
  std::array<Vec<T, dim>, n> v;      ///< velocity at alpha_f
  std::array<Vec<T, dim>, n> v_dot;  ///< acceleration at alpha_m
  std::array<T, n> p;                ///< pressure at alpha_f
  std::array<Vec<T, dim>, n> f;      ///< body force per unit mass
  std::array<T, n> s;                ///< stabilisation scale
  T k_p;                             ///< PSPG scale of the cell
};

/// The flow kernel of one cell. Quadrature is the innermost loop of the tangent, so that the (dim+1)^2
/// entries of a node pair stay in registers; a pair's block goes to the sink as soon as it is complete, and
/// no element matrix is ever stored.
template <class Element, class Rule, class Model, class T>
class FlowCell {
  static constexpr int n = Element::n_nodes, dim = Element::dim, nq = Rule::n, B = dim + 1;
  using Table = BasisTable<Element, Rule>;
  using Parameters = FluidParameters<typename Model::Rheology>;

 public:
  /// Evaluates all quadrature points; residual() and tangent() may follow.
  FlowCell(const FlowCellData<Element, T>& cell, const Parameters& fluid) {
    for (int q = 0; q < nq; ++q) evaluate_point(q, cell, fluid);
  }

  /// sink(a, b, block) receives the (dim+1) x (dim+1) tangent of each node pair, sink(a, R) each residual.
  template <class ResidualSink, class TangentSink>
  void residual_and_tangent(ResidualSink&& residual, TangentSink&& tangent) const {
    std::array<TestFunction<T, dim>, nq> tests;
    for (int a = 0; a < n; ++a) {
      residual(a, residual_of(a, tests));
      for (int b = 0; b < n; ++b) {
        Mat<T, B> K = Mat<T, B>::zero();
        for (int q = 0; q < nq; ++q) points_[q].add_tangent(tests[q], trials_[b][q], K);
        tangent(a, b, K);
      }
    }
  }

  /// The residual alone.
  template <class ResidualSink>
  void residual(ResidualSink&& sink) const {
    std::array<TestFunction<T, dim>, nq> tests;
    for (int a = 0; a < n; ++a) sink(a, residual_of(a, tests));
  }

  [[nodiscard]] const VmsPoint<Model, T, dim>& point(int q) const { return points_[q]; }
  [[nodiscard]] const TrialFunction<T, dim>& trial(int a, int q) const { return trials_[a][q]; }

 private:
  Vec<T, B> residual_of(int a, std::array<TestFunction<T, dim>, nq>& tests) const {
    Vec<T, B> R = Vec<T, B>::zero();
    for (int q = 0; q < nq; ++q) {
      new (&tests[q]) TestFunction<T, dim>(points_[q].test(trials_[a][q]));  // in place: it is large
      points_[q].add_residual(tests[q], trials_[a][q], R);
    }
    return R;
  }

  void evaluate_point(int q, const FlowCellData<Element, T>& cell, const Parameters& fluid) {
    const Mat<T, dim> J = jacobian(Table::dN[q], cell.X);
    const Mat<T, dim> J_inv = inverse(J);
    const std::array<Vec<T, dim>, n> grad_N = physical_gradients(Table::dN[q], J_inv);
    std::array<T, n> lap_N;
    if constexpr (Element::linear)
      lap_N.fill(T(0.0));
    else
      lap_N = physical_laplacians(Table::ddN[q], grad_N, cell.X, J_inv);

    FlowPoint<T, dim> x;
    x.v = interpolate(Table::N[q], cell.v);
    x.v_dot = interpolate(Table::N[q], cell.v_dot);
    x.f = interpolate(Table::N[q], cell.f);
    x.grad_v = gradient(grad_N, cell.v);
    x.lap_v = Element::linear ? Vec<T, dim>::zero() : interpolate(lap_N, cell.v);
    x.p = interpolate(Table::N[q], cell.p);
    x.grad_p = interpolate(cell.p, grad_N);
    x.s = interpolate(Table::N[q], cell.s);
    x.k_p = cell.k_p;
    x.G = metric_tensor<Element>(J_inv);
    x.radius = Model::Coordinates::axisymmetric ? interpolate(Table::N[q], cell.X)[0] : T(1.0);
    x.JxW = Rule::weights[q] * det(J) * Model::Coordinates::measure(x.radius);
    new (&points_[q]) VmsPoint<Model, T, dim>(x, fluid);
    for (int a = 0; a < n; ++a)
      new (&trials_[a][q]) TrialFunction<T, dim>(points_[q].trial(Table::N[q][a], grad_N[a], lap_N[a]));
  }

  /// grad f = sum_a f_a (x) grad N_a.
  static Mat<T, dim> gradient(const std::array<Vec<T, dim>, n>& grad_N, const std::array<Vec<T, dim>, n>& f) {
    Mat<T, dim> g = outer(f[0], grad_N[0]);
    for (int a = 1; a < n; ++a) g += outer(f[a], grad_N[a]);
    return g;
  }

  std::array<VmsPoint<Model, T, dim>, nq> points_;
  std::array<std::array<TrialFunction<T, dim>, nq>, n> trials_;
};

}  // namespace ifsi
