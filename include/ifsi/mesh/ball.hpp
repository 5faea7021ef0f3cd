#pragma once
/// \file
/// Discs (quads) and balls (hexes) about the origin, whole or cut by symmetry planes.

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/topology.hpp"

namespace ifsi {

/// A rounded cube of cells in the middle, shells around it.
struct Ball {
  double radius = 1;
  double core_radius = 0.6;  ///< from the centre to the corners of the rounded cube
  int n_core = 8;            ///< cells along a side of the whole cube; even where a plane cuts it
  int n_shell = 4;           ///< layers from the cube to the surface
  double shell_ratio = 1;    ///< thickness of the outermost layer over that at the cube
};

namespace detail {

/// Boundary `surface`, and where half[d] cuts the ball at x_d = 0 cut_x, cut_y or cut_z.
template <class Element>
void name_ball_boundaries(GlobalMesh<Element>& mesh, const std::array<bool, Element::dim>& half,
                          double radius) {
  constexpr std::array names{"cut_x", "cut_y", "cut_z"};
  mesh.boundary_names = {"surface"};
  std::array<int, Element::dim> cut{};
  for (int d = 0; d < Element::dim; ++d)
    if (half[d]) {
      cut[d] = static_cast<int>(mesh.boundary_names.size());
      mesh.boundary_names.emplace_back(names[d]);
    }
  mark_boundaries(mesh, [&](const Vec<double, Element::dim>& x) {
    for (int d = 0; d < Element::dim; ++d)
      if (half[d] && std::abs(x[d]) < 1e-9 * radius) return cut[d];
    return 0;
  });
}

/// Builds a ball from the lattice of its core and, over each outer face of the lattice, a column of shell
/// cells.
template <class Element>
class BallMesh {
  static constexpr int dim = Element::dim;
  static_assert(is_tensor_cell<Element> && Element::order == 1);
  using Point = Vec<double, dim>;
  using Index = std::array<int, dim>;

 public:
  BallMesh(const Ball& ball, const std::array<bool, dim>& half) : ball_(ball), half_(half) {
    check();
    layers_ = geometric_axis(0, 1, ball.n_shell, ball.shell_ratio);
    for (int d = 0; d < dim; ++d) {
      first_[d] = half[d] ? ball.n_core / 2 : 0;
      counts_[d] = ball.n_core - first_[d];
    }
  }

  GlobalMesh<Element> build() {
    Lattice<dim> lattice{counts_, 1};
    Index points;
    for (int d = 0; d < dim; ++d) points[d] = counts_[d] + 1;
    Lattice<dim>::for_each(points, [&](const Index& i) { add_points(i, lattice); });
    Lattice<dim>::for_each(counts_, [&](const Index& i) { add_cell(i, lattice); });
    Lattice<dim>::for_each(counts_, [&](const Index& i) {
      for (int d = 0; d < dim; ++d) {
        if (i[d] == 0 && first_[d] == 0) add_column(i, d, false, lattice);
        if (i[d] == counts_[d] - 1) add_column(i, d, true, lattice);
      }
    });
    name_ball_boundaries(mesh_, half_, ball_.radius);
    return std::move(mesh_);
  }

 private:
  void check() const {
    const bool cut = half_ != std::array<bool, dim>{};
    if (ball_.n_core < 1 || ball_.n_shell < 1 || (cut && ball_.n_core % 2 == 1) || !(ball_.core_radius > 0) ||
        !(ball_.core_radius < ball_.radius))
      throw Error(ExitCode::configuration,
                  "ball: found radius " + std::to_string(ball_.radius) + ", core radius " +
                      std::to_string(ball_.core_radius) + ", " + std::to_string(ball_.n_core) + " and " +
                      std::to_string(ball_.n_shell) +
                      " cells; expected 0 < core_radius < radius, positive counts, an even count in the core "
                      "where a plane cuts it");
  }

