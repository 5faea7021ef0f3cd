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
  /// Gradients of shape functions are the same at all points: their terms are summed over test functions.
  static constexpr bool constant_gradients = Element::linear && !Model::Coordinates::axisymmetric;
  using Table = BasisTable<Element, Rule>;
  using Parameters = FluidParameters<typename Model::Rheology>;
  using Test = TestFunction<T, dim>;
  using Trial = TrialFunction<T, dim>;

 public:
  /// Evaluates all quadrature points; residual() and residual_and_tangent() may follow.
  FlowCell(const FlowCellData<Element, T>& cell, const Parameters& fluid) {
    std::array<Vec<T, dim>, n> acceleration;
    for (int a = 0; a < n; ++a) acceleration[a] = cell.v_dot[a] - cell.f[a];
    FlowPoint<T, dim> x;
    Basis basis;
    for (int q = 0; q < nq; ++q) {
      if (q == 0 || !Element::linear) differentiate(q, cell, basis, x);
      evaluate_point(q, cell, acceleration, basis, x, fluid);
    }
  }

  /// sink(a, b, block) receives the (dim+1) x (dim+1) tangent of each node pair, sink(a, R) each residual.
  template <class ResidualSink, class TangentSink>
  void residual_and_tangent(ResidualSink&& residual, TangentSink&& tangent) const {
    std::array<Test, nq> tests;
    for (int a = 0; a < n; ++a) {
      residual(a, residual_of(a));
      // In place: a test function is large.
      for (int q = 0; q < nq; ++q) new (&tests[q]) Test(points_[q].test(trials_[a][q]));
      tangents_of(a, tests, tangent);
    }
  }

  /// The residual alone.
  template <class ResidualSink>
  void residual(ResidualSink&& sink) const {
    for (int a = 0; a < n; ++a) sink(a, residual_of(a));
  }

  [[nodiscard]] const VmsPoint<Model, T, dim>& point(int q) const { return points_[q]; }
  [[nodiscard]] const TrialFunction<T, dim>& trial(int a, int q) const { return trials_[a][q]; }

 private:
  /// Derivatives of the shape functions at a point.
  struct Basis {
    std::array<Vec<T, dim>, n> grad;
    std::array<T, n> lap;
    T det_J;
  };

  [[gnu::always_inline]] Vec<T, B> residual_of(int a) const {
    Vec<T, B> R = Vec<T, B>::zero();
    for (int q = 0; q < nq; ++q) points_[q].add_residual(trials_[a][q], R);
    return R;
  }

  template <class TangentSink>
  [[gnu::always_inline]] void tangents_of(int a, const std::array<Test, nq>& tests,
                                          TangentSink& tangent) const {
    [[maybe_unused]] Test sum;
    if constexpr (constant_gradients) {
      new (&sum) Test(tests[0]);
      for (int q = 1; q < nq; ++q) sum.add_factors_of_gradients(tests[q]);
    }
    for (int b = 0; b < n; ++b) {
      Mat<T, B> K = Mat<T, B>::zero();
      T diagonal(0.0);
      for (int q = 0; q < nq; ++q) {
        points_[q].add_tangent_of_values(tests[q], trials_[b][q], K, diagonal);
        if constexpr (!constant_gradients)
          points_[q].add_tangent_of_gradients(tests[q], trials_[b][q], K, diagonal);
      }
      if constexpr (constant_gradients) points_[0].add_tangent_of_gradients(sum, trials_[b][0], K, diagonal);
      IFSI_UNROLL
      for (int i = 0; i < dim; ++i) K(i, i) += diagonal;
      tangent(a, b, K);
    }
  }

  /// The derivatives of the shape functions and of the fields at point q.
  [[gnu::always_inline]] static void differentiate(int q, const FlowCellData<Element, T>& cell, Basis& basis,
                                                   FlowPoint<T, dim>& x) {
    const Mat<T, dim> J = jacobian(Table::dN[q], cell.X);
    const Mat<T, dim> J_inv = inverse(J);
    basis.det_J = det(J);
    basis.grad = physical_gradients(Table::dN[q], J_inv);
    x.G = metric_tensor<Element>(J_inv);
    x.grad_v = gradient(basis.grad, cell.v);
    x.grad_p = interpolate(cell.p, basis.grad);
    if constexpr (Element::linear) {
      basis.lap.fill(T(0.0));
      x.lap_v = Vec<T, dim>::zero();
    } else {
      basis.lap = physical_laplacians<Element::order == 1>(Table::ddN[q], basis.grad, cell.X, J_inv);
      x.lap_v = interpolate(basis.lap, cell.v);
    }
  }

  [[gnu::always_inline]] void evaluate_point(int q, const FlowCellData<Element, T>& cell,
                                             const std::array<Vec<T, dim>, n>& acceleration,
                                             const Basis& basis, FlowPoint<T, dim>& x,
                                             const Parameters& fluid) {
    x.v = interpolate(Table::N[q], cell.v);
    x.acceleration = interpolate(Table::N[q], acceleration);
    x.p = interpolate(Table::N[q], cell.p);
    x.s = interpolate(Table::N[q], cell.s);
    x.k_p = cell.k_p;
    x.radius = Model::Coordinates::axisymmetric ? interpolate(Table::N[q], cell.X)[0] : T(1.0);
    x.JxW = Rule::weights[q] * basis.det_J * Model::Coordinates::measure(x.radius);
    new (&points_[q]) VmsPoint<Model, T, dim>(x, fluid);
    for (int a = 0; a < n; ++a)
      new (&trials_[a][q]) Trial(points_[q].trial(Table::N[q][a], basis.grad[a], basis.lap[a]));
  }

  /// grad f = sum_a f_a (x) grad N_a.
  static Mat<T, dim> gradient(const std::array<Vec<T, dim>, n>& grad_N, const std::array<Vec<T, dim>, n>& f) {
    Mat<T, dim> g = outer(f[0], grad_N[0]);
    for (int a = 1; a < n; ++a) g += outer(f[a], grad_N[a]);
    return g;
  }

  std::array<VmsPoint<Model, T, dim>, nq> points_;
  std::array<std::array<Trial, nq>, n> trials_;
};

}  // namespace ifsi
