#pragma once
/// \file
/// Integration rules on the reference cells, chosen by element and degree at compile time.

#include "ifsi/element/element.hpp"
#include "ifsi/quadrature/gauss_legendre.hpp"
#include "ifsi/quadrature/symmetric.hpp"

namespace ifsi {

namespace detail {

/// Highest degree for which the symmetric rules of the simplices are known here.
inline constexpr int max_symmetric_degree = 6;

/// Triangle rule x line rule.
template <int degree>
constexpr auto wedge_rule() {
  constexpr auto triangle = symmetric_rule<2, degree>();
  constexpr auto line = gauss_legendre<degree / 2 + 1>();
  constexpr int n_triangle = triangle.weights.size(), n_line = line.weights.size();
  Rule<3, n_triangle * n_line> r{};
  for (int q = 0; q < n_triangle * n_line; ++q) {
    const Vec<double, 2>& x = triangle.points[q % n_triangle];
    r.points[q] = {x[0], x[1], line.points[q / n_triangle][0]};
    r.weights[q] = triangle.weights[q % n_triangle] * line.weights[q / n_triangle];
  }
  return r;
}

template <Shape shape, int dim, int degree>
constexpr auto reference_rule() {
  if constexpr (shape == Shape::point) {
    return Rule<0, 1>{{}, {1.0}};
  } else if constexpr (shape == Shape::wedge) {
    return wedge_rule<degree>();
  } else if constexpr (shape == Shape::triangle || shape == Shape::tet) {
    if constexpr (degree <= max_symmetric_degree) {
      return symmetric_rule<dim, degree>();
    } else {
      return collapsed_rule<dim, (degree + dim + 1) / 2>();
    }
  } else {
    return tensor_rule<dim, degree / 2 + 1>();
  }
}

template <class Element>
constexpr int default_degree() {
  constexpr bool simplex = Element::shape == Shape::triangle || Element::shape == Shape::tet;
  if (Element::order == 1) return simplex || Element::shape == Shape::wedge ? 2 : 3;
  return 5;
}

}  // namespace detail

/// What a rule offers for the cells of Element.
template <class Q, class Element>
concept QuadratureRule = requires {
  requires Q::n >= 1 && Q::degree >= 0;
  { Q::points } -> std::convertible_to<std::array<Vec<double, Element::dim>, Q::n>>;
  { Q::weights } -> std::convertible_to<std::array<double, Q::n>>;
};

/// The rule exact for polynomials of total degree `degree_` on the reference cell of Element (per direction
/// on lines, quads and hexes). Weights are positive and points inside.
template <ReferenceElement Element, int degree_>
struct Quadrature {
 private:
  static constexpr auto rule = detail::reference_rule<Element::shape, Element::dim, degree_>();

 public:
  static constexpr int degree = degree_;
  static constexpr int n = static_cast<int>(rule.weights.size());
  static constexpr std::array<Vec<double, Element::dim>, n> points = rule.points;
  static constexpr std::array<double, n> weights = rule.weights;
};

/// Order 1: 2 points per direction, 3 on triangles, 4 on tets, 3 x 2 on wedges: the mass matrix of a simplex
/// is exact. Order 2: 3 points per direction, 7 on triangles, 14 on tets: v.grad v.w is exact on affine
/// simplices.
template <ReferenceElement Element>
using DefaultQuadrature = Quadrature<Element, detail::default_degree<Element>()>;

}  // namespace ifsi
