#pragma once
/// \file
/// What the tests of elements and quadrature share: the list of models, random points and random cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "ifsi/element/elements.hpp"
#include "ifsi/element/geometry.hpp"

namespace ifsi::test {

/// Every element that is a cell of some mesh.
using Cells = ::testing::Types<Line1, Line2, Tri1, Tri2, Quad1, Quad2, Tet1, Tet2, Hex1, Hex2, Wedge1>;
/// Every element.
using Elements =
    ::testing::Types<Point1, Line1, Line2, Tri1, Tri2, Quad1, Quad2, Tet1, Tet2, Hex1, Hex2, Wedge1>;
/// Cells whose faces have a normal.
using CellsWithNormals = ::testing::Types<Tri1, Tri2, Quad1, Quad2, Tet1, Tet2, Hex1, Hex2, Wedge1>;

/// Test names carry the element's name.
struct ElementName {
  template <class E>
  static std::string GetName(int) {
    return E::name;
  }
};

template <class E>
using CellNodes = std::array<Vec<double, E::dim>, E::n_nodes>;

inline double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A random point whose distance E::outside to the reference cell lies in [low, high].
template <class E>
[[gnu::noinline]] Vec<double, E::dim> random_point(std::mt19937& random, double low = -1.0,
                                                   double high = 0.0) {
  Vec<double, E::dim> xi{};
  do
    for (int i = 0; i < E::dim; ++i)
      xi[i] = uniform(random, -1.0 - std::max(0.0, high), 1.0 + std::max(0.0, high));
  while (E::outside(xi) < low || E::outside(xi) > high);
  return xi;
}

template <class E>
[[gnu::noinline]] CellNodes<E> gradients_at(const Vec<double, E::dim>& xi) {
  CellNodes<E> dN;
  E::gradients(xi, dN);
  return dN;
}

/// Smallest det J on a lattice of the reference cell.
template <class E>
[[gnu::noinline]] double smallest_det(const CellNodes<E>& X, int points_per_axis = 9) {
  double smallest = 1e300;
  for (int q = 0; q < detail::power(points_per_axis, E::dim); ++q) {
    Vec<double, E::dim> xi;
    for (int i = 0, rest = q; i < E::dim; ++i, rest /= points_per_axis)
      xi[i] = -1.0 + 2.0 * (rest % points_per_axis) / (points_per_axis - 1);
    if (E::contains(xi, 1e-9)) smallest = std::min(smallest, det(jacobian(gradients_at<E>(xi), X)));
  }
  return smallest;
}

/// The reference cell with every node moved by up to `amplitude`, tried again until det J > 0.05 everywhere.
template <class E>
[[gnu::noinline]] CellNodes<E> random_cell(std::mt19937& random, double amplitude) {
  CellNodes<E> X;
  do
    for (int a = 0; a < E::n_nodes; ++a)
      for (int i = 0; i < E::dim; ++i) X[a][i] = E::nodes[a][i] + uniform(random, -amplitude, amplitude);
  while (smallest_det<E>(X) < 0.05);
  return X;
}

template <class T, int n>
double norm(const Vec<T, n>& x) {
  return std::sqrt(dot(x, x));
}

}  // namespace ifsi::test
