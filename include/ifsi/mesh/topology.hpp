#pragma once
/// \file
/// Faces of cells: their vertices, which cells share them, and which lie on the exterior.

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/element/instantiate.hpp"
#include "ifsi/mesh/global_mesh.hpp"

namespace ifsi {

/// The vertices of a face, as local nodes of its cell.
template <class Element>
std::vector<int> face_vertices(int face) {
  std::vector<int> vertices;
  for (int a : Element::face_nodes(face))
    if (a < Element::n_vertices) vertices.push_back(a);
  return vertices;
}

/// face_vertices of all faces of an element.
template <class Element>
std::vector<std::vector<int>> all_face_vertices() {
  std::vector<std::vector<int>> all;
  for (int f = 0; f < Element::n_faces; ++f) all.push_back(face_vertices<Element>(f));
  return all;
}

/// A face seen from one of its cells. The key, its sorted vertex nodes, is the same from either side.
struct CellFace {
  std::array<int, 4> key;
  int cell;
  int local_face;
};

/// Sorts the first n entries, by insertion.
inline void sort_key(std::array<int, 4>& key, int n) {
  for (int i = 1; i < n; ++i)
    for (int j = i; j > 0 && key[j - 1] > key[j]; --j) std::swap(key[j - 1], key[j]);
}

/// Every face of every cell, ordered so that equal keys follow each other. O(cells).
template <class Element>
std::vector<CellFace> sorted_faces(const GlobalMesh<Element>& mesh) {
  static const auto vertices = all_face_vertices<Element>();
  std::vector<CellFace> faces;
  faces.reserve(mesh.cells.size() * Element::n_faces);
  std::vector<long> begin(mesh.points.size() + 1, 0);
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (int f = 0; f < Element::n_faces; ++f) {
      CellFace face{{-1, -1, -1, -1}, c, f};
      for (size_t i = 0; i < vertices[f].size(); ++i) face.key[i] = mesh.node(mesh.cells[c][vertices[f][i]]);
      sort_key(face.key, static_cast<int>(vertices[f].size()));
      ++begin[face.key[0] + 1];
      faces.push_back(face);
    }
  // Counting sort by the lowest node, then each short bucket by the rest.
  for (size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<CellFace> sorted(faces.size());
  auto next = begin;
  for (const CellFace& face : faces) sorted[next[face.key[0]]++] = face;
  for (size_t i = 0; i + 1 < begin.size(); ++i)
    std::sort(sorted.begin() + begin[i], sorted.begin() + begin[i + 1],
              [](const CellFace& a, const CellFace& b) {
                return std::pair(a.key, a.cell) < std::pair(b.key, b.cell);
              });
  return sorted;
}

/// Calls visit(first, count) for each distinct face, with its one or two sides.
/// Throws Error(file) when more than two cells share a face.
template <class Visit>
void for_each_face(const std::vector<CellFace>& sorted, Visit&& visit) {
  for (size_t i = 0; i < sorted.size();) {
    size_t j = i + 1;
    while (j < sorted.size() && sorted[j].key == sorted[i].key) ++j;
    if (j - i > 2)
      throw Error(ExitCode::file, "mesh: the face of cells " + std::to_string(sorted[i].cell) + ", " +
                                      std::to_string(sorted[i + 1].cell) + " and " +
                                      std::to_string(sorted[i + 2].cell) +
                                      " is shared by more than two cells; expected at most two");
    visit(&sorted[i], static_cast<int>(j - i));
    i = j;
  }
}

/// The faces that belong to one cell only.
template <class Element>
std::vector<CellFace> exterior_faces(const GlobalMesh<Element>& mesh) {
  std::vector<CellFace> exterior;
  for_each_face(sorted_faces(mesh), [&](const CellFace* face, int sides) {
    if (sides == 1) exterior.push_back(*face);
  });
  std::sort(exterior.begin(), exterior.end(), [](const CellFace& a, const CellFace& b) {
    return std::pair(a.cell, a.local_face) < std::pair(b.cell, b.local_face);
  });
  return exterior;
}

/// Cells that share a face, as a graph: neighbours of cell c are adjacency[begin[c]] .. adjacency[begin[c +
/// 1]].
struct CellGraph {
  std::vector<int> begin;
  std::vector<int> adjacency;
};

template <class Element>
CellGraph dual_graph(const GlobalMesh<Element>& mesh) {
  std::vector<std::array<int, 2>> pairs;
  for_each_face(sorted_faces(mesh), [&](const CellFace* face, int sides) {
    if (sides == 2 && face[0].cell != face[1].cell) pairs.push_back({face[0].cell, face[1].cell});
  });
  CellGraph graph;
  graph.begin.assign(mesh.cells.size() + 1, 0);
  for (auto [a, b] : pairs) ++graph.begin[a + 1], ++graph.begin[b + 1];
  for (size_t i = 1; i < graph.begin.size(); ++i) graph.begin[i] += graph.begin[i - 1];
  graph.adjacency.resize(2 * pairs.size());
  auto next = graph.begin;
  for (auto [a, b] : pairs) graph.adjacency[next[a]++] = b, graph.adjacency[next[b]++] = a;
  return graph;
}

/// Names the exterior faces: name(face centre) gives an index into mesh.boundary_names.
template <class Element, class Name>
void mark_boundaries(GlobalMesh<Element>& mesh, Name&& name) {
  static const auto vertices = all_face_vertices<Element>();
  mesh.boundary_faces.clear();
  for (const CellFace& face : exterior_faces(mesh)) {
    auto center = Vec<double, Element::dim>::zero();
    for (int a : vertices[face.local_face]) center += mesh.points[mesh.cells[face.cell][a]];
    center = (1.0 / vertices[face.local_face].size()) * center;
    mesh.boundary_faces.push_back({face.cell, face.local_face, name(center)});
  }
}

// Compiled once for each element, in src/instantiate.
#define IFSI_TOPOLOGY(Element, external)                                            \
  external template std::vector<CellFace> sorted_faces(const GlobalMesh<Element>&); \
  external template std::vector<CellFace> exterior_faces(const GlobalMesh<Element>&);
IFSI_FOR_EACH_CELL(IFSI_TOPOLOGY, extern)

}  // namespace ifsi
