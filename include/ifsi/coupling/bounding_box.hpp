#pragma once
/// \file
/// Axis-aligned boxes, and one around a cell that is sure to hold all of it, curved cells included.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ifsi/core/tensor.hpp"
#include "ifsi/element/elements.hpp"

namespace ifsi {

/// The box lower <= x <= upper; empty as constructed.
template <int dim>
struct Box {
  Vec<double, dim> lower, upper;

  Box() {
    for (int i = 0; i < dim; ++i) {
      lower[i] = std::numeric_limits<double>::infinity();
      upper[i] = -std::numeric_limits<double>::infinity();
    }
  }
  void extend(const Vec<double, dim>& x) {
    for (int i = 0; i < dim; ++i) {
      lower[i] = std::min(lower[i], x[i]);
      upper[i] = std::max(upper[i], x[i]);
    }
  }
  void extend(const Box& b) {
    for (int i = 0; i < dim; ++i) {
      lower[i] = std::min(lower[i], b.lower[i]);
      upper[i] = std::max(upper[i], b.upper[i]);
    }
  }
  void grow(const Vec<double, dim>& by) {
    lower -= by;
    upper += by;
  }
  [[nodiscard]] bool contains(const Vec<double, dim>& x) const {
    for (int i = 0; i < dim; ++i)
      if (!(lower[i] <= x[i] && x[i] <= upper[i])) return false;
    return true;
  }
  [[nodiscard]] Vec<double, dim> center() const { return 0.5 * (lower + upper); }
  /// Half the diagonal.
  [[nodiscard]] double radius() const {
    const Vec<double, dim> d = upper - lower;
    return 0.5 * std::sqrt(dot(d, d));
  }
};

/// The element of order one on the same reference cell: its functions interpolate the vertices alone.
template <Shape shape>
struct VertexElementOf;
template <>
struct VertexElementOf<Shape::line> {
  using Type = Line1;
};
template <>
struct VertexElementOf<Shape::triangle> {
  using Type = Tri1;
};
template <>
struct VertexElementOf<Shape::quad> {
  using Type = Quad1;
};
template <>
struct VertexElementOf<Shape::tet> {
  using Type = Tet1;
};
template <>
struct VertexElementOf<Shape::hex> {
  using Type = Hex1;
};
template <>
struct VertexElementOf<Shape::wedge> {
  using Type = Wedge1;
};

template <class Element>
using VertexElement = typename VertexElementOf<Element::shape>::Type;

/// How far the nodes X that are no vertices lie off the cell through its vertices: the largest distance per
/// axis.
template <class Element, int dim>
Vec<double, dim> offset_from_vertex_cell(const std::array<Vec<double, dim>, Element::n_nodes>& X) {
  Vec<double, dim> offset = Vec<double, dim>::zero();
  for (int a = Element::n_vertices; a < Element::n_nodes; ++a) {
    std::array<double, Element::n_vertices> N;
    VertexElement<Element>::shape_functions(Element::nodes[a], N);
    Vec<double, dim> d = X[a];
    for (int v = 0; v < Element::n_vertices; ++v) d -= N[v] * X[v];
    for (int i = 0; i < dim; ++i) offset[i] = std::max(offset[i], std::abs(d[i]));
  }
  return offset;
}

/// A box that holds every x(xi) of the cell with nodes X, grown by `margin` times its diagonal.
/// The cell through its vertices lies in their hull; node a adds at most |N_a| times its offset from that
/// cell, and the functions of the other nodes have sum |N_a| < 2 (quadratic triangles 4/3, tets 3/2,
/// hexes 1.953).
template <class Element, int dim>
Box<dim> cell_box(const std::array<Vec<double, dim>, Element::n_nodes>& X, double margin) {
  Box<dim> box;
  for (int a = 0; a < Element::n_vertices; ++a) box.extend(X[a]);
  box.grow(2.0 * offset_from_vertex_cell<Element>(X));
  Vec<double, dim> by;
  for (int i = 0; i < dim; ++i) by[i] = 2.0 * margin * box.radius();
  box.grow(by);
  return box;
}

}  // namespace ifsi