  /// Lattice coordinates in [-1, 1].
  [[nodiscard]] Point cube_point(const Index& i) const {
    Point s;
    for (int d = 0; d < dim; ++d) s[d] = 2.0 * (first_[d] + i[d]) / ball_.n_core - 1.0;
    return s;
  }
  [[nodiscard]] bool outer(const Index& i) const {
    for (int d = 0; d < dim; ++d)
      if (i[d] == counts_[d] || (i[d] == 0 && first_[d] == 0)) return true;
    return false;
  }
  /// Half-way between a cube and the ball it is inscribed in.
  [[nodiscard]] Point core_point(const Point& s) const {
    const double side = ball_.core_radius / std::sqrt(static_cast<double>(dim));
    Point x;
    for (int d = 0; d < dim; ++d) {
      const double t = s[(d + 1) % dim] * s[(d + 1) % dim],
                   u = dim == 3 ? s[(d + 2) % dim] * s[(d + 2) % dim] : 0;
      const double round = std::sqrt(dim) * s[d] * std::sqrt(1 - t / 2 - u / 2 + t * u / 3);
      x[d] = 0.5 * side * (s[d] + round);
    }
    return x;
  }
  /// On the sphere, the angles between neighbours nearly equal.
  [[nodiscard]] Point surface_point(const Point& s) const {
    Point x;
    for (int d = 0; d < dim; ++d) x[d] = std::tan(s[d] * std::numbers::pi / 4);
    return (ball_.radius / std::sqrt(dot(x, x))) * x;
  }

  void add_points(const Index& i, const Lattice<dim>& lattice) {
    const Point s = cube_point(i), core = core_point(s);
    columns_.resize(lattice.index(i) + 1);
    auto& column = columns_.back();
    column.push_back(mesh_.n_points());
    mesh_.points.push_back(core);
    if (!outer(i)) return;
    const Point surface = surface_point(s);
    for (int layer = 1; layer <= ball_.n_shell; ++layer) {
      const double w = layers_[layer];
      column.push_back(mesh_.n_points());
      mesh_.points.push_back(layer == ball_.n_shell ? surface : (1 - w) * core + w * surface);
    }
  }

  static int upper(int a, int d) { return Element::nodes[a][d] > 0 ? 1 : 0; }

  void add_cell(const Index& i, const Lattice<dim>& lattice) {
    auto& cell = mesh_.cells.emplace_back();
    for (int a = 0; a < Element::n_nodes; ++a) {
      Index j;
      for (int d = 0; d < dim; ++d) j[d] = i[d] + upper(a, d);
      cell[a] = columns_[lattice.index(j)][0];
    }
  }

  /// Shell cells over the face of core cell i normal to axis d.
  void add_column(const Index& i, int d, bool high, const Lattice<dim>& lattice) {
    for (int layer = 0; layer < ball_.n_shell; ++layer) {
      auto& cell = mesh_.cells.emplace_back();
      for (int a = 0; a < Element::n_nodes; ++a) {
        Index j;
        for (int e = 0; e < dim; ++e) j[e] = i[e] + (e == d ? high : upper(a, e));
        cell[a] = columns_[lattice.index(j)][layer + (upper(a, d) == high)];
      }
    }
  }

  Ball ball_;
  std::array<bool, dim> half_;
  Index first_, counts_;
  Axis layers_;                            ///< of the shells, from 0 at the cube to 1 at the surface
  std::vector<std::vector<int>> columns_;  ///< per lattice point: the core's point, then those of the shells
  GlobalMesh<Element> mesh_;
};

}  // namespace detail

/// A disc of quads or a ball of hexes about the origin, boundary `surface`; with half[d] only its part at
/// x_d >= 0, the cut being the boundary cut_x, cut_y or cut_z. Throws Error(configuration) when the numbers
/// make no ball.
template <class Element>
GlobalMesh<Element> ball(const Ball& b, const std::array<bool, Element::dim>& half = {}) {
  return detail::BallMesh<Element>(b, half).build();
}

/// Moves a mesh by an offset.
template <class Element>
GlobalMesh<Element> moved(GlobalMesh<Element> mesh, const Vec<double, Element::dim>& by) {
  for (auto& x : mesh.points) x += by;
  return mesh;
}

}  // namespace ifsi
