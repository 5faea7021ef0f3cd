#pragma once
/// \file
/// Traction of a flow on walls, and the wall shear stress.

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "ifsi/assembly/face_loop.hpp"

namespace ifsi {

/// Force of the fluid per area at the nodes of walls, and its tangential part, the wall shear stress. Every
/// local node has an entry; it is zero off the walls.
template <int dim>
struct WallTraction {
  std::vector<Vec<double, dim>> traction, shear;
};

/// Consistent nodal forces over the nodes' parts of the walls' area (eq. 31). Collective.
/// \param R residual before prescribed unknowns are removed, dim + 1 numbers per node.
/// \throws Error (configuration) for a boundary that the mesh does not have
template <class Coordinates, class Element>
[[nodiscard]] WallTraction<Element::dim> wall_traction(const Mesh<Element>& mesh,
                                                       const std::vector<std::string>& walls,
                                                       std::span<const double> R) {
  static_assert(Element::shape != Shape::tet || Element::order == 1,
                "the vertices of quadratic triangles have no part of their area");
  constexpr int dim = Element::dim;
  using Point = Vec<double, dim>;
  const std::vector<Point> none(mesh.n_nodes(), Point::zero());
  WallTraction<dim> wall{none, none};
  std::vector<double> area(mesh.n_nodes(), 0.0);
  std::vector<Point> n_area = none;
  for (const std::string& name : walls)
    for_each_face_point<Coordinates>(mesh, mesh.boundary(name), false, [&](const FacePoint<dim>& q) {
      const double dA = std::sqrt(dot(q.n_dA, q.n_dA));
      for (std::size_t a = 0; a < q.nodes.size(); ++a)
        area[q.nodes[a]] += q.N[a] * dA, n_area[q.nodes[a]] += q.N[a] * q.n_dA;
    });
  for (int node = 0; node < mesh.n_owned_nodes(); ++node) {
    if (area[node] <= 0.0) continue;
    Point& t = wall.traction[node];
    for (int i = 0; i < dim; ++i) t[i] = -R[node * (dim + 1) + i] / area[node];
    const double n2 = dot(n_area[node], n_area[node]);
    wall.shear[node] = t - (n2 > 0.0 ? dot(t, n_area[node]) / n2 : 0.0) * n_area[node];
  }
  mesh.nodes.update_ghosts(wall.traction.data());
  mesh.nodes.update_ghosts(wall.shear.data());
  return wall;
}

}  // namespace ifsi
