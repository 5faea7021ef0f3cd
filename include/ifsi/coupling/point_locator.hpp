#pragma once
/// \file
/// Which cell of the mesh holds a position, and where in it.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "ifsi/coupling/bounding_box.hpp"
#include "ifsi/coupling/cell_distance.hpp"
#include "ifsi/coupling/point_tree.hpp"
#include "ifsi/element/instantiate.hpp"
#include "ifsi/element/inverse_map.hpp"
#include "ifsi/mesh/mesh.hpp"

namespace ifsi {

/// Locates positions in this rank's cells. The mesh must outlive the locator and keep its points.
///
/// Watertight: a cell holds every position within `tolerance` (in its reference coordinates) of it, so that
/// none is lost on a face, an edge or a vertex; of several cells that hold a position the one with the lowest
/// input number is taken. The answer depends on the position alone: not on where the search began, nor on the
/// partition.
template <class Element>
class PointLocator {
 public:
  static constexpr int dim = Element::dim;
  using Point = Vec<double, dim>;

  /// How far outside its cell, in reference coordinates, a position may lie.
  static constexpr double tolerance = 1e-9;
  /// Deeper inside a cell than this a position is in no other cell, unless neighbours differ 1e4 times in
  /// size.
  static constexpr double interior_depth = 1e-5;

  struct Location {
    int cell = -1;             ///< local cell, -1 when the position lies in none
    Point xi = Point::zero();  ///< where in the cell
    [[nodiscard]] bool found() const { return cell >= 0; }
    /// Whether no other cell can hold the position.
    [[nodiscard]] bool is_interior() const { return found() && Element::outside(xi) < -interior_depth; }
  };

  explicit PointLocator(const Mesh<Element>& mesh) : mesh_(mesh) {
    // The boxes are wider than the tolerance by enough for the round-off of far-away coordinates too.
    constexpr double box_margin = 1e-6;
    for (int c = 0; c < mesh.n_cells(); ++c) {
      boxes_.push_back(cell_box<Element>(mesh.cell_coordinates(c), box_margin));
      straight_.push_back(is_straight(c));
    }
    for (int c = 0; c < mesh.n_owned_cells; ++c) owned_box_.extend(boxes_[c]);
    collect_cells_of_points();
    plant_trees();
  }

  /// Searches the owned cells. \param near a local cell to look into first, with its neighbours; -1: none.
  [[nodiscard]] Location find(const Point& x, int near = -1) const {
    if (!owned_box_.contains(x)) return {};
    if (near >= 0) {
      Location location = search_around(near, x, mesh_.n_owned_cells);
      // All cells that hold x share a vertex with the one found: the rest of them is among its neighbours.
      if (location.found() && location.cell != near && !location.is_interior())
        location = search_around(location.cell, x, mesh_.n_owned_cells);
      if (location.found()) return location;
    }
    return search_trees(x);
  }

  /// Looks for x in the interior of a local cell or of one of its neighbours, ghost cells included: the quick
  /// check of a position that has moved little, to be followed by find() on all ranks when it fails.
  [[nodiscard]] Location track(const Point& x, int cell) const {
    Location location;
    look_into(cell, x, location);
    if (!location.found()) search_neighbours(cell, x, mesh_.n_cells(), location);
    return location.is_interior() ? location : Location{};
  }

  /// Distance from a position that find() does not find to the nearest owned cell; infinite without cells.
  [[nodiscard]] double distance(const Point& x) const {
    double nearest = std::numeric_limits<double>::infinity();
    // A cell reaches no further from its centre than its radius, and the nearest one is no further than the
    // cell with the nearest centre.
    for (const SizeClass& size : size_classes_) {
      const int first = size.cells[size.tree.nearest(x)];
      nearest = std::min(nearest, distance_to_faces<Element>(mesh_.cell_coordinates(first), x));
      for (int i : size.tree.within(x, nearest + size.radius))
        if (box_distance(boxes_[size.cells[i]], x) < nearest)
          nearest = std::min(nearest, distance_to_faces<Element>(mesh_.cell_coordinates(size.cells[i]), x));
    }
    return nearest;
  }

  [[nodiscard]] const Mesh<Element>& mesh() const { return mesh_; }

 private:
  /// Cells of about one size, so that a search radius which misses none of them does not catch many.
  struct SizeClass {
    double radius;           ///< the largest radius of a box
    std::vector<int> cells;  ///< cell of each point of the tree
    PointTree<dim> tree;     ///< centres of the boxes
  };

