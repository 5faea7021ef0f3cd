#pragma once
/// \file
/// Measures of meshes by quadrature, independent of how the meshes were made.

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "ifsi/element/geometry.hpp"
#include "ifsi/mesh/global_mesh.hpp"
#include "ifsi/mesh/topology.hpp"
#include "ifsi/quadrature/quadrature.hpp"

namespace ifsi::testing_mesh {

/// Length, area or volume.
template <class Element>
double volume(const GlobalMesh<Element>& mesh) {
  using Rule = DefaultQuadrature<Element>;
  double sum = 0;
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (int q = 0; q < Rule::n; ++q) {
      std::array<Vec<double, Element::dim>, Element::n_nodes> dN;
      Element::gradients(Rule::points[q], dN);
      sum += Rule::weights[q] * det(jacobian(dN, mesh.cell_coordinates(c)));
    }
  return sum;
}

/// Adds the measure of a face, and the flux of x through it, outwards.
template <class Element, class FaceElement>
void add_face(const GlobalMesh<Element>& mesh, int cell, int face, double& area, double& flux) {
  using Rule = DefaultQuadrature<FaceElement>;
  const auto X = on_face<Element, FaceElement>(face, mesh.cell_coordinates(cell));
  for (int q = 0; q < Rule::n; ++q) {
    std::array<Vec<double, Element::dim - 1>, FaceElement::n_nodes> dN;
    FaceElement::gradients(Rule::points[q], dN);
    const auto normal = area_normal(jacobian(dN, X));
    area += Rule::weights[q] * std::sqrt(dot(normal, normal));
    flux += Rule::weights[q] * dot(normal, map<FaceElement>(Rule::points[q], X));
  }
}

/// Measure of each boundary, and under "flux" the integral of x . n over all of them (dim times the volume).
template <class Element>
std::map<std::string, double> boundary_measures(const GlobalMesh<Element>& mesh) {
  std::map<std::string, double> areas;
  for (const auto& face : mesh.boundary_faces) {
    double& area = areas[mesh.boundary_names[face.boundary]];
    double& flux = areas["flux"];
    if constexpr (requires { typename Element::OtherFace; }) {
      if (Element::face_shape(face.local_face) == Element::OtherFace::shape) {
        add_face<Element, typename Element::OtherFace>(mesh, face.cell, face.local_face, area, flux);
        continue;
      }
    }
    add_face<Element, typename Element::Face>(mesh, face.cell, face.local_face, area, flux);
  }
  return areas;
}

/// Whether the boundary faces are exactly the faces that belong to one cell, each once; throws if a face has
/// more than two cells.
template <class Element>
bool boundary_is_exterior(const GlobalMesh<Element>& mesh) {
  std::map<std::pair<int, int>, int> found;
  for (const auto& face : mesh.boundary_faces) ++found[{face.cell, face.local_face}];
  const auto exterior = exterior_faces(mesh);
  bool same = found.size() == exterior.size();
  for (const auto& face : exterior) same &= found[{face.cell, face.local_face}] == 1;
  return same;
}

/// Whether cells that share a face agree on all of its nodes, mid nodes included.
template <class Element>
bool faces_conform(const GlobalMesh<Element>& mesh) {
  const auto nodes = [&](const CellFace& face) {
    std::vector<int> all;
    for (int a : Element::face_nodes(face.local_face)) all.push_back(mesh.node(mesh.cells[face.cell][a]));
    std::sort(all.begin(), all.end());
    return all;
  };
  bool conform = true;
  for_each_face(sorted_faces(mesh), [&](const CellFace* face, int sides) {
    if (sides == 2) conform &= nodes(face[0]) == nodes(face[1]);
  });
  return conform;
}

/// Area within n equal arcs of a circle, each replaced by its chord (order 1) or the parabola through its
/// ends and its middle (order 2, Archimedes: two thirds of chord times sagitta beyond the chord).
inline double area_within_arcs(int order, int n, double radius) {
  const double half = std::numbers::pi / n;
  const double beyond = order == 1 ? 0 : 2.0 / 3 * 2 * std::sin(half) * (1 - std::cos(half));
  return n * radius * radius * (0.5 * std::sin(2 * half) + beyond);
}

}  // namespace ifsi::testing_mesh
