#pragma once
/// \file
/// The shape of a rigid body from its mesh.

#include <algorithm>
#include <vector>

#include "ifsi/element/geometry.hpp"
#include "ifsi/mesh/global_mesh.hpp"
#include "ifsi/quadrature/basis_table.hpp"
#include "ifsi/quadrature/coordinates.hpp"
#include "ifsi/quadrature/quadrature.hpp"
#include "ifsi/solid/rigid_body.hpp"

namespace ifsi {

/// Volume, centroid and second moments of a mesh, exact for cells of order one. A body of revolution (r, z)
/// has its centroid on the axis.
template <class Coordinates, class Element>
[[nodiscard]] RigidShape<Element::dim> rigid_shape(const GlobalMesh<Element>& mesh) {
  constexpr int dim = Element::dim;
  using Rule = Quadrature<Element, 2 * Element::order + 3>;
  using Table = BasisTable<Element, Rule>;
  const auto integrate = [&](auto&& visit) {
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const auto X = mesh.cell_coordinates(c);
      for (int q = 0; q < Rule::n; ++q) {
        const auto x = interpolate(Table::N[q], X);
        visit(x, Rule::weights[q] * det(jacobian(Table::dN[q], X)) * Coordinates::measure(x[0]));
      }
    }
  };
  RigidShape<dim> shape;
  integrate([&](const Vec<double, dim>& x, double dV) {
    shape.volume += dV;
    shape.centre += dV * x;
  });
  shape.centre = (1.0 / shape.volume) * shape.centre;
  if (Coordinates::axisymmetric) shape.centre[0] = 0.0;
  integrate([&](const Vec<double, dim>& x, double dV) {
    shape.second_moments += dV * outer(x - shape.centre, x - shape.centre);
  });
  return shape;
}

/// Points of the faces on a named boundary, ascending.
template <class Element>
[[nodiscard]] std::vector<Vec<double, Element::dim>> boundary_points(const GlobalMesh<Element>& mesh,
                                                                     int boundary) {
  std::vector<int> nodes;
  for (const BoundaryFace& face : mesh.boundary_faces)
    if (face.boundary == boundary)
      for (int a : Element::face_nodes(face.local_face)) nodes.push_back(mesh.cells[face.cell][a]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vec<double, Element::dim>> points;
  for (int node : nodes) points.push_back(mesh.points[node]);
  return points;
}

}  // namespace ifsi
