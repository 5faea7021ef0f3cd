#pragma once
/// \file
/// The part of a mesh that one rank holds.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ifsi/core/communicator.hpp"
#include "ifsi/core/tensor.hpp"
#include "ifsi/linalg/layout.hpp"
#include "ifsi/mesh/global_mesh.hpp"
#include "ifsi/mesh/names.hpp"

namespace ifsi {

/// One rank's cells and nodes. Owned cells come first, then ghost cells: every cell that touches an owned
/// node is present, so that the rows of owned nodes are assembled without communication.
template <class Element>
struct Mesh {
  static constexpr int dim = Element::dim;
  static constexpr int n = Element::n_nodes;
  using Face = BoundaryFace;

  Communicator comm;
  Layout nodes;                                 ///< owned nodes, then ghosts, sorted by global number
  std::vector<Vec<double, dim>> points;         ///< local points; the same as local nodes unless periodic
  std::vector<int> point_node;                  ///< local point -> local node
  std::vector<std::array<int, n>> cells;        ///< local nodes of local cells
  std::vector<std::array<int, n>> cell_points;  ///< local points of local cells
  int n_owned_cells = 0;
  std::vector<Face> boundary_faces;  ///< of all local cells
  std::vector<std::string> boundary_names;
  std::vector<std::vector<int>>
      boundary_nodes;            ///< per boundary its local nodes, sorted; complete, ghosts too
  std::vector<int> cell_region;  ///< per local cell, or empty
  std::vector<std::string> region_names;
  std::vector<int> input_point;  ///< local point -> index in the GlobalMesh
  std::vector<int> input_cell;   ///< local cell -> index in the GlobalMesh
  long n_global_cells = 0;

  [[nodiscard]] int n_cells() const { return static_cast<int>(cells.size()); }
  [[nodiscard]] int n_nodes() const { return nodes.n_local(); }
  [[nodiscard]] int n_owned_nodes() const { return nodes.n_owned(); }
  [[nodiscard]] int n_points() const { return static_cast<int>(points.size()); }

  /// Coordinates of the nodes of a cell.
  [[nodiscard]] std::array<Vec<double, dim>, n> cell_coordinates(int cell) const {
    std::array<Vec<double, dim>, n> X;
    for (int a = 0; a < n; ++a) X[a] = points[cell_points[cell][a]];
    return X;
  }

  /// Number of a boundary. Throws Error(configuration) with the names there are and the nearest one.
  [[nodiscard]] int boundary(const std::string& name) const {
    return find_name("boundary", name, boundary_names);
  }
  /// Number of a region; throws like boundary().
  [[nodiscard]] int region(const std::string& name) const { return find_name("region", name, region_names); }

  /// Local nodes on a boundary, sorted, ghosts included.
  [[nodiscard]] const std::vector<int>& nodes_on(int boundary) const { return boundary_nodes[boundary]; }
  [[nodiscard]] const std::vector<int>& nodes_on(const std::string& name) const {
    return nodes_on(boundary(name));
  }

  /// A point of each local node (any one of its points when periodic).
  [[nodiscard]] std::vector<Vec<double, dim>> node_coordinates() const {
    std::vector<Vec<double, dim>> x(n_nodes());
    for (int i = n_points() - 1; i >= 0; --i) x[point_node[i]] = points[i];
    return x;
  }

  /// Shortest distance between two vertices of a cell, over all ranks.
  [[nodiscard]] double h_min() const {
    double h = std::numeric_limits<double>::infinity();
    for (int c = 0; c < n_owned_cells; ++c) h = std::min(h, vertex_distances(c)[0]);
    return comm.min(h);
  }
  /// Longest distance between two vertices of a cell, over all ranks.
  [[nodiscard]] double h_max() const {
    double h = 0;
    for (int c = 0; c < n_owned_cells; ++c) h = std::max(h, vertex_distances(c)[1]);
    return comm.max(h);
  }

 private:
  [[nodiscard]] std::array<double, 2> vertex_distances(int cell) const {
    const auto X = cell_coordinates(cell);
    std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0};
    for (int a = 0; a < Element::n_vertices; ++a)
      for (int b = 0; b < a; ++b) {
        const double h = std::sqrt(dot(X[a] - X[b], X[a] - X[b]));
        range = {std::min(range[0], h), std::max(range[1], h)};
      }
    return range;
  }
};

}  // namespace ifsi
