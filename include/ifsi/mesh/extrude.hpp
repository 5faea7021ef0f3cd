#pragma once
/// \file
/// Prisms over a plane mesh: hexes over quads, wedges over triangles.

#include <algorithm>
#include <string>
#include <vector>

#include "ifsi/mesh/axis.hpp"
#include "ifsi/mesh/reference_lattice.hpp"

namespace ifsi {

/// Names of the two new boundaries of an extruded mesh, and whether they are identified with each other
/// instead.
struct ExtrudeOptions {
  std::string lower = "front";
  std::string upper = "back";
  bool periodic = false;
};

namespace detail {

/// Where the nodes and faces of a prism come from.
template <class Prism, class Plane>
struct ExtrudeTable {
  std::array<int, Prism::n_nodes> node;   ///< node of the plane cell below each node
  std::array<int, Prism::n_nodes> level;  ///< 0 .. order
  std::array<int, Plane::n_faces> side;   ///< face of the prism over each face of the plane cell
  int lower = -1, upper = -1;             ///< faces at the two ends

  ExtrudeTable() {
    for (int a = 0; a < Prism::n_nodes; ++a) {
      const auto& xi = Prism::nodes[a];
      node[a] = find_node<Plane>({xi[0], xi[1]});
      level[a] = static_cast<int>((xi[2] + 1) / 2 * Prism::order + 0.5);
    }
    for (int f = 0; f < Prism::n_faces; ++f) classify(f);
  }

 private:
  void classify(int f) {
    const auto vertices = face_vertices<Prism>(f);
    const auto all_at = [&](int l) {
      return std::all_of(vertices.begin(), vertices.end(), [&](int a) { return level[a] == l; });
    };
    if (all_at(0)) lower = f;
    if (all_at(Prism::order)) upper = f;
    for (int s = 0; s < Plane::n_faces; ++s) {
      const auto plane = face_vertices<Plane>(s);
      if (std::all_of(vertices.begin(), vertices.end(),
                      [&](int a) { return std::find(plane.begin(), plane.end(), node[a]) != plane.end(); }))
        side[s] = f;
    }
  }
};

inline int find_or_add(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) names.push_back(name);
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Copies of the plane points at every level of every layer.
template <class Prism, class Plane>
void extrude_points(const GlobalMesh<Plane>& plane, const Axis& z, bool periodic, GlobalMesh<Prism>& mesh) {
  constexpr int order = Prism::order;
  const int n = plane.n_points(), levels = static_cast<int>(z.size() - 1) * order + 1;
  mesh.points.reserve(static_cast<size_t>(levels) * n);
  for (int l = 0; l < levels; ++l) {
    const int k = l / order;
    const double height = l % order == 0 ? z[k] : 0.5 * (z[k] + z[k + 1]);
    for (const auto& x : plane.points) mesh.points.push_back({x[0], x[1], height});
    if (!periodic && plane.point_node.empty()) continue;
    for (int i = 0; i < n; ++i)
      mesh.point_node.push_back((periodic && l == levels - 1 ? 0 : l) * n + plane.node(i));
  }
}

/// Layer k: a prism over each plane cell, a side face over each boundary face.
template <class Prism, class Plane>
void extrude_layer(const GlobalMesh<Plane>& plane, int k, const ExtrudeTable<Prism, Plane>& table,
                   GlobalMesh<Prism>& mesh) {
  for (const auto& face : plane.boundary_faces)
    mesh.boundary_faces.push_back(
        {k * plane.n_cells() + face.cell, table.side[face.local_face], face.boundary});
  for (const auto& below : plane.cells) {
    auto& cell = mesh.cells.emplace_back();
    for (int a = 0; a < Prism::n_nodes; ++a)
      cell[a] = (k * Prism::order + table.level[a]) * plane.n_points() + below[table.node[a]];
  }
  mesh.cell_region.insert(mesh.cell_region.end(), plane.cell_region.begin(), plane.cell_region.end());
}

}  // namespace detail

/// Extrudes a plane mesh along z. Boundaries keep their names; the ends get those of the options. Order-2
/// prisms have their middle level half-way. Throws Error(configuration) when z does not increase, or a
/// periodic z has fewer than three layers.
template <class Prism, class Plane>
GlobalMesh<Prism> extrude(const GlobalMesh<Plane>& plane, const Axis& z, const ExtrudeOptions& options = {}) {
  static_assert(Prism::dim == 3 && Plane::dim == 2 && Prism::order == Plane::order);
  static const detail::ExtrudeTable<Prism, Plane> table;
  check_increasing(z, "extrude: z");
  const int layers = static_cast<int>(z.size()) - 1;
  if (options.periodic && layers < 3)
    throw Error(ExitCode::configuration,
                "extrude: found " + std::to_string(layers) + " periodic layers; expected at least three");
  GlobalMesh<Prism> mesh;
  mesh.boundary_names = plane.boundary_names;
  mesh.region_names = plane.region_names;
  detail::extrude_points(plane, z, options.periodic, mesh);
  for (int k = 0; k < layers; ++k) detail::extrude_layer(plane, k, table, mesh);
  if (options.periodic) return mesh;
  const int lower = detail::find_or_add(mesh.boundary_names, options.lower);
  const int upper = detail::find_or_add(mesh.boundary_names, options.upper);
  for (int c = 0; c < plane.n_cells(); ++c) {
    mesh.boundary_faces.push_back({c, table.lower, lower});
    mesh.boundary_faces.push_back({(layers - 1) * plane.n_cells() + c, table.upper, upper});
  }
  return mesh;
}

}  // namespace ifsi
