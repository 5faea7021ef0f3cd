#pragma once
/// \file
/// Boxes: products of axes, with any cell type, graded and periodic if wanted.

#include <array>
#include <string>
#include <utility>

#include "ifsi/element/instantiate.hpp"
#include "ifsi/mesh/axis.hpp"
#include "ifsi/mesh/extrude.hpp"
#include "ifsi/mesh/split.hpp"

namespace ifsi {

/// How the quads of a box are cut into triangles.
enum class Diagonals { alternating, uniform };

template <int dim>
struct BoxOptions {
  std::array<bool, dim> periodic{};  ///< directions in which opposite sides are the same nodes
  Diagonals diagonals = Diagonals::alternating;
};

namespace detail {

/// The points of a tensor-product grid of order k cells, x fastest.
template <int dim>
struct Lattice {
  std::array<int, dim> cells;
  int order;

  [[nodiscard]] int points(int d) const { return cells[d] * order + 1; }
  [[nodiscard]] int index(const std::array<int, dim>& i) const {
    int n = 0;
    for (int d = dim - 1; d >= 0; --d) n = n * points(d) + i[d];
    return n;
  }
  /// Calls visit with every multi-index below the counts, the first index fastest.
  template <class Visit>
  static void for_each(const std::array<int, dim>& counts, Visit&& visit) {
    std::array<int, dim> i{};
    while (i[dim - 1] < counts[dim - 1]) {
      visit(i);
      for (int d = 0; d < dim; ++d) {
        if (++i[d] < counts[d] || d == dim - 1) break;
        i[d] = 0;
      }
    }
  }
};

template <int dim>
void check_box(const std::array<Axis, dim>& axes, const std::array<bool, dim>& periodic) {
  double points = 1;
  for (int d = 0; d < dim; ++d) {
    const std::string axis = "box: axis " + std::to_string(d);
    check_increasing(axes[d], axis);
    points *= 2.0 * axes[d].size() - 1;
    if (periodic[d] && axes[d].size() < 4)
      throw Error(ExitCode::configuration, axis + " is periodic with " + std::to_string(axes[d].size() - 1) +
                                               " cells; expected at least three");
  }
  if (points > 1e9) throw Error(ExitCode::configuration, "box: expected fewer than 1e9 points");
}

/// Builds a box of tensor-product cells.
template <class Element>
class TensorBox {
  static constexpr int dim = Element::dim, k = Element::order;
  using Index = std::array<int, dim>;

 public:
  TensorBox(const std::array<Axis, dim>& axes, const std::array<bool, dim>& periodic)
      : axes_(axes), periodic_(periodic), lattice_{{}, k} {
    for (int d = 0; d < dim; ++d) lattice_.cells[d] = static_cast<int>(axes[d].size()) - 1;
  }

  GlobalMesh<Element> build() {
    add_points();
    add_boundaries();
    Lattice<dim>::for_each(lattice_.cells, [&](const Index& i) {
      add_faces(i);
      add_cell(i);
    });
    return std::move(mesh_);
  }

 private:
  void add_points() {
    Index counts;
    for (int d = 0; d < dim; ++d) counts[d] = lattice_.points(d);
    const bool any_periodic = periodic_ != std::array<bool, dim>{};
    Lattice<dim>::for_each(counts, [&](Index i) {
      auto& x = mesh_.points.emplace_back();
      for (int d = 0; d < dim; ++d) {
        const Axis& axis = axes_[d];
        x[d] = i[d] % k == 0 ? axis[i[d] / k] : 0.5 * (axis[i[d] / k] + axis[i[d] / k + 1]);
        if (periodic_[d]) i[d] %= lattice_.points(d) - 1;
      }
      if (any_periodic) mesh_.point_node.push_back(lattice_.index(i));
    });
  }

