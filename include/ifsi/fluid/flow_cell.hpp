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
  T fraction = T(1.0);               ///< weight of all of the cell's terms (eq. 20)
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
  /// Evaluates all quadrature points and sums the residual; residual() and tangent() hand them out.
  FlowCell(const FlowCellData<Element, T>& cell, const Parameters& fluid) {
    residual_.fill(Vec<T, B>::zero());
    std::array<Vec<T, dim>, n> acceleration;
    for (int a = 0; a < n; ++a) acceleration[a] = cell.v_dot[a] - cell.f[a];
    FlowPoint<T, dim> x;
    Basis basis;
    for (int q = 0; q < nq; ++q) {
      if (q == 0 || !Element::linear) differentiate(q, cell, basis, x);
      evaluate_point(q, cell, acceleration, basis, x, fluid);
    }
  }

  /// Residual of node a: dim momentum rows, then the mass row.
  [[nodiscard]] const Vec<T, B>& residual(int a) const { return residual_[a]; }

  /// sink(a, b, block) receives the (dim+1) x (dim+1) tangent of each node pair, row by row.
  template <class Sink>
  void tangent(Sink&& sink) const {
    std::array<Test, nq> tests;
    for (int a = 0; a < n; ++a) {
      // In place: a test function is large.
      for (int q = 0; q < nq; ++q) new (&tests[q]) Test(points_[q].test(Table::N[q][a], trials_[a][q]));
      tangents_of(a, tests, sink);
    }
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

  template <class Sink>
  [[gnu::always_inline]] void tangents_of(int a, const std::array<Test, nq>& tests, Sink& sink) const {
    [[maybe_unused]] Test sum;
    if constexpr (constant_gradients) {
      new (&sum) Test(tests[0]);
      for (int q = 1; q < nq; ++q) sum.add_factors_of_gradients(tests[q]);
    }
    for (int b = 0; b < n; ++b) {
      Mat<T, B> pair = Mat<T, B>::zero();
      T diagonal(0.0);
      for (int q = 0; q < nq; ++q) {
        const double N = Table::N[q][b];
        points_[q].add_tangent_of_values(tests[q], N, trials_[b][q], pair, diagonal);
        if constexpr (!constant_gradients)
          points_[q].add_tangent_of_gradients(tests[q], N, trials_[b][q], pair, diagonal);
      }
      if constexpr (constant_gradients)
        points_[0].add_tangent_of_gradients(sum, Table::N[0][b], trials_[b][0], pair, diagonal);
      Mat<T, B> K;  // a copy: what is handed out lives in memory, what is summed up should not
      copy(pair, K);
      IFSI_UNROLL
      for (int i = 0; i < dim; ++i) K(i, i) += diagonal;
      sink(a, b, K);
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

  /// s at a point, between its nodal values: shape functions of order 2 would undershoot where s jumps, and
  /// a negative s has no tau_M.
  [[gnu::always_inline]] static T between_nodes(int q, const std::array<T, n>& s) {
    if constexpr (Element::order == 1) return interpolate(Table::N[q], s);
    std::array<double, n> weights;
    double sum = 0.0;
    for (int a = 0; a < n; ++a) sum += weights[a] = std::abs(Table::N[q][a]);
    for (double& w : weights) w /= sum;
    return interpolate(weights, s);
  }

  [[gnu::always_inline]] void evaluate_point(int q, const FlowCellData<Element, T>& cell,
                                             const std::array<Vec<T, dim>, n>& acceleration,
                                             const Basis& basis, FlowPoint<T, dim>& x,
                                             const Parameters& fluid) {
    x.v = interpolate(Table::N[q], cell.v);
    x.acceleration = interpolate(Table::N[q], acceleration);
    x.p = interpolate(Table::N[q], cell.p);
    x.s = between_nodes(q, cell.s);
    x.k_p = cell.k_p;
    x.radius = Model::Coordinates::axisymmetric ? interpolate(Table::N[q], cell.X)[0] : T(1.0);
    x.JxW = Rule::weights[q] * basis.det_J * Model::Coordinates::measure(x.radius) * cell.fraction;
    ResidualFactors<T, dim> residual;
    new (&points_[q]) VmsPoint<Model, T, dim>(x, fluid, residual);
    for (int a = 0; a < n; ++a) {
      const double N = Table::N[q][a];
      new (&trials_[a][q]) Trial(points_[q].trial(N, basis.grad[a], basis.lap[a], x.v));
      add_residual(residual, N, basis.grad[a], residual_[a]);
    }
  }

  /// grad f = sum_a f_a (x) grad N_a.
  static Mat<T, dim> gradient(const std::array<Vec<T, dim>, n>& grad_N, const std::array<Vec<T, dim>, n>& f) {
    Mat<T, dim> g = outer(f[0], grad_N[0]);
    for (int a = 1; a < n; ++a) g += outer(f[a], grad_N[a]);
    return g;
  }

  std::array<VmsPoint<Model, T, dim>, nq> points_;
  std::array<std::array<Trial, nq>, n> trials_;
  std::array<Vec<T, B>, n> residual_;
};

}  // namespace ifsi
