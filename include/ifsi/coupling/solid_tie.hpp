#pragma once
/// \file
/// Solids whose nodes are further apart than the fluid's: what ties the fluid to them in between (eq. 44).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ifsi/coupling/friction.hpp"
#include "ifsi/coupling/mesh_ratio.hpp"
#include "ifsi/element/geometry.hpp"
#include "ifsi/mesh/reference_lattice.hpp"

namespace ifsi {

/// Friction between a solid and the fluid at points within its cells, the middles of equal pieces of the
/// reference cell. A point's part of the friction is that of its piece's volume.
///
/// The points are nodes for which the scene finds the fluid's velocity, as it does for those of the solid;
/// they are numbered cell after cell. Cells whose nodes are close enough have none.
template <int dim>
class SolidTie {
 public:
  using Point = Vec<double, dim>;
  using Block = Mat<double, dim>;

  /// \param spacing pieces are no longer than this, in spacings of the fluid's nodes. \param resistance
  /// friction per volume and velocity.
  SolidTie(double spacing, double resistance) : spacing_(spacing), resistance_(resistance) {}

  /// The undeformed cells of a body, where C is now; nodes are numbered from first_node on.
  template <class SolidElement, class FluidElement>
  void add_body(const Interpolation<FluidElement>& C,
                const std::vector<std::array<int, SolidElement::n_nodes>>& cells, int first_node) {
    static_assert(is_tensor_cell<SolidElement>, "pieces of quads and hexes only");
    for (auto nodes : cells) {
      for (int& a : nodes) a += first_node;
      const auto length = cell_lengths<SolidElement>(C, nodes);
      const int home = first_found(C, nodes);
      if (*std::max_element(length.begin(), length.end()) > SolidElement::order * spacing_)
        add_cell<SolidElement>(C.positions(), nodes, home, length);
    }
  }

  [[nodiscard]] int n_points() const { return static_cast<int>(points_.size()); }
  [[nodiscard]] int n_cells() const { return static_cast<int>(cells_.size()); }
  /// A node of the point's cell that is in the fluid.
  [[nodiscard]] int home(int point) const { return cells_[points_[point].cell].home; }
  /// The nodes of a cell and its points, these numbered from first_point on.
  [[nodiscard]] std::vector<int> nodes(int cell, int first_point) const {
    std::vector<int> all = cells_[cell].nodes;
    for (int k = cells_[cell].first; k < cells_[cell].last; ++k) all.push_back(first_point + k);
    return all;
  }

  /// Where the points are when the nodes are at x. All of them count again.
  [[nodiscard]] std::vector<Point> find(std::span<const Point> x) {
    std::vector<Point> places;
    for (auto& point : points_) {
      point.counts = true;
      auto& place = places.emplace_back(Point::zero());
      const auto& nodes = cells_[point.cell].nodes;
      for (std::size_t a = 0; a < nodes.size(); ++a) place += point.N[a] * x[nodes[a]];
    }
    return places;
  }
  /// A point that is no place in the fluid: without friction until find().
  void leave_out(int point) { points_[point].counts = false; }

  /// Adds the forces of a cell on its nodes() with the velocities v, and their slopes. \return the power
  double add(int cell, std::span<const Point> v, std::span<Point> R, std::span<Block> K) const {
    double power = 0.0;
    std::vector<double> weight(v.size());
    for (int k = cells_[cell].first; k < cells_[cell].last; ++k) {
      const auto& point = points_[k];
      if (!point.counts) continue;
      std::fill(weight.begin(), weight.end(), 0.0);
      for (std::size_t a = 0; a < point.N.size(); ++a) weight[a] = -point.N[a];
      weight[point.N.size() + k - cells_[cell].first] = 1.0;
      power += Friction<dim>{point.volume * resistance_}.add(weight, v, R, K);
    }
    return power;
  }

 private:
  struct Cell {
    std::vector<int> nodes;
    int first, last;  ///< its points
    int home;
  };
  struct InCell {
    int cell;
    std::vector<double> N;  ///< shape functions of the cell's nodes
    double volume;          ///< of the undeformed piece
    bool counts = true;
  };

  template <class FluidElement, std::size_t n>
  static int first_found(const Interpolation<FluidElement>& C, const std::array<int, n>& nodes) {
    for (int a : nodes)
      if (C.row(a).found()) return a;
    return -1;
  }

  template <class Element>
  void add_cell(const std::vector<Point>& x, const std::array<int, Element::n_nodes>& nodes, int home,
                const std::array<double, dim>& length) {
    std::array<int, dim> pieces;
    std::array<Point, Element::n_nodes> X, dN;
    std::array<double, Element::n_nodes> N;
    int n_pieces = 1;
    for (int d = 0; d < dim; ++d) {
      pieces[d] = std::max(1, static_cast<int>(std::ceil(length[d] / spacing_)));
      n_pieces *= pieces[d];
    }
    for (int a = 0; a < Element::n_nodes; ++a) X[a] = x[nodes[a]];
    cells_.push_back({{nodes.begin(), nodes.end()}, n_points(), n_points() + n_pieces, home});
    for (int k = 0; k < n_pieces; ++k) {
      Point xi;
      double part = 1.0;
      for (int d = 0, rest = k; d < dim; rest /= pieces[d], ++d) {
        xi[d] = (2.0 * (rest % pieces[d]) + 1.0) / pieces[d] - 1.0;
        part *= 2.0 / pieces[d];
      }
      Element::shape_functions(xi, N);
      Element::gradients(xi, dN);
      points_.push_back({n_cells() - 1, {N.begin(), N.end()}, part * det(jacobian(dN, X))});
    }
  }

  double spacing_, resistance_;
  std::vector<Cell> cells_;
  std::vector<InCell> points_;
};

}  // namespace ifsi