  void add_boundaries() {
    constexpr std::array names{"left", "right", "bottom", "top", "front", "back"};
    for (int d = 0; d < dim; ++d)
      for (int s = 0; s < 2; ++s) {
        side_[d][s] = {0, face_on_side<Element>(d, s == 1), static_cast<int>(mesh_.boundary_names.size())};
        if (!periodic_[d]) mesh_.boundary_names.push_back(names[2 * d + s]);
      }
  }

  /// The faces of the next cell, at i, that lie on the boundary.
  void add_faces(const Index& i) {
    for (int d = 0; d < dim; ++d)
      for (int s = 0; s < 2 && !periodic_[d]; ++s)
        if (i[d] == (s == 0 ? 0 : lattice_.cells[d] - 1))
          mesh_.boundary_faces.push_back({mesh_.n_cells(), side_[d][s].local_face, side_[d][s].boundary});
  }

  void add_cell(const Index& i) {
    auto& cell = mesh_.cells.emplace_back();
    for (int a = 0; a < Element::n_nodes; ++a) {
      Index j;
      for (int d = 0; d < dim; ++d)
        j[d] = k * i[d] + static_cast<int>((Element::nodes[a][d] + 1) / 2 * k + 0.5);
      cell[a] = lattice_.index(j);
    }
  }

  const std::array<Axis, dim>& axes_;
  const std::array<bool, dim>& periodic_;
  Lattice<dim> lattice_;
  std::array<std::array<BoundaryFace, 2>, dim> side_;
  GlobalMesh<Element> mesh_;
};

}  // namespace detail

/// A box with the given axes. Boundaries: left, right (x); bottom, top (y); front, back (z); none in a
/// periodic direction. Cells that are not tensor products come from splitting: two triangles per quad, six
/// tetrahedra per hex, wedges over triangles. Mid nodes lie half-way, so that all cells are affine. Throws
/// Error(configuration) for axes that do not increase, or fewer than three cells in a periodic direction.
template <class Element>
GlobalMesh<Element> box(const std::array<Axis, Element::dim>& axes,
                        const BoxOptions<Element::dim>& options = {}) {
  detail::check_box<Element::dim>(axes, options.periodic);
  if constexpr (is_tensor_cell<Element>) {
    return detail::TensorBox<Element>(axes, options.periodic).build();
  } else if constexpr (Element::shape == Shape::wedge) {
    const auto plane =
        box<Tri1>({axes[0], axes[1]}, {{options.periodic[0], options.periodic[1]}, options.diagonals});
    return extrude<Element>(plane, axes[2], {"front", "back", options.periodic[2]});
  } else {
    const int n_x = static_cast<int>(axes[0].size()) - 1;
    return split<Element>(detail::TensorBox<BaseCell<Element>>(axes, options.periodic).build(), [&](int c) {
      return options.diagonals == Diagonals::alternating && (c % n_x + c / n_x) % 2 == 1;
    });
  }
}

/// A box with equal cells.
template <class Element>
GlobalMesh<Element> box(const Vec<double, Element::dim>& lower, const Vec<double, Element::dim>& upper,
                        const std::array<int, Element::dim>& cells,
                        const BoxOptions<Element::dim>& options = {}) {
  std::array<Axis, Element::dim> axes;
  for (int d = 0; d < Element::dim; ++d) axes[d] = uniform_axis(lower[d], upper[d], cells[d]);
  return box<Element>(axes, options);
}

// Compiled once for each element, in src/instantiate.
#define IFSI_BOX(Element, external)                                                         \
  external template GlobalMesh<Element> box<Element>(const std::array<Axis, Element::dim>&, \
                                                     const BoxOptions<Element::dim>&);      \
  external template GlobalMesh<Element> box<Element>(                                       \
      const Vec<double, Element::dim>&, const Vec<double, Element::dim>&,                   \
      const std::array<int, Element::dim>&, const BoxOptions<Element::dim>&);
IFSI_FOR_EACH_CELL(IFSI_BOX, extern)

}  // namespace ifsi
