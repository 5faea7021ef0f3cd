#pragma once
/// \file
/// Order-2 meshes from order-1 meshes: nodes are added on edges, faces and in cells.

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/topology.hpp"

namespace ifsi {

namespace detail {

/// The vertices whose mean is node a of an order-2 cell.
template <class Second, class First>
std::vector<int> supporting_vertices(int a) {
  std::array<double, First::n_nodes> N;
  First::shape_functions(Second::nodes[a], N);
  std::vector<int> vertices;
  for (int v = 0; v < First::n_nodes; ++v)
    if (N[v] > 1e-12) vertices.push_back(v);
  return vertices;
}

/// A node to be made: nodes of different cells with the same topological vertices are one.
struct NewNode {
  std::array<int, 8> key;
  int cell;
  int local;
};

template <class Second, class First>
std::vector<NewNode> new_nodes(const GlobalMesh<First>& mesh) {
  std::vector<NewNode> nodes;
  for (int a = First::n_nodes; a < Second::n_nodes; ++a) {
    const auto support = supporting_vertices<Second, First>(a);
    for (int c = 0; c < mesh.n_cells(); ++c) {
      NewNode node{{-1, -1, -1, -1, -1, -1, -1, -1}, c, a};
      for (size_t i = 0; i < support.size(); ++i) node.key[i] = mesh.cells[c][support[i]];
      std::sort(node.key.begin(), node.key.begin() + support.size());
      nodes.push_back(node);
    }
  }
  std::sort(nodes.begin(), nodes.end(), [](const NewNode& a, const NewNode& b) {
    return std::tie(a.key, a.cell, a.local) < std::tie(b.key, b.cell, b.local);
  });
  return nodes;
}

}  // namespace detail

/// Adds the mid nodes of the order-2 element Second (Tri2 for Tri1, ...) half-way between the vertices.
/// Points of boundary faces that are new then move to project(boundary, x), so that curved boundaries can be
/// followed. The mesh must not be periodic: throws Error(configuration).
template <class Second, class First, class Project>
GlobalMesh<Second> elevate(const GlobalMesh<First>& mesh, Project&& project) {
  static_assert(First::order == 1 && Second::order == 2 && First::shape == Second::shape);
  if (!mesh.point_node.empty())
    throw Error(ExitCode::configuration,
                "elevate: found a periodic mesh; expected one without periodic sides");
  GlobalMesh<Second> out{mesh.points,      {}, {}, mesh.boundary_faces, mesh.boundary_names, mesh.cell_region,
                         mesh.region_names};
  out.cells.resize(mesh.cells.size());
  for (int c = 0; c < mesh.n_cells(); ++c)
    std::copy(mesh.cells[c].begin(), mesh.cells[c].end(), out.cells[c].begin());
  const auto nodes = detail::new_nodes<Second>(mesh);
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (i == 0 || nodes[i].key != nodes[i - 1].key) {
      auto x = Vec<double, First::dim>::zero();
      int count = 0;
      for (int v : nodes[i].key)
        if (v >= 0) x += mesh.points[v], ++count;
      out.points.push_back((1.0 / count) * x);
    }
    out.cells[nodes[i].cell][nodes[i].local] = out.n_points() - 1;
  }
  for (const auto& face : out.boundary_faces)
    for (int a : Second::face_nodes(face.local_face))
      if (a >= First::n_nodes) {
        auto& x = out.points[out.cells[face.cell][a]];
        x = project(face.boundary, x);
      }
  return out;
}

/// Elevation with straight cells.
template <class Second, class First>
GlobalMesh<Second> elevate(const GlobalMesh<First>& mesh) {
  return elevate<Second>(mesh, [](int, const Vec<double, First::dim>& x) { return x; });
}

}  // namespace ifsi
