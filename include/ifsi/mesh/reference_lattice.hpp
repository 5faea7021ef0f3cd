#pragma once
/// \file
/// Relations between the nodes of reference cells: which base cell a generator builds on, where the nodes of
/// one cell lie in another.

#include <array>
#include <type_traits>

#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/topology.hpp"

namespace ifsi {

/// The tensor-product cell (line, quad, hex) of the same dimension and order as Element.
template <class Element>
struct BaseCellOf {
  static constexpr int dim = Element::dim, order = Element::order;
  using First = std::conditional_t<dim == 1, Line1, std::conditional_t<dim == 2, Quad1, Hex1>>;
  using Second = std::conditional_t<dim == 1, Line2, std::conditional_t<dim == 2, Quad2, Hex2>>;
  using type = std::conditional_t<order == 1, First, Second>;
};
template <class Element>
using BaseCell = typename BaseCellOf<Element>::type;

/// Whether Element is a tensor-product cell itself.
template <class Element>
constexpr bool is_tensor_cell = std::is_same_v<Element, BaseCell<Element>>;

/// The local node at a reference coordinate, or -1.
template <class Element>
constexpr int find_node(const Vec<double, Element::dim>& xi) {
  for (int a = 0; a < Element::n_nodes; ++a) {
    double distance = 0;
    for (int d = 0; d < Element::dim; ++d) {
      const double difference = Element::nodes[a][d] - xi[d];
      distance += difference * difference;
    }
    if (distance < 1e-12) return a;
  }
  return -1;
}

/// The local face of a tensor cell on the side xi_axis = -1 (upper false) or +1, or -1.
template <class Element>
int face_on_side(int axis, bool upper) {
  for (int f = 0; f < Element::n_faces; ++f) {
    bool on_side = true;
    for (int a : Element::face_nodes(f)) on_side &= Element::nodes[a][axis] == (upper ? 1.0 : -1.0);
    if (on_side) return f;
  }
  return -1;
}

}  // namespace ifsi
