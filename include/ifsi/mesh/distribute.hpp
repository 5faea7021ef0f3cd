#pragma once
/// \file
/// From the whole mesh, known to every rank, to the part of each rank.

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "ifsi/core/communicator.hpp"
#include "ifsi/element/instantiate.hpp"
#include "ifsi/mesh/check.hpp"
#include "ifsi/mesh/global_mesh.hpp"
#include "ifsi/mesh/hilbert.hpp"
#include "ifsi/mesh/mesh.hpp"
#include "ifsi/mesh/partition.hpp"
#include "ifsi/mesh/topology.hpp"

namespace ifsi {

namespace detail {

/// Position of each cell's centre along a Hilbert curve through the cube around the mesh.
template <class Element>
std::vector<std::uint64_t> hilbert_keys(const GlobalMesh<Element>& mesh) {
  constexpr int dim = Element::dim, bits = 20;
  auto lower = mesh.points[0], upper = mesh.points[0];
  for (const auto& x : mesh.points)
    for (int d = 0; d < dim; ++d) lower[d] = std::min(lower[d], x[d]), upper[d] = std::max(upper[d], x[d]);
  double extent = 0;
  for (int d = 0; d < dim; ++d) extent = std::max(extent, upper[d] - lower[d]);
  const double scale = extent > 0 ? ((1 << bits) - 1) / extent : 0;
  std::vector<std::uint64_t> keys;
  keys.reserve(mesh.cells.size());
  for (const auto& cell : mesh.cells) {
    auto center = Vec<double, dim>::zero();
    for (int a = 0; a < Element::n_vertices; ++a) center += mesh.points[cell[a]];
    Vec<std::uint32_t, dim> grid;
    for (int d = 0; d < dim; ++d)
      grid[d] = static_cast<std::uint32_t>((center[d] / Element::n_vertices - lower[d]) * scale);
    keys.push_back(hilbert_index<dim>(grid, bits));
  }
  return keys;
}

/// The part of each cell; computed on rank 0, the same everywhere.
template <class Element>
std::vector<int> partition_cells(const GlobalMesh<Element>& mesh, const Communicator& comm) {
  if (comm.size() == 1) return std::vector<int>(mesh.cells.size(), 0);
  const CellGraph graph = dual_graph(mesh);
  std::vector<int> part = partition_graph(graph.begin, graph.adjacency, comm.size());
  MPI_Bcast(part.data(), static_cast<int>(part.size()), MPI_INT, 0, comm.handle());
  return part;
}

/// Numbers of nodes and cells that all ranks agree on.
struct Numbering {
  std::vector<int> part;        ///< rank of each cell
  std::vector<int> order;       ///< cells by rank, then along the Hilbert curve
  std::vector<int> first_cell;  ///< per rank, where its cells begin in order
  std::vector<int> owner;       ///< per topological node the lowest rank among its cells, or -1 if unused
  std::vector<int> global;      ///< per topological node its global number: by rank, then first touch
  std::vector<int> first_node;  ///< per rank its first global number
};

template <class Element>
std::vector<int> node_owners(const GlobalMesh<Element>& mesh, const std::vector<int>& part) {
  std::vector<int> owner(mesh.points.size(), -1);
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (int p : mesh.cells[c]) {
      int& rank = owner[mesh.node(p)];
      rank = rank < 0 ? part[c] : std::min(rank, part[c]);
    }
  return owner;
}

/// Cells by rank, then along the Hilbert curve.
template <class Element>
std::vector<int> cell_order(const GlobalMesh<Element>& mesh, const std::vector<int>& part) {
  const auto keys = hilbert_keys(mesh);
  std::vector<std::tuple<int, std::uint64_t, int>> sorted;
  sorted.reserve(mesh.cells.size());
  for (int c = 0; c < mesh.n_cells(); ++c) sorted.emplace_back(part[c], keys[c], c);
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> order;
  order.reserve(mesh.cells.size());
  for (const auto& [rank, key, cell] : sorted) order.push_back(cell);
  return order;
}

template <class Element>
Numbering number(const GlobalMesh<Element>& mesh, const Communicator& comm) {
  Numbering s;
  s.part = partition_cells(mesh, comm);
  s.owner = node_owners(mesh, s.part);
  s.order = cell_order(mesh, s.part);
  s.first_cell.assign(comm.size() + 1, 0);
  for (int rank : s.part) ++s.first_cell[rank + 1];
  std::partial_sum(s.first_cell.begin(), s.first_cell.end(), s.first_cell.begin());
  s.global.assign(mesh.points.size(), -1);
  int next = 0;
  for (int rank = 0; rank < comm.size(); ++rank) {
    s.first_node.push_back(next);
    for (int i = s.first_cell[rank]; i < s.first_cell[rank + 1]; ++i)
      for (int p : mesh.cells[s.order[i]]) {
        const int node = mesh.node(p);
        if (s.owner[node] == rank && s.global[node] < 0) s.global[node] = next++;
      }
  }
  s.first_node.push_back(next);
  return s;
}

/// The cells of a rank: its own, then those of others that touch one of its nodes.
template <class Element>
std::vector<int> local_cells(const GlobalMesh<Element>& mesh, const Numbering& s, int rank) {
  std::vector<int> cells(s.order.begin() + s.first_cell[rank], s.order.begin() + s.first_cell[rank + 1]);
  for (int c : s.order) {
    const auto mine = [&](int p) { return s.owner[mesh.node(p)] == rank; };
    if (s.part[c] != rank && std::any_of(mesh.cells[c].begin(), mesh.cells[c].end(), mine))
      cells.push_back(c);
  }
  return cells;
}

/// Local number of each topological node, or -1; and the global numbers of the ghosts, sorted.
template <class Element>
std::pair<std::vector<int>, std::vector<long>> local_nodes(const GlobalMesh<Element>& mesh,
                                                           const Numbering& s, const std::vector<int>& cells,
                                                           int rank) {
  const int first = s.first_node[rank], n_owned = s.first_node[rank + 1] - first;
  std::vector<std::pair<int, int>> ghosts;  // global number, topological node
  std::vector<int> local(mesh.points.size(), -1);
  for (int c : cells)
    for (int p : mesh.cells[c]) {
      const int node = mesh.node(p);
      if (s.owner[node] == rank)
        local[node] = s.global[node] - first;
      else
        ghosts.emplace_back(s.global[node], node);
    }
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  std::vector<long> ghost_global;
  for (auto [global, node] : ghosts) {
    local[node] = n_owned + static_cast<int>(ghost_global.size());
    ghost_global.push_back(global);
  }
  return {std::move(local), std::move(ghost_global)};
}

/// Points of the local cells, ordered by local node, then as in the input. Returns the local number of each
/// point.
template <class Element>
std::vector<int> fill_points(const GlobalMesh<Element>& mesh, const std::vector<int>& local,
                             Mesh<Element>& out) {
  std::vector<int> local_point(mesh.points.size(), -1), begin(out.n_nodes() + 1, 0);
  for (int c : out.input_cell)
    for (int p : mesh.cells[c]) {
      if (local_point[p] >= 0) continue;
      local_point[p] = 0;
      ++begin[local[mesh.node(p)] + 1];
    }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  out.points.resize(begin.back());
  out.point_node.resize(begin.back());
  out.input_point.resize(begin.back());
  for (int p = 0; p < mesh.n_points(); ++p) {
    if (local_point[p] < 0) continue;
    const int node = local[mesh.node(p)], i = begin[node]++;
    local_point[p] = i;
    out.points[i] = mesh.points[p];
    out.point_node[i] = node;
    out.input_point[i] = p;
  }
  return local_point;
}

/// Cells in local numbers.
template <class Element>
void fill_cells(const GlobalMesh<Element>& mesh, const std::vector<int>& local, Mesh<Element>& out) {
  const std::vector<int> local_point = fill_points(mesh, local, out);
  out.cells.reserve(out.input_cell.size());
  out.cell_points.reserve(out.input_cell.size());
  for (int c : out.input_cell) {
    auto& nodes = out.cells.emplace_back();
    auto& points = out.cell_points.emplace_back();
    for (int a = 0; a < Element::n_nodes; ++a) {
      nodes[a] = local[mesh.node(mesh.cells[c][a])];
      points[a] = local_point[mesh.cells[c][a]];
    }
    if (!mesh.cell_region.empty()) out.cell_region.push_back(mesh.cell_region[c]);
  }
}

/// Faces of local cells; boundary nodes also of faces whose cells live elsewhere.
template <class Element>
void fill_boundaries(const GlobalMesh<Element>& mesh, const std::vector<int>& local, Mesh<Element>& out) {
  std::vector<int> local_cell(mesh.cells.size(), -1);
  for (int c = 0; c < out.n_cells(); ++c) local_cell[out.input_cell[c]] = c;
  out.boundary_nodes.resize(mesh.boundary_names.size());
  for (const auto& face : mesh.boundary_faces) {
    if (local_cell[face.cell] >= 0)
      out.boundary_faces.push_back({local_cell[face.cell], face.local_face, face.boundary});
    for (int a : Element::face_nodes(face.local_face)) {
      const int node = local[mesh.node(mesh.cells[face.cell][a])];
      if (node >= 0) out.boundary_nodes[face.boundary].push_back(node);
    }
  }
  std::sort(out.boundary_faces.begin(), out.boundary_faces.end(),
            [](const BoundaryFace& a, const BoundaryFace& b) {
              return std::pair(a.cell, a.local_face) < std::pair(b.cell, b.local_face);
            });
  for (auto& nodes : out.boundary_nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

}  // namespace detail

/// Distributes a mesh that every rank holds in full: METIS k-way over cells that share faces; a node belongs
/// to the lowest rank among its cells; each rank's cells follow a Hilbert curve and its nodes the first touch
/// by them. Collective. Throws Error when check() does, or for more ranks than cells.
template <class Element>
Mesh<Element> distribute(const GlobalMesh<Element>& mesh, Communicator comm) {
  check(mesh);
  check_ranks(mesh.n_cells(), comm.size());
  const detail::Numbering numbering = detail::number(mesh, comm);
  const int rank = comm.rank();
  Mesh<Element> out;
  out.comm = comm;
  out.boundary_names = mesh.boundary_names;
  out.region_names = mesh.region_names;
  out.n_global_cells = mesh.n_cells();
  out.n_owned_cells = numbering.first_cell[rank + 1] - numbering.first_cell[rank];
  out.input_cell = detail::local_cells(mesh, numbering, rank);
  auto [local, ghosts] = detail::local_nodes(mesh, numbering, out.input_cell, rank);
  out.nodes = Layout(comm, numbering.first_node[rank + 1] - numbering.first_node[rank], std::move(ghosts));
  detail::fill_cells(mesh, local, out);
  detail::fill_boundaries(mesh, local, out);
  return out;
}

// Compiled once for each element, in src/instantiate.
#define IFSI_DISTRIBUTE(Element, external) \
  external template Mesh<Element> distribute(const GlobalMesh<Element>&, Communicator);
IFSI_FOR_EACH_CELL(IFSI_DISTRIBUTE, extern)

}  // namespace ifsi
