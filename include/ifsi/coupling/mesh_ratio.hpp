#pragma once
/// \file
/// How fine the solid is against the fluid mesh where it is now: too coarse a solid leaks.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "ifsi/coupling/cell_distance.hpp"
#include "ifsi/coupling/interpolation.hpp"
#include "ifsi/element/geometry.hpp"

namespace ifsi {

/// The largest h_s/h of a solid: up to 2/3 it is tight, 1 is tolerable, beyond it the fluid passes between
/// the nodes (measured on a closed valve with bilinear cells: 4/3 leaks, 2 has holes).
template <int dim>
struct MeshRatio {
  double ratio = 0.0;  ///< h_s/h
  int cell = -1;       ///< solid cell where it is; -1: no node is in the mesh
  Vec<double, dim> position = Vec<double, dim>::zero();  ///< middle of the edge it is from
};

namespace detail {
/// Calls visit(a, b) for neighbouring nodes on the edges of the reference cell; `nodes` renames them.
template <class Element, class Visit>
void for_each_spacing(std::span<const int> nodes, Visit&& visit) {
  if constexpr (Element::dim == 1) {
    if constexpr (Element::order == 1) {
      visit(nodes[0], nodes[1]);
    } else {
      visit(nodes[0], nodes[2]);
      visit(nodes[2], nodes[1]);
    }
  } else {
    for_each_cell_face<Element>([&]<class Face>(std::span<const int> face) {
      std::array<int, Face::n_nodes> face_nodes;
      for (int k = 0; k < Face::n_nodes; ++k) face_nodes[k] = nodes[face[k]];
      for_each_spacing<Face>(face_nodes, visit);
    });
  }
}
}  // namespace detail

/// Length of e in node spacings of the fluid cell that holds a solid node: sqrt(e.G e) is 2 along the edge of
/// a regular cell, in any direction of it. \param row of that node, found.
template <class Element>
double length_in_cells(const CouplingRow<Element>& row, const Vec<double, Element::dim>& e) {
  // J^-1 e: how xi = sum_B xi_B N_B changes along e.
  auto d_xi = Vec<double, Element::dim>::zero();
  for (int b = 0; b < Element::n_nodes; ++b) d_xi += dot(row.grad_N[b], e) * Element::nodes[b];
  return 0.5 * Element::order * std::sqrt(dot(d_xi, Element::metric * d_xi));
}

/// Longest edges of a solid quad or hex along each direction of its reference cell, in spacings of the
/// fluid's nodes there. \param nodes of the cell, as numbered by C.
template <class SolidElement, class FluidElement>
std::array<double, SolidElement::dim> cell_lengths(const Interpolation<FluidElement>& C,
                                                   const std::array<int, SolidElement::n_nodes>& nodes) {
  std::array<double, SolidElement::dim> longest{};
  const auto& x = C.positions();
  for (int a = 0; a < SolidElement::n_vertices; ++a)
    for (int b = 0; b < a; ++b) {
      const auto along = SolidElement::nodes[a] - SolidElement::nodes[b];
      if (dot(along, along) != 4.0) continue;  // no edge
      for (int d = 0; d < SolidElement::dim; ++d)
        for (int end : {nodes[a], nodes[b]})
          if (along[d] != 0.0 && C.row(end).found())
            longest[d] = std::max(longest[d], length_in_cells(C.row(end), x[nodes[a]] - x[nodes[b]]));
    }
  return longest;
}

/// The largest distance between neighbouring solid nodes over the spacing of the fluid's nodes there, in the
/// configuration C was made for. \param cells of one kind, their nodes as numbered by C minus first_node.
template <class SolidElement, class FluidElement>
MeshRatio<FluidElement::dim> mesh_ratio(const Interpolation<FluidElement>& C,
                                        const std::vector<std::array<int, SolidElement::n_nodes>>& cells,
                                        int first_node = 0) {
  MeshRatio<FluidElement::dim> worst;
  const auto& x = C.positions();
  for (int c = 0; c < static_cast<int>(cells.size()); ++c)
    detail::for_each_spacing<SolidElement>(cells[c], [&](int a, int b) {
      a += first_node, b += first_node;
      for (int end : {a, b}) {
        if (!C.row(end).found()) continue;
        const double ratio = length_in_cells(C.row(end), x[b] - x[a]);
        if (ratio > worst.ratio) worst = {ratio, c, 0.5 * (x[a] + x[b])};
      }
    });
  return worst;
}

}  // namespace ifsi
