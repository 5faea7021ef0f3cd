#pragma once
/// \file
/// What lines, quads and hexes share: products of one-dimensional Lagrange polynomials on [-1,1]^dim.

#include "ifsi/element/element.hpp"

namespace ifsi::detail {

/// Lagrange polynomials on [-1,1] and their first two derivatives; nodes: both ends, then the middle.
template <int order>
struct LinePolynomials;

template <>
struct LinePolynomials<1> {
  template <class T>
  static constexpr std::array<std::array<T, 2>, 3> at(const T& x) {
    return {{{0.5 * (1.0 - x), 0.5 * (1.0 + x)}, {T(-0.5), T(0.5)}, {T(0.0), T(0.0)}}};
  }
};

template <>
struct LinePolynomials<2> {
  template <class T>
  static constexpr std::array<std::array<T, 3>, 3> at(const T& x) {
    return {{{0.5 * x * (x - 1.0), 0.5 * x * (x + 1.0), (1.0 - x) * (1.0 + x)},
             {x - 0.5, x + 0.5, -2.0 * x},
             {T(1.0), T(1.0), T(-2.0)}}};
  }
};

/// Nodes of the order-2 cell on [-1,1]^dim; the order-1 cell has the first 2^dim of them.
template <int dim>
inline constexpr std::array<Vec<double, dim>, power(3, dim)> tensor_nodes = {};
template <>
inline constexpr std::array<Vec<double, 1>, 3> tensor_nodes<1> = {{{-1}, {1}, {0}}};
template <>
inline constexpr std::array<Vec<double, 2>, 9> tensor_nodes<2> = {
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};
template <>
inline constexpr std::array<Vec<double, 3>, 27> tensor_nodes<3> = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
     {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
     {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0}, {-1, 0, 0},
     {1, 0, 0},    {0, -1, 0},  {0, 1, 0},   {0, 0, -1},  {0, 0, 1},   {0, 0, 0}}};

/// Lagrange element of order 1 or 2 in each direction.
template <int dim_, int order_>
struct TensorCell {
  static constexpr int dim = dim_;
  static constexpr int order = order_;
  static constexpr int n_vertices = power(2, dim);
  static constexpr int n_nodes = power(order + 1, dim);
  static constexpr bool linear = dim == 1 && order == 1;
  static constexpr Vec<double, dim> center = Vec<double, dim>::zero();
  static constexpr Mat<double, dim> metric = Mat<double, dim>::identity();
  static constexpr std::array<Vec<double, dim>, n_nodes> nodes = [] {
    std::array<Vec<double, dim>, n_nodes> first;
    for (int a = 0; a < n_nodes; ++a) first[a] = tensor_nodes<dim>[a];
    return first;
  }();

  template <class T>
  static constexpr void shape_functions(const Vec<T, dim>& xi, std::array<T, n_nodes>& N) {
    const Polynomials<T> p = polynomials(xi);
    for (int a = 0; a < n_nodes; ++a) N[a] = derivative(p, a);
  }

  template <class T>
  static constexpr void gradients(const Vec<T, dim>& xi, std::array<Vec<T, dim>, n_nodes>& dN) {
    const Polynomials<T> p = polynomials(xi);
    for (int a = 0; a < n_nodes; ++a)
      for (int i = 0; i < dim; ++i) dN[a][i] = derivative(p, a, i);
  }

  template <class T>
  static constexpr void hessians(const Vec<T, dim>& xi, std::array<Mat<T, dim>, n_nodes>& ddN) {
    const Polynomials<T> p = polynomials(xi);
    for (int a = 0; a < n_nodes; ++a)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j <= i; ++j) ddN[a](i, j) = ddN[a](j, i) = derivative(p, a, i, j);
  }

  /// Largest coordinate excess over [-1,1]^dim: positive outside, zero on the boundary, negative inside.
  static constexpr double outside(const Vec<double, dim>& xi) {
    double excess = -1.0;
    for (int i = 0; i < dim; ++i) {
      const double e = (xi[i] < 0.0 ? -xi[i] : xi[i]) - 1.0;
      if (e > excess || e != e) excess = e;  // a NaN stays
    }
    return excess;
  }
  /// Whether xi lies in the cell grown by tolerance; a NaN lies nowhere.
  static constexpr bool contains(const Vec<double, dim>& xi, double tolerance) {
    return outside(xi) <= tolerance;
  }

 private:
  /// [axis][derivative][node of the line]
  template <class T>
  using Polynomials = std::array<std::array<std::array<T, order + 1>, 3>, dim>;

  template <class T>
  static constexpr Polynomials<T> polynomials(const Vec<T, dim>& xi) {
    Polynomials<T> p{};
    for (int i = 0; i < dim; ++i) p[i] = LinePolynomials<order>::at(xi[i]);
    return p;
  }

  /// N_a, or its derivative along axis i, or its second derivative along axes i and j.
  template <class T>
  static constexpr T derivative(const Polynomials<T>& p, int a, int i = -1, int j = -1) {
    T r = p[0][(i == 0) + (j == 0)][line_node[a][0]];
    for (int k = 1; k < dim; ++k) r = r * p[k][(i == k) + (j == k)][line_node[a][k]];
    return r;
  }

  /// Node a is node line_node[a][i] of the line along axis i.
  static constexpr std::array<std::array<int, dim>, n_nodes> line_node = [] {
    std::array<std::array<int, dim>, n_nodes> index{};
    for (int a = 0; a < n_nodes; ++a)
      for (int i = 0; i < dim; ++i) index[a][i] = nodes[a][i] < 0 ? 0 : nodes[a][i] > 0 ? 1 : 2;
    return index;
  }();
};

}  // namespace ifsi::detail
