#pragma once
/// \file
/// Shape functions and their derivatives tabulated at quadrature points, at compile time.

#include "ifsi/element/geometry.hpp"
#include "ifsi/quadrature/quadrature.hpp"

namespace ifsi {

namespace detail {

/// Tables at n points: N[q][a], dN[q][a], ddN[q][a].
template <class Element, std::size_t n_points>
struct Tables {
  static constexpr int dim = Element::dim;
  using Points = std::array<Vec<double, dim>, n_points>;
  using Values = std::array<std::array<double, Element::n_nodes>, n_points>;
  using Gradients = std::array<std::array<Vec<double, dim>, Element::n_nodes>, n_points>;
  using Hessians = std::array<std::array<Mat<double, dim>, Element::n_nodes>, n_points>;

  static constexpr Values values(const Points& points) {
    Values N{};
    for (std::size_t q = 0; q < n_points; ++q) Element::shape_functions(points[q], N[q]);
    return N;
  }
  static constexpr Gradients gradients(const Points& points) {
    Gradients dN{};
    for (std::size_t q = 0; q < n_points; ++q) Element::gradients(points[q], dN[q]);
    return dN;
  }
  static constexpr Hessians hessians(const Points& points) {
    Hessians ddN{};
    for (std::size_t q = 0; q < n_points; ++q) Element::hessians(points[q], ddN[q]);
    return ddN;
  }
};

/// Points of the face rule Q in the cell, [face][q]; faces of another shape than Face are left at zero.
template <class Element, class Face, class Q>
constexpr auto face_points() {
  std::array<std::array<Vec<double, Element::dim>, Q::n>, Element::n_faces> points{};
  for (int f = 0; f < Element::n_faces; ++f)
    for (int q = 0; q < Q::n; ++q)
      if (Element::face_shape(f) == Face::shape) points[f][q] = face_to_cell<Element, Face>(f, Q::points[q]);
  return points;
}

/// One table for each face.
template <class Table, class Points, std::size_t n_faces>
constexpr std::array<Table, n_faces> per_face(const std::array<Points, n_faces>& points,
                                              Table tabulate(const Points&)) {
  std::array<Table, n_faces> tables{};
  for (std::size_t f = 0; f < n_faces; ++f) tables[f] = tabulate(points[f]);
  return tables;
}

}  // namespace detail

/// N[q][a], dN[q][a] = dN_a/dxi, ddN[q][a] = d2N_a/dxi dxi and weights[q] at the points of Q in the cell.
template <ReferenceElement Element_, QuadratureRule<Element_> Q = DefaultQuadrature<Element_>>
struct BasisTable {
 private:
  using Tables = detail::Tables<Element_, Q::n>;

 public:
  using Element = Element_;
  static constexpr int n_points = Q::n;
  static constexpr int n_nodes = Element::n_nodes;
  static constexpr std::array<double, Q::n> weights = Q::weights;
  static constexpr typename Tables::Values N = Tables::values(Q::points);
  static constexpr typename Tables::Gradients dN = Tables::gradients(Q::points);
  static constexpr typename Tables::Hessians ddN = Tables::hessians(Q::points);
};

/// The cell's N[f][q][a], dN[f][q][a], ddN[f][q][a] and points[f][q] at the points of the rule Q of its faces
/// f, and the basis of the faces themselves (for normals and areas) in OnFace. For cells with two kinds of
/// faces, give the kind: the entries of the other faces are meaningless.
template <ReferenceElement Element_, ReferenceElement Face_ = typename Element_::Face,
          QuadratureRule<Face_> Q = DefaultQuadrature<Face_>>
struct FaceBasisTable {
 private:
  using Tables = detail::Tables<Element_, Q::n>;
  template <class Table>
  using PerFace = std::array<Table, Element_::n_faces>;

 public:
  using Element = Element_;
  using Face = Face_;
  using OnFace = BasisTable<Face, Q>;
  static constexpr int n_faces = Element::n_faces;
  static constexpr int n_points = Q::n;
  static constexpr int n_nodes = Element::n_nodes;
  static constexpr std::array<double, Q::n> weights = Q::weights;
  static constexpr PerFace<typename Tables::Points> points = detail::face_points<Element, Face, Q>();
  static constexpr PerFace<typename Tables::Values> N = detail::per_face(points, Tables::values);
  static constexpr PerFace<typename Tables::Gradients> dN = detail::per_face(points, Tables::gradients);
  static constexpr PerFace<typename Tables::Hessians> ddN = detail::per_face(points, Tables::hessians);
};

}  // namespace ifsi
