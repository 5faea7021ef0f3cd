#pragma once
/// \file
/// Triangles from quads and tetrahedra from hexes, of order 1 or 2. An order-2 child takes all its nodes from
/// the order-2 parent, so that curved boundaries stay curved.

#include <algorithm>
#include <vector>

#include "ifsi/mesh/reference_lattice.hpp"

namespace ifsi {

namespace detail {

/// Children of one parent cell: their nodes, and on which face of the parent (or -1) each of their faces
/// lies.
template <class Child, class Parent>
struct SplitTable {
  std::vector<std::array<int, Child::n_nodes>> nodes;
  std::vector<std::array<int, Child::n_faces>> parent_face;

  explicit SplitTable(const std::vector<std::array<int, Child::dim + 1>>& children) {
    for (const auto& vertices : children) add(vertices);
  }

 private:
  void add(const std::array<int, Child::dim + 1>& vertices) {
    auto& child = nodes.emplace_back();
    for (int a = 0; a < Child::n_nodes; ++a) {
      auto xi = Parent::nodes[vertices[0]];
      for (int d = 0; d < Child::dim; ++d)
        xi += Child::nodes[a][d] * (Parent::nodes[vertices[d + 1]] - Parent::nodes[vertices[0]]);
      child[a] = find_node<Parent>(xi);
    }
    auto& faces = parent_face.emplace_back();
    for (int f = 0; f < Child::n_faces; ++f) faces[f] = containing_face(child, face_vertices<Child>(f));
  }

  static int containing_face(const std::array<int, Child::n_nodes>& child, const std::vector<int>& vertices) {
    for (int f = 0; f < Parent::n_faces; ++f) {
      const auto face = Parent::face_nodes(f);
      const bool inside = std::all_of(vertices.begin(), vertices.end(), [&](int a) {
        return std::find(face.begin(), face.end(), child[a]) != face.end();
      });
      if (inside) return f;
    }
    return -1;
  }
};

template <class Child, class Parent>
const SplitTable<Child, Parent>& split_table(bool second_diagonal) {
  if constexpr (Child::dim == 2) {
    static const SplitTable<Child, Parent> first({{0, 1, 2}, {0, 2, 3}}), second({{0, 1, 3}, {1, 2, 3}});
    return second_diagonal ? second : first;
  } else {
    // Six tetrahedra around the diagonal 0-6: opposite faces of the parent are cut alike.
    static const SplitTable<Child, Parent> six(
        {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}});
    return six;
  }
}

}  // namespace detail

/// Splits each quad into two triangles, along the diagonal 0-2, or 1-3 where second_diagonal(cell) is true;
/// or each hex into six tetrahedra (conforming only when all hexes are oriented alike, as in a box;
/// second_diagonal is not used). Boundary faces and regions are inherited.
template <class Child, class Parent, class Choice>
GlobalMesh<Child> split(const GlobalMesh<Parent>& mesh, Choice&& second_diagonal) {
  static_assert(Child::dim == Parent::dim && Child::order == Parent::order && is_tensor_cell<Parent>);
  GlobalMesh<Child> out{mesh.points, {}, mesh.point_node, {}, mesh.boundary_names, {}, mesh.region_names};
  const auto table = [&](int c) -> const auto& {
    return detail::split_table<Child, Parent>(second_diagonal(c));
  };
  const int children = static_cast<int>(table(0).nodes.size());
  out.cells.reserve(mesh.cells.size() * children);
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const auto& nodes : table(c).nodes) {
      auto& cell = out.cells.emplace_back();
      for (int a = 0; a < Child::n_nodes; ++a) cell[a] = mesh.cells[c][nodes[a]];
      if (!mesh.cell_region.empty()) out.cell_region.push_back(mesh.cell_region[c]);
    }
  for (const auto& face : mesh.boundary_faces)
    for (int k = 0; k < children; ++k)
      for (int f = 0; f < Child::n_faces; ++f)
        if (table(face.cell).parent_face[k][f] == face.local_face)
          out.boundary_faces.push_back({face.cell * children + k, f, face.boundary});
  return out;
}

}  // namespace ifsi
