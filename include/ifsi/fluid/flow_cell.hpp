#pragma once
/// \file
/// Element residual and tangent of the flow: quadrature over one cell, or over W cells at once when T is a
/// Pack<W>.

#include <array>
#include <new>

#include "ifsi/core/tensor.hpp"
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
    const Mat<T, dim> J = gradient(Table::dN[q], cell.X);
    const Mat<T, dim> J_inv = inverse(J);
    std::array<Vec<T, dim>, n> grad_N;
    for (int a = 0; a < n; ++a) grad_N[a] = push_forward(Table::dN[q][a], J_inv);
    const std::array<T, n> lap_N = laplacians(q, cell, J_inv, grad_N);

    FlowPoint<T, dim> x;
    x.v = value(Table::N[q], cell.v);
    x.v_dot = value(Table::N[q], cell.v_dot);
    x.f = value(Table::N[q], cell.f);
    x.grad_v = gradient(grad_N, cell.v);
    x.lap_v = Element::linear ? Vec<T, dim>::zero() : value(lap_N, cell.v);
    x.p = value(Table::N[q], cell.p);
    x.grad_p = gradient(grad_N, cell.p);
    x.s = value(Table::N[q], cell.s);
    x.k_p = cell.k_p;
    x.G = metric(J_inv);
    x.radius = Model::Coordinates::axisymmetric ? value(Table::N[q], cell.X)[0] : T(1.0);
    x.JxW = Rule::weights[q] * det(J) * Model::Coordinates::measure(x.radius);
    new (&points_[q]) VmsPoint<Model, T, dim>(x, fluid);
    for (int a = 0; a < n; ++a)
      new (&trials_[a][q]) TrialFunction<T, dim>(points_[q].trial(Table::N[q][a], grad_N[a], lap_N[a]));
  }

  /// sum_a N_a f_a for scalar or vector nodal values.
  template <class S, class Value>
  static Value value(const std::array<S, n>& N, const std::array<Value, n>& f) {
    Value r = N[0] * f[0];
    for (int a = 1; a < n; ++a) r += N[a] * f[a];
    return r;
  }
  /// sum_a f_a grad N_a, and for vectors sum_a f_a (x) grad N_a (also the Jacobian, from reference
  /// gradients).
  template <class S>
  static Vec<T, dim> gradient(const std::array<Vec<S, dim>, n>& grad_N, const std::array<T, n>& f) {
    Vec<T, dim> r = Vec<T, dim>::zero();
    for (int a = 0; a < n; ++a) r += f[a] * grad_N[a];
    return r;
  }
  template <class S>
  static Mat<T, dim> gradient(const std::array<Vec<S, dim>, n>& grad_N, const std::array<Vec<T, dim>, n>& f) {
    Mat<T, dim> r = Mat<T, dim>::zero();
    for (int a = 0; a < n; ++a) IFSI_UNROLL
    for (int i = 0; i < dim; ++i) IFSI_UNROLL
    for (int j = 0; j < dim; ++j) r(i, j) += f[a][i] * grad_N[a][j];
    return r;
  }
  static Vec<T, dim> push_forward(const Vec<double, dim>& dN, const Mat<T, dim>& J_inv) {
    Vec<T, dim> grad;
    IFSI_UNROLL
    for (int i = 0; i < dim; ++i) {
      grad[i] = dN[0] * J_inv(0, i);
      IFSI_UNROLL
      for (int j = 1; j < dim; ++j) grad[i] += dN[j] * J_inv(j, i);
    }
    return grad;
  }
  /// G = J^-T M J^-1 (eq. 6).
  static Mat<T, dim> metric(const Mat<T, dim>& J_inv) {
    constexpr Mat<double, dim> M = Element::metric;
    if constexpr (M == Mat<double, dim>::identity()) return transpose(J_inv) * J_inv;
    Mat<T, dim> M_J_inv = Mat<T, dim>::zero();
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
        for (int j = 0; j < dim; ++j) M_J_inv(k, j) += M(k, l) * J_inv(l, j);
    return transpose(J_inv) * M_J_inv;
  }

  /// lap N = tr(J^-1 J^-T (H_N - sum_i dN/dx_i H_xi)): what the map adds matters on every cell that is not
  /// affine.
  static std::array<T, n> laplacians(int q, const FlowCellData<Element, T>& cell, const Mat<T, dim>& J_inv,
                                     const std::array<Vec<T, dim>, n>& grad_N) {
    std::array<T, n> lap_N;
    if constexpr (Element::linear) {
      for (int a = 0; a < n; ++a) lap_N[a] = T(0.0);
      return lap_N;
    } else {
      const Mat<T, dim> Q = J_inv * transpose(J_inv);
      Vec<T, dim> curvature = Vec<T, dim>::zero();
      for (int a = 0; a < n; ++a) {
        lap_N[a] = T(0.0);
        for (int k = 0; k < dim; ++k) {
          lap_N[a] += Table::ddN[q][a](k, k) * Q(k, k);
          for (int l = 0; l < k; ++l) lap_N[a] += (2.0 * Table::ddN[q][a](k, l)) * Q(k, l);
        }
        for (int i = 0; i < dim; ++i) curvature[i] += lap_N[a] * cell.X[a][i];
      }
      for (int a = 0; a < n; ++a) lap_N[a] -= dot(curvature, grad_N[a]);
      return lap_N;
    }
  }

  std::array<VmsPoint<Model, T, dim>, nq> points_;
  std::array<std::array<TrialFunction<T, dim>, nq>, n> trials_;
};

}  // namespace ifsi
