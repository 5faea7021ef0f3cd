#pragma once
/// \file
/// What every reference element offers: the contract of the models in element/.

#include <array>
#include <concepts>
#include <span>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// Geometric family of a reference cell.
enum class Shape { point, line, triangle, quad, tet, hex, wedge };

/// A Lagrange element on its reference cell; all members are static and usable at compile time.
///
/// Cells: points, lines, quads and hexes live on [-1,1]^dim, triangles and tets on the unit simplex, wedges
/// on unit triangle x [-1,1]. Nodes: vertices, then edge, face and interior nodes, in the order of VTK's
/// quadratic cells (the wedge excepted: its vertex order is Gmsh's, positively oriented).
///
/// shape_functions, gradients and hessians fill N_a, dN_a/dxi_i and d2N_a/dxi_i dxi_j at any point, also
/// outside the cell, for any number type. metric is M in G = J^-T M J^-1: the inner products that make the
/// regular cell of edge length 2 the unit of length, so that tau_M of the flow does not depend on the parent
/// cell. face_nodes(f) lists the nodes of face f in the order of the element Face, turned so that the
/// right-hand rule gives the outward normal (in 2D: the cell lies on the left). Node k of a VTK (Gmsh) cell
/// is node vtk_order[k] (gmsh_order[k]) here.
template <class E>
concept ReferenceElement = requires(const Vec<double, E::dim>& xi, std::array<double, E::n_nodes>& N,
                                    std::array<Vec<double, E::dim>, E::n_nodes>& dN,
                                    std::array<Mat<double, E::dim>, E::n_nodes>& ddN, int face) {
  requires E::dim >= 0 && E::dim <= 3 && E::n_vertices <= E::n_nodes&& E::order >= 1;
  { E::shape } -> std::convertible_to<Shape>;
  { E::linear } -> std::convertible_to<bool>;
  { E::nodes } -> std::convertible_to<std::array<Vec<double, E::dim>, E::n_nodes>>;
  { E::center } -> std::convertible_to<Vec<double, E::dim>>;
  { E::metric } -> std::convertible_to<Mat<double, E::dim>>;
  E::shape_functions(xi, N);
  E::gradients(xi, dN);
  E::hessians(xi, ddN);
  { E::outside(xi) } -> std::same_as<double>;
  { E::contains(xi, 0.0) } -> std::same_as<bool>;
  typename E::Face;
  { E::n_faces } -> std::convertible_to<int>;
  { E::face_nodes(face) } -> std::same_as<std::span<const int>>;
  { E::face_shape(face) } -> std::same_as<Shape>;
  { E::vtk_type } -> std::convertible_to<int>;
  { E::vtk_order } -> std::convertible_to<std::array<int, E::n_nodes>>;
  { E::gmsh_type } -> std::convertible_to<int>;
  { E::gmsh_order } -> std::convertible_to<std::array<int, E::n_nodes>>;
  { E::name } -> std::convertible_to<const char*>;
};

namespace detail {

constexpr int power(int base, int exponent) {
  int r = 1;
  for (int i = 0; i < exponent; ++i) r *= base;
  return r;
}

/// 0, 1, ..., n - 1: the node order of formats that number as we do.
template <int n>
constexpr std::array<int, n> same_order() {
  std::array<int, n> order{};
  for (int k = 0; k < n; ++k) order[k] = k;
  return order;
}

}  // namespace detail
}  // namespace ifsi
