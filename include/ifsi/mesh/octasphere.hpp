#pragma once
/// \file
/// Balls of tetrahedra whose points are spread evenly over the sphere, whole or cut by planes of symmetry.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "ifsi/core/error.hpp"
#include "ifsi/element/tet.hpp"
#include "ifsi/mesh/ball.hpp"
#include "ifsi/mesh/icosphere.hpp"

namespace ifsi {

/// An octahedron with edges cut into parts, blown up to a ball, in shells.
struct Octasphere {
  double radius = 1;
  int frequency = 4;  ///< parts of an edge of the octahedron
  int n_shell = 1;    ///< layers from the centre to the surface, all of one thickness
};

namespace detail {

/// Throws the lattice points |i| + |j| + |k| = f of an octahedron onto the sphere and repeats them on the
/// shells below.
class OctasphereMesh {
  using Point = Vec<double, 3>;
  using Index = std::array<int, 3>;

 public:
  OctasphereMesh(const Octasphere& ball, const std::array<bool, 3>& half) : ball_(ball), half_(half) {
    if (!(ball.radius > 0.0) || ball.frequency < 1 || ball.n_shell < 1)
      throw Error(ExitCode::configuration,
                  "octasphere: found radius " + std::to_string(ball.radius) + ", frequency " +
                      std::to_string(ball.frequency) + " and " + std::to_string(ball.n_shell) +
                      " shells; expected a positive radius and at least one of each");
  }

  GlobalMesh<Tet1> build() {
    mesh_.points.push_back(Point::zero());
    for (int octant = 0; octant < 8; ++octant) {
      const Index sign = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
      bool kept = true;
      for (int d = 0; d < 3; ++d) kept &= !(half_[d] && sign[d] < 0);
      if (kept) add_octant(sign);
    }
    name_ball_boundaries(mesh_, half_, ball_.radius);
    return std::move(mesh_);
  }

 private:
  void add_octant(const Index& sign) {
    const int f = ball_.frequency;
    const auto at = [&](int i, int j) {
      return column(Index{sign[0] * i, sign[1] * j, sign[2] * (f - i - j)});
    };
    for (int i = 0; i < f; ++i)
      for (int j = 0; i + j < f; ++j) {
        add_cone({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < f) add_cone({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
      }
  }

  /// The cells below a triangle of the surface: one at the centre, then in each shell a prism of three. The
  /// diagonal of a prism's side goes up from the edge's first column to its second. The two triangles at an
  /// edge name its columns in one order, also where they are mirror images in two octants.
  void add_cone(std::array<int, 3> c) {
    add_cell({0, c[0], c[1], c[2]});
    for (int shell = 1; shell < ball_.n_shell; ++shell) {
      const std::array<int, 3> up = {c[0] + 1, c[1] + 1, c[2] + 1};
      add_cell({c[0], c[1], c[2], up[2]});
      add_cell({c[0], c[1], up[1], up[2]});
      add_cell({c[0], up[0], up[1], up[2]});
      c = up;
    }
  }

  /// Turns a cell round that is inside out.
  void add_cell(std::array<int, 4> cell) {
    Mat<double, 3> edges;
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) edges(i, a) = mesh_.points[cell[a + 1]][i] - mesh_.points[cell[0]][i];
    if (det(edges) < 0.0) std::swap(cell[2], cell[3]);
    mesh_.cells.push_back(cell);
  }

  /// Innermost of the points below a lattice point; those further out have the numbers that follow.
  int column(const Index& i) {
    const auto [place, is_new] = columns_.try_emplace(i, mesh_.n_points());
    if (is_new)
      for (int shell = 1; shell <= ball_.n_shell; ++shell)
        mesh_.points.push_back((ball_.radius * shell / ball_.n_shell) * direction(i));
    return place->second;
  }

  /// The sines divide the edges of an octant into equal angles. What is added to all three draws the points
  /// towards its middle, where they would be sparse: 2 makes the areas they stand for most equal.
  [[nodiscard]] Point direction(const Index& i) const {
    const double f = ball_.frequency, inwards = 2.0 * std::abs(i[0] / f * (i[1] / f) * (i[2] / f));
    Point x;
    for (int d = 0; d < 3; ++d)
      x[d] = std::sin(0.5 * std::numbers::pi * i[d] / f) + std::copysign(inwards, i[d]);
    return (1.0 / std::sqrt(dot(x, x))) * x;
  }

  Octasphere ball_;
  std::array<bool, 3> half_;
  std::map<Index, int> columns_;  ///< lattice point to the innermost of its points
  GlobalMesh<Tet1> mesh_;
};

}  // namespace detail

/// A ball of tetrahedra about the origin, boundary `surface`, with 4 f^2 + 2 points on it that crowd nowhere;
/// with half[d] only its part at x_d >= 0, the cut being the boundary cut_x, cut_y or cut_z.
/// \throws Error (configuration) when the numbers make no ball.
inline GlobalMesh<Tet1> octasphere(const Octasphere& ball, const std::array<bool, 3>& half = {}) {
  return detail::OctasphereMesh(ball, half).build();
}

/// The frequency with which neighbours come nearest to a distance.
inline int octasphere_frequency(double radius, double spacing) {
  return std::max(1, static_cast<int>(std::lround(std::sqrt((even_count(radius, spacing) - 2.0) / 4.0))));
}

}  // namespace ifsi
