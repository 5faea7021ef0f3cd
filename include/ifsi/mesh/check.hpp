#pragma once
/// \file
/// Is a mesh fit for use? Each failure says what is wrong and where.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/element/geometry.hpp"
#include "ifsi/element/instantiate.hpp"
#include "ifsi/mesh/global_mesh.hpp"
#include "ifsi/mesh/topology.hpp"

namespace ifsi {

/// Throws Error(configuration) when there are more ranks than cells.
inline void check_ranks(int n_cells, int n_ranks) {
  if (n_ranks > n_cells)
    throw Error(ExitCode::configuration, "mesh: " + std::to_string(n_cells) +
                                             " cells cannot be spread over " + std::to_string(n_ranks) +
                                             " ranks; expected at most one rank per cell");
}

namespace detail {

template <int dim>
std::string text(const Vec<double, dim>& x) {
  std::string s = "(";
  for (int d = 0; d < dim; ++d) s += (d ? ", " : "") + std::to_string(x[d]);
  return s + ")";
}

template <class Element>
void check_indices(const GlobalMesh<Element>& mesh) {
  const auto fail = [](const std::string& what) { throw Error(ExitCode::file, "mesh: " + what); };
  if (mesh.cells.empty())
    fail("there are no cells of type " + std::string(Element::name) + "; expected at least one");
  if (!mesh.point_node.empty() && mesh.point_node.size() != mesh.points.size())
    fail("point_node must be empty or name a node for each of the " + std::to_string(mesh.n_points()) +
         " points");
  if (!mesh.cell_region.empty() && mesh.cell_region.size() != mesh.cells.size())
    fail("cell_region must be empty or name a region for each of the " + std::to_string(mesh.n_cells()) +
         " cells");
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (int p : mesh.cells[c]) {
      if (p < 0 || p >= mesh.n_points())
        fail("cell " + std::to_string(c) + " names point " + std::to_string(p) + "; expected 0.." +
             std::to_string(mesh.n_points() - 1));
      for (int d = 0; d < Element::dim; ++d)
        if (!std::isfinite(mesh.points[p][d]))
          fail("point " + std::to_string(p) + " of cell " + std::to_string(c) + " has the coordinates " +
               text(mesh.points[p]) + "; expected finite numbers");
    }
  for (int node : mesh.point_node)
    if (node < 0 || node >= mesh.n_points())
      fail("point_node holds " + std::to_string(node) + ", which is no point");
  for (const auto& face : mesh.boundary_faces)
    if (face.cell < 0 || face.cell >= mesh.n_cells() || face.local_face < 0 ||
        face.local_face >= Element::n_faces || face.boundary < 0 ||
        face.boundary >= static_cast<int>(mesh.boundary_names.size()))
      fail("a boundary face names cell " + std::to_string(face.cell) + ", face " +
           std::to_string(face.local_face) + ", boundary " + std::to_string(face.boundary) +
           ", which do not all exist");
}

/// Every point must belong to a cell.
template <class Element>
void check_points_used(const GlobalMesh<Element>& mesh) {
  std::vector<char> used(mesh.points.size(), 0);
  for (const auto& cell : mesh.cells)
    for (int p : cell) used[p] = 1;
  const auto unused = std::count(used.begin(), used.end(), 0);
  if (unused == 0) return;
  const auto first = std::find(used.begin(), used.end(), 0) - used.begin();
  throw Error(ExitCode::file, "mesh: " + std::to_string(unused) +
                                  " points belong to no cell, the first is point " + std::to_string(first) +
                                  " at " + text(mesh.points[first]) +
                                  "; expected every point in a cell (drop_unused_points() removes them)");
}

/// Determinant of the Jacobian at each node of the reference cell must be positive.
template <class Element>
void check_inverted(const GlobalMesh<Element>& mesh) {
  constexpr int n_checked = Element::linear ? 1 : Element::n_nodes;
  static const auto tables = [] {
    std::array<std::array<Vec<double, Element::dim>, Element::n_nodes>, n_checked> dN;
    for (int a = 0; a < n_checked; ++a) Element::gradients(Element::nodes[a], dN[a]);
    return dN;
  }();
  int inverted = 0, first = -1;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto X = mesh.cell_coordinates(c);
    bool positive = true;
    for (const auto& dN : tables) positive &= det(jacobian(dN, X)) > 0;
    if (positive) continue;
    if (inverted++ == 0) first = c;
  }
  if (inverted == 0) return;
  throw Error(ExitCode::file, "mesh: " + std::to_string(inverted) + " of " + std::to_string(mesh.n_cells()) +
                                  " cells are inverted or flat, the first is cell " + std::to_string(first) +
                                  " near " + text(mesh.cell_coordinates(first)[0]) +
                                  "; expected det J > 0 at every node of every cell");
}

/// Number of parts not connected by shared nodes, and a cell of the second part.
template <class Element>
std::array<int, 2> count_parts(const GlobalMesh<Element>& mesh) {
  std::vector<int> parent(mesh.points.size());
  for (size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& cell : mesh.cells)
    for (int p : cell) parent[root(mesh.node(p))] = root(mesh.node(cell[0]));
  std::vector<char> seen(mesh.points.size(), 0);
  std::array<int, 2> parts{0, -1};
  for (int c = 0; c < mesh.n_cells(); ++c) {
    char& known = seen[root(mesh.node(mesh.cells[c][0]))];
    if (known) continue;
    known = 1;
    if (++parts[0] == 2) parts[1] = c;
  }
  return parts;
}

template <class Element>
void check_connected(const GlobalMesh<Element>& mesh) {
  const auto [parts, cell] = count_parts(mesh);
  if (parts == 1) return;
  throw Error(ExitCode::file,
              "mesh: it falls into " + std::to_string(parts) + " disconnected parts; cell " +
                  std::to_string(cell) + " near " + text(mesh.cell_coordinates(cell)[0]) +
                  " is not reached from cell 0; expected one part (are coincident points merged?)");
}

}  // namespace detail

