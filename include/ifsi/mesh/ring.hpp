#pragma once
/// \file
/// A plane ring.

#include <cmath>
#include <numbers>
#include <string>

#include "ifsi/core/error.hpp"
#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/weld.hpp"

namespace ifsi {

/// The ring between two radii about a centre, of equal cells in angle and radius; order-2 nodes lie on
/// circles. Boundaries inner, outer. \throws Error (configuration) for fewer than three cells around.
template <class Element>
GlobalMesh<Element> ring_mesh(const Vec<double, 2>& centre, double r_inner, double r_outer, int n_around,
                              int n_radial) {
  if (n_around < 3)
    throw Error(ExitCode::configuration,
                "ring: found " + std::to_string(n_around) + " cells around; expected at least 3");
  GlobalMesh<Element> mesh = box<Element>({0.0, 0.0}, {1.0, 1.0}, {n_radial, n_around});
  std::erase_if(mesh.boundary_faces, [&](const BoundaryFace& face) { return face.boundary > 1; });
  mesh.boundary_names = {"inner", "outer"};
  for (auto& x : mesh.points) {
    const double r = r_inner + x[0] * (r_outer - r_inner), angle = 2.0 * std::numbers::pi * x[1];
    x = {centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle)};
  }
  const double spacing = 2.0 * std::numbers::pi * r_inner / n_around;
  weld(mesh, 1e-6 * std::min(spacing, (r_outer - r_inner) / n_radial));
  return mesh;
}

}  // namespace ifsi