  void collect_cells_of_points() {
    first_cell_.assign(mesh_.points.size() + 1, 0);
    for (const auto& points : mesh_.cell_points)
      for (int a = 0; a < Element::n_vertices; ++a) ++first_cell_[points[a] + 1];
    for (size_t p = 1; p < first_cell_.size(); ++p) first_cell_[p] += first_cell_[p - 1];
    cells_of_point_.resize(first_cell_.back());
    std::vector<int> next = first_cell_;
    for (size_t c = 0; c < mesh_.cell_points.size(); ++c)
      for (int a = 0; a < Element::n_vertices; ++a)
        cells_of_point_[next[mesh_.cell_points[c][a]]++] = static_cast<int>(c);
  }

  void plant_trees() {
    std::map<int, std::vector<int>> cells_by_octave;
    for (int c = 0; c < mesh_.n_owned_cells; ++c)
      cells_by_octave[std::ilogb(boxes_[c].radius())].push_back(c);
    for (auto& [octave, cells] : cells_by_octave) {
      std::vector<Point> centers;
      double radius = 0;
      for (int c : cells) {
        centers.push_back(boxes_[c].center());
        radius = std::max(radius, boxes_[c].radius());
      }
      size_classes_.push_back({radius, std::move(cells), PointTree<dim>(std::move(centers))});
    }
  }

  /// Whether the vertices alone describe the cell, to the last bits of its coordinates.
  [[nodiscard]] bool is_straight(int cell) const {
    const auto offset = offset_from_vertex_cell<Element>(mesh_.cell_coordinates(cell));
    for (int i = 0; i < dim; ++i) {
      const double largest = std::max(std::abs(boxes_[cell].lower[i]), std::abs(boxes_[cell].upper[i]));
      if (offset[i] > 4 * std::numeric_limits<double>::epsilon() * largest) return false;
    }
    return true;
  }

  /// Inverse map of a cell; of a straight one that of its vertices, which costs a fraction for order two.
  [[nodiscard]] InverseMap<dim> inverse(int cell, const Point& x) const {
    const auto X = mesh_.cell_coordinates(cell);
    if (Element::order == 1 || !straight_[cell]) return inverse_map<Element>(X, x);
    std::array<Point, Element::n_vertices> vertices;
    std::copy_n(X.begin(), Element::n_vertices, vertices.begin());
    return inverse_map<VertexElement<Element>>(vertices, x);
  }

  /// Takes the cell if it holds x and has a lower input number than the one found before.
  void look_into(int cell, const Point& x, Location& found) const {
    if (!boxes_[cell].contains(x)) return;
    if (found.found() && mesh_.input_cell[found.cell] < mesh_.input_cell[cell]) return;
    const InverseMap<dim> at = inverse(cell, x);
    if (at.converged && Element::contains(at.xi, tolerance)) found = {cell, at.xi};
  }

  /// Looks into a cell and its neighbours, as far as their local numbers are below n_cells.
  [[nodiscard]] Location search_around(int cell, const Point& x, int n_cells) const {
    Location found;
    if (cell < n_cells) look_into(cell, x, found);
    if (!found.is_interior()) search_neighbours(cell, x, n_cells, found);
    return found;
  }

  /// Looks into the cells that share a vertex with `cell`, until x is in the interior of one.
  void search_neighbours(int cell, const Point& x, int n_cells, Location& found) const {
    for (int a = 0; a < Element::n_vertices; ++a) {
      const int p = mesh_.cell_points[cell][a];
      for (int k = first_cell_[p]; k < first_cell_[p + 1]; ++k) {
        const int neighbour = cells_of_point_[k];
        if (neighbour == cell || neighbour == found.cell || neighbour >= n_cells) continue;
        look_into(neighbour, x, found);
        if (found.is_interior()) return;
      }
    }
  }

  [[nodiscard]] Location search_trees(const Point& x) const {
    Location found;
    for (const SizeClass& size : size_classes_)
      for (int i : size.tree.within(x, size.radius)) {
        look_into(size.cells[i], x, found);
        if (found.is_interior()) return found;
      }
    return found;
  }

  static double box_distance(const Box<dim>& box, const Point& x) {
    Point gap;
    for (int i = 0; i < dim; ++i) gap[i] = std::max({box.lower[i] - x[i], x[i] - box.upper[i], 0.0});
    return std::sqrt(dot(gap, gap));
  }

  const Mesh<Element>& mesh_;
  std::vector<Box<dim>> boxes_;  ///< of all local cells
  std::vector<char> straight_;   ///< whether a local cell is
  Box<dim> owned_box_;           ///< around the owned cells
  std::vector<int> first_cell_, cells_of_point_;
  std::vector<SizeClass> size_classes_;
};

// Compiled once for each element, in src/instantiate.
#define IFSI_POINT_LOCATOR(Element, external) external template class PointLocator<Element>;
IFSI_FOR_EACH_PLANE_CELL(IFSI_POINT_LOCATOR, extern)
IFSI_FOR_EACH_SPACE_CELL(IFSI_POINT_LOCATOR, extern)

}  // namespace ifsi
