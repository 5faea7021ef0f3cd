#pragma once
/// \file
/// The whole mesh, before it is distributed: what generators and readers make.

#include <array>
#include <string>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/element/element.hpp"

namespace ifsi {

/// A face of a cell that lies on the boundary with number `boundary`.
struct BoundaryFace {
  int cell;
  int local_face;
  int boundary;
  bool operator==(const BoundaryFace&) const = default;
};

/// A mesh of one element type, replicated on every rank.
template <class Element>
struct GlobalMesh {
  static constexpr int dim = Element::dim;
  using Face = BoundaryFace;

  std::vector<Vec<double, dim>> points;
  std::vector<std::array<int, Element::n_nodes>> cells;  ///< point indices, in the element's node order
  /// Empty, or (periodic meshes) for each point the topological node it belongs to: points with the same
  /// number are one node. Numbers lie in [0, points.size()) and may have gaps.
  std::vector<int> point_node;
  std::vector<Face> boundary_faces;
  std::vector<std::string> boundary_names;  ///< Face::boundary indexes this
  std::vector<int> cell_region;             ///< empty, or an index into region_names per cell
  std::vector<std::string> region_names;

  [[nodiscard]] int n_points() const { return static_cast<int>(points.size()); }
  [[nodiscard]] int n_cells() const { return static_cast<int>(cells.size()); }
  /// Topological node of a point.
  [[nodiscard]] int node(int point) const { return point_node.empty() ? point : point_node[point]; }
  /// Coordinates of the nodes of a cell.
  [[nodiscard]] std::array<Vec<double, dim>, Element::n_nodes> cell_coordinates(int cell) const {
    std::array<Vec<double, dim>, Element::n_nodes> X;
    for (int a = 0; a < Element::n_nodes; ++a) X[a] = points[cells[cell][a]];
    return X;
  }
};

}  // namespace ifsi
