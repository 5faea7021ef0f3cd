#pragma once
/// \file
/// Discs and straight pipes of circular section: a rounded square of cells in the middle, rings around it.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>

#include "ifsi/mesh/axis.hpp"
#include "ifsi/mesh/extrude.hpp"
#include "ifsi/mesh/split.hpp"
#include "ifsi/mesh/weld.hpp"

namespace ifsi {

/// Section of a pipe about the origin.
struct Disc {
  double radius = 1;
  double core_radius = 0.5;  ///< from the centre to the corners of the rounded square
  int n_core = 8;            ///< cells along a side of the square
  int n_ring = 6;            ///< layers from the square to the wall
  double ring_ratio = 1;     ///< thickness of the layer at the wall over that at the square
};

namespace detail {

inline void check_disc(const Disc& d) {
  if (d.n_core >= 1 && d.n_ring >= 1 && d.core_radius > 0 && d.core_radius < d.radius) return;
  throw Error(ExitCode::configuration, "disc: found radius " + std::to_string(d.radius) + ", core radius " +
                                           std::to_string(d.core_radius) + ", " + std::to_string(d.n_core) +
                                           " and " + std::to_string(d.n_ring) +
                                           " cells; expected 0 < core_radius < radius and positive counts");
}

/// Point of the core for (s, t) in [-1, 1]^2: half-way between a square and the disc it is inscribed in.
inline Vec<double, 2> core_point(const Disc& d, double s, double t) {
  const double a = d.core_radius / std::numbers::sqrt2;
  const double round_s = s * std::sqrt(2 - t * t), round_t = t * std::sqrt(2 - s * s);
  return {0.5 * a * (s + round_s), 0.5 * a * (t + round_t)};
}

template <class Element>
GlobalMesh<Element> quad_disc(const Disc& d) {
  check_disc(d);
  const int n = d.n_core;
  const Axis layers = geometric_axis(0, 1, d.n_ring, d.ring_ratio);
  const auto along = [n](double s) { return 2 * s / n - 1; };
  GlobalMesh<Element> mesh;
  append_block(mesh, n, n, [&](double s, double t) { return core_point(d, along(s), along(t)); });
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double c = quarter == 0 ? 1 : quarter == 2 ? -1 : 0, s = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
    append_block(mesh, d.n_ring, n, [&](double layer, double t) {
      const int i = std::min(static_cast<int>(layer), d.n_ring - 1);
      const double w = layers[i] + (layer - i) * (layers[i + 1] - layers[i]);
      const double phi = along(t) * std::numbers::pi / 4;
      const Vec<double, 2> wall = {d.radius * std::cos(phi), d.radius * std::sin(phi)};
      const Vec<double, 2> x = (1 - w) * core_point(d, 1, along(t)) + w * wall;
      return Vec<double, 2>{c * x[0] - s * x[1], s * x[0] + c * x[1]};
    });
  }
  weld(mesh, 1e-9 * d.radius);
  return mesh;
}

}  // namespace detail

/// A disc about the origin, boundary `wall`; quads or triangles of order 1 or 2. Nodes on the boundary lie on
/// the circle. Throws Error(configuration) when the numbers make no disc.
template <class Element>
GlobalMesh<Element> disc(const Disc& d, const std::string& wall = "wall") {
  auto mesh = detail::quad_disc<BaseCell<Element>>(d);
  mesh.boundary_names = {wall};
  mark_boundaries(mesh, [](const auto&) { return 0; });
  if constexpr (is_tensor_cell<Element>) {
    return mesh;
  } else {
    return split<Element>(mesh, [&](int c) {
      const auto X = mesh.cell_coordinates(c);
      return dot(X[3] - X[1], X[3] - X[1]) < dot(X[2] - X[0], X[2] - X[0]);
    });
  }
}

/// A straight pipe along z with the given section and division of its length: hexes of order 1 or 2, or
/// wedges. Boundaries inlet (lower z), outlet, wall, or as named.
template <class Element>
GlobalMesh<Element> pipe(const Disc& section, const Axis& z,
                         const ExtrudeOptions& ends = {"inlet", "outlet", false},
                         const std::string& wall = "wall") {
  if constexpr (Element::shape == Shape::wedge) {
    return extrude<Element>(disc<Tri1>(section, wall), z, ends);
  } else {
    using Plane = std::conditional_t<Element::order == 1, Quad1, Quad2>;
    return extrude<Element>(disc<Plane>(section, wall), z, ends);
  }
}

}  // namespace ifsi
