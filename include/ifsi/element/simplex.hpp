#pragma once
/// \file
/// What triangles and tets share: polynomials in barycentric coordinates on the unit simplex.

#include "ifsi/element/element.hpp"

namespace ifsi::detail {

/// Edges of the simplex, in the order of the mid nodes of the order-2 element.
template <int dim>
inline constexpr std::array<std::array<int, 2>, dim*(dim + 1) / 2> simplex_edges = {};
template <>
inline constexpr std::array<std::array<int, 2>, 3> simplex_edges<2> = {{{0, 1}, {1, 2}, {2, 0}}};
template <>
inline constexpr std::array<std::array<int, 2>, 6> simplex_edges<3> = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Lagrange element of order 1 or 2 on { xi_i >= 0, sum xi_i <= 1 }; with the barycentric coordinates L_a:
/// N_a = L_a, or N_a = L_a (2 L_a - 1) at vertices and N_ab = 4 L_a L_b at mid nodes.
template <int dim_, int order_>
struct Simplex {
  static constexpr int dim = dim_;
  static constexpr int order = order_;
  static constexpr int n_vertices = dim + 1;
  static constexpr int n_edges = dim * (dim + 1) / 2;
  static constexpr int n_nodes = order == 1 ? n_vertices : n_vertices + n_edges;
  static constexpr bool linear = order == 1;
  static constexpr Vec<double, dim> center = [] {
    Vec<double, dim> c;
    for (int i = 0; i < dim; ++i) c[i] = 1.0 / n_vertices;
    return c;
  }();
  /// Inner products of the edges from vertex 0 of the regular simplex of edge 2.
  static constexpr Mat<double, dim> metric = [] {
    Mat<double, dim> m;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) m(i, j) = i == j ? 4.0 : 2.0;
    return m;
  }();
  static constexpr std::array<Vec<double, dim>, n_nodes> nodes = [] {
    std::array<Vec<double, dim>, n_nodes> x{};
    for (int i = 0; i < dim; ++i) x[i + 1][i] = 1.0;
    for (int m = n_vertices; m < n_nodes; ++m) {
      const auto [a, b] = simplex_edges<dim>[m - n_vertices];
      x[m] = 0.5 * (x[a] + x[b]);
    }
    return x;
  }();

  template <class T>
  static constexpr void shape_functions(const Vec<T, dim>& xi, std::array<T, n_nodes>& N) {
    const std::array<T, n_vertices> L = barycentric(xi);
    if constexpr (order == 1) {
      N = L;
    } else {
      for (int a = 0; a < n_vertices; ++a) N[a] = L[a] * (2.0 * L[a] - 1.0);
      for (int m = 0; m < n_edges; ++m) {
        const auto [a, b] = simplex_edges<dim>[m];
        N[n_vertices + m] = 4.0 * L[a] * L[b];
      }
    }
  }

  template <class T>
  static constexpr void gradients(const Vec<T, dim>& xi, std::array<Vec<T, dim>, n_nodes>& dN) {
    if constexpr (order == 1) {
      for (int a = 0; a < n_vertices; ++a)
        for (int i = 0; i < dim; ++i) dN[a][i] = T(slope(a, i));
    } else {
      const std::array<T, n_vertices> L = barycentric(xi);
      for (int i = 0; i < dim; ++i) {
        for (int a = 0; a < n_vertices; ++a) dN[a][i] = (4.0 * L[a] - 1.0) * slope(a, i);
        for (int m = 0; m < n_edges; ++m) {
          const auto [a, b] = simplex_edges<dim>[m];
          dN[n_vertices + m][i] = 4.0 * (slope(a, i) * L[b] + slope(b, i) * L[a]);
        }
      }
    }
  }

  template <class T>
  static constexpr void hessians(const Vec<T, dim>&, std::array<Mat<T, dim>, n_nodes>& ddN) {
    for (int n = 0; n < n_nodes; ++n)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) ddN[n](i, j) = T(second_derivative(n, i, j));
  }

  /// Largest negative barycentric coordinate: positive outside, zero on the boundary, negative inside.
  static constexpr double outside(const Vec<double, dim>& xi) {
    double excess = -1.0;
    for (const double L : barycentric(xi))
      if (-L > excess || L != L) excess = -L;  // a NaN stays
    return excess;
  }
  /// Whether xi lies in the cell grown by tolerance; a NaN lies nowhere.
  static constexpr bool contains(const Vec<double, dim>& xi, double tolerance) {
    return outside(xi) <= tolerance;
  }

 private:
  template <class T>
  static constexpr std::array<T, n_vertices> barycentric(const Vec<T, dim>& xi) {
    std::array<T, n_vertices> L{};
    L[0] = T(1.0);
    for (int i = 0; i < dim; ++i) {
      L[0] = L[0] - xi[i];
      L[i + 1] = xi[i];
    }
    return L;
  }
  /// dL_a / dxi_i
  static constexpr double slope(int a, int i) { return a == 0 ? -1.0 : a == i + 1 ? 1.0 : 0.0; }
  static constexpr double second_derivative(int n, int i, int j) {
    if (order == 1) return 0.0;
    if (n < n_vertices) return 4.0 * slope(n, i) * slope(n, j);
    const auto [a, b] = simplex_edges<dim>[n - n_vertices];
    return 4.0 * (slope(a, i) * slope(b, j) + slope(b, i) * slope(a, j));
  }
};

}  // namespace ifsi::detail
