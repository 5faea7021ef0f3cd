#pragma once
/// \file
/// Which part of each fluid cell lies outside of a body.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ifsi/element/geometry.hpp"
#include "ifsi/mesh/mesh.hpp"
#include "ifsi/mesh/reference_lattice.hpp"

namespace ifsi {

namespace detail {

/// Part of one cell, by the distance at `per_side`^dim equal sub-cells of the parent.
template <class Coordinates, class Element, class Distance>
double sampled_fraction(const std::array<Vec<double, Element::dim>, Element::n_nodes>& X, double diameter,
                        const Distance& distance, int per_side) {
  static_assert(is_tensor_cell<Element>, "expected quads or hexes: their parents are sampled on a grid");
  constexpr int dim = Element::dim;
  int n_samples = 1;
  for (int d = 0; d < dim; ++d) n_samples *= per_side;
  const double width = diameter / (per_side * std::sqrt(static_cast<double>(dim)));
  double outside = 0.0, all = 0.0;
  for (int k = 0; k < n_samples; ++k) {
    Vec<double, dim> xi;
    for (int d = 0, rest = k; d < dim; ++d, rest /= per_side)
      xi[d] = (2 * (rest % per_side) + 1.0) / per_side - 1.0;
    std::array<double, Element::n_nodes> N;
    Element::shape_functions(xi, N);
    const Vec<double, dim> x = interpolate(N, X);
    const double dV = Coordinates::measure(x[0]);
    outside += dV * std::clamp(0.5 + distance(x) / width, 0.0, 1.0);
    all += dV;
  }
  return outside / all;
}

}  // namespace detail

/// Part of each local cell outside of a body, in [0, 1] (eq. 20). \param distance of a point to the body,
/// negative inside; it changes by no more than the way between two points.
template <class Coordinates, class Element, class Distance>
[[nodiscard]] std::vector<double> fluid_fraction(const Mesh<Element>& mesh, const Distance& distance) {
  constexpr int dim = Element::dim, per_side = dim == 2 ? 8 : 5;
  std::vector<double> fraction(mesh.n_cells());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto X = mesh.cell_coordinates(c);
    auto centre = Vec<double, dim>::zero();
    for (const auto& x : X) centre += (1.0 / Element::n_nodes) * x;
    double radius2 = 0.0;
    for (const auto& x : X) radius2 = std::max(radius2, dot(x - centre, x - centre));
    const double radius = std::sqrt(radius2), d = distance(centre);
    fraction[c] = d >= radius ? 1.0
                  : d <= -radius
                      ? 0.0
                      : detail::sampled_fraction<Coordinates, Element>(X, 2.0 * radius, distance, per_side);
  }
  return fraction;
}

/// Weights of the fluid's equations per local cell: the fraction outside of a body, and `interior` of what is
/// inside.
template <class Coordinates, class Element, class Distance>
[[nodiscard]] std::vector<double> fluid_weights(const Mesh<Element>& mesh, const Distance& distance,
                                                double interior) {
  std::vector<double> weights = fluid_fraction<Coordinates>(mesh, distance);
  for (double& w : weights) w = interior + (1.0 - interior) * w;
  return weights;
}

}  // namespace ifsi