/// What is looked for besides what makes a mesh unusable.
struct CheckOptions {
  bool connected = true;    ///< several disconnected parts are an error
  bool points_used = true;  ///< a point in no cell is an error
};

/// Throws Error(file) for indices out of range, coordinates that are not finite, inverted cells, disconnected
/// parts, or points in no cell. O(cells).
template <class Element>
void check(const GlobalMesh<Element>& mesh, const CheckOptions& options = {}) {
  detail::check_indices(mesh);
  if (options.points_used) detail::check_points_used(mesh);
  detail::check_inverted(mesh);
  if (options.connected) detail::check_connected(mesh);
}

/// Removes the points that no cell uses. In periodic meshes each node is called by its lowest remaining
/// point.
template <class Element>
void drop_unused_points(GlobalMesh<Element>& mesh) {
  std::vector<int> number(mesh.points.size(), -1), node_name(mesh.points.size(), -1), nodes;
  for (const auto& cell : mesh.cells)
    for (int p : cell) number[p] = 0;
  int n = 0;
  for (int p = 0; p < mesh.n_points(); ++p) {
    if (number[p] < 0) continue;
    mesh.points[n] = mesh.points[p];
    int& name = node_name[mesh.node(p)];
    if (name < 0) name = n;
    nodes.push_back(name);
    number[p] = n++;
  }
  mesh.points.resize(n);
  if (!mesh.point_node.empty()) mesh.point_node = std::move(nodes);
  for (auto& cell : mesh.cells)
    for (int& p : cell) p = number[p];
}

// Compiled once for each element, in src/instantiate.
#define IFSI_CHECK(Element, external)                                            \
  external template void check(const GlobalMesh<Element>&, const CheckOptions&); \
  external template void drop_unused_points(GlobalMesh<Element>&);
IFSI_FOR_EACH_CELL(IFSI_CHECK, extern)

}  // namespace ifsi
