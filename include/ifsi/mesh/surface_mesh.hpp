#pragma once
/// \file
/// A surface in space, as the mesh of a membrane.

#include <array>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/element/element.hpp"

namespace ifsi {

/// Cells of one element of two dimensions whose points lie in space, replicated on every rank.
template <class Element>
struct SurfaceMesh {
  /// A node and its neighbours, before and behind it along either family of lines.
  using Cross = std::array<int, 5>;

  std::vector<Vec<double, 3>> points;
  std::vector<std::array<int, Element::n_nodes>> cells;  ///< point indices, in the element's node order
  std::vector<Cross> crosses;                            ///< where lines of nodes cross: what resists bending
  /// Crosses on a plane of symmetry through the origin: the node before along the first line is the image of
  /// the one behind, and named like it.
  std::vector<Cross> mirrored;
  Vec<double, 3> mirror_normal = Vec<double, 3>::zero();  ///< of that plane, of length one

  [[nodiscard]] int n_points() const { return static_cast<int>(points.size()); }
  [[nodiscard]] int n_cells() const { return static_cast<int>(cells.size()); }
};

}  // namespace ifsi
