#pragma once
/// \file
/// Quadrature over the faces of a named boundary.

#include <array>
#include <span>
#include <vector>

#include "ifsi/element/elements.hpp"
#include "ifsi/element/geometry.hpp"
#include "ifsi/mesh/mesh.hpp"
#include "ifsi/quadrature/basis_table.hpp"
#include "ifsi/quadrature/quadrature.hpp"

namespace ifsi {

/// One quadrature point of a boundary face.
template <int dim>
struct FacePoint {
  int cell;                    ///< local cell the face belongs to
  std::span<const int> nodes;  ///< local nodes of the face
  std::span<const double> N;   ///< their shape functions here
  Vec<double, dim> x;
  Vec<double, dim> n_dA;  ///< outward unit normal times quadrature weight times area
};

namespace detail {

/// Visits the quadrature points of one face, Face being its element type.
template <class Face, class Coordinates, class Element, class Visit>
void visit_face(const Mesh<Element>& mesh, const BoundaryFace& face, Visit&& visit) {
  constexpr int dim = Element::dim;
  using Rule = DefaultQuadrature<Face>;
  using Table = BasisTable<Face, Rule>;
  const std::span<const int> local = Element::face_nodes(face.local_face);
  std::array<int, Face::n_nodes> nodes;
  std::array<Vec<double, dim>, Face::n_nodes> X;
  for (int a = 0; a < Face::n_nodes; ++a) {
    nodes[a] = mesh.cells[face.cell][local[a]];
    X[a] = mesh.points[mesh.cell_points[face.cell][local[a]]];
  }
  for (int q = 0; q < Rule::n; ++q) {
    FacePoint<dim> point{face.cell, nodes, Table::N[q], interpolate(Table::N[q], X), {}};
    point.n_dA =
        (Rule::weights[q] * Coordinates::measure(point.x[0])) * area_normal(jacobian(Table::dN[q], X));
    visit(point);
  }
}

}  // namespace detail

/// Visits every quadrature point of the faces of one boundary, those of ghost cells included: rows of owned
/// nodes are then complete. For integrals take only faces of owned cells (`owned_only`).
template <class Coordinates, class Element, class Visit>
void for_each_face_point(const Mesh<Element>& mesh, int boundary, bool owned_only, Visit&& visit) {
  for (const BoundaryFace& face : mesh.boundary_faces) {
    if (face.boundary != boundary || (owned_only && face.cell >= mesh.n_owned_cells)) continue;
    if constexpr (requires { typename Element::OtherFace; }) {
      if (Element::face_shape(face.local_face) == Element::OtherFace::shape) {
        detail::visit_face<typename Element::OtherFace, Coordinates>(mesh, face, visit);
        continue;
      }
    }
    detail::visit_face<typename Element::Face, Coordinates>(mesh, face, visit);
  }
}

}  // namespace ifsi
