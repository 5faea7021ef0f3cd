#pragma once
/// \file
/// Distance from a position to a cell: to its closest interior point, face, edge or vertex.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "ifsi/core/tensor.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/element/geometry.hpp"

namespace ifsi {

/// Calls `visit.operator()<FaceElement>(face_nodes)` for each face of the reference cell.
template <class Element, class Visit>
void for_each_cell_face(Visit&& visit) {
  for (int face = 0; face < Element::n_faces; ++face) {
    if constexpr (requires { typename Element::OtherFace; }) {
      if (Element::face_shape(face) == Element::OtherFace::shape) {
        visit.template operator()<typename Element::OtherFace>(Element::face_nodes(face));
        continue;
      }
    }
    visit.template operator()<typename Element::Face>(Element::face_nodes(face));
  }
}

namespace detail {

/// Half the squared distance from the target to x(xi), with what Newton's method needs of it.
template <class Element, int dim>
struct SquaredDistance {
  static constexpr int m = Element::dim;
  double value;
  Vec<double, m> descent;  ///< minus the gradient
  Mat<double, m> hessian;  ///< without the curvature of the face where that makes it indefinite

  SquaredDistance(const std::array<Vec<double, dim>, Element::n_nodes>& X, const Vec<double, dim>& target,
                  const Vec<double, m>& xi) {
    std::array<Vec<double, m>, Element::n_nodes> dN;
    std::array<Mat<double, m>, Element::n_nodes> ddN;
    Element::gradients(xi, dN);
    Element::hessians(xi, ddN);
    const Vec<double, dim> gap = target - map<Element>(xi, X);
    const Mat<double, dim, m> J = jacobian(dN, X);
    value = 0.5 * dot(gap, gap);
    descent = transpose(J) * gap;
    const Mat<double, m> stiff = transpose(J) * J;
    hessian = stiff;
    for (int a = 0; a < Element::n_nodes; ++a) hessian -= dot(gap, X[a]) * ddN[a];
    if (!(det(hessian) > 0.0 && trace(hessian) > 0.0)) hessian = stiff;
  }
};

/// The xi near the node nearest to `target` where x(xi) is closest to it, by damped Newton, as if the cell
/// had no faces. For lines and surfaces in space: Element::dim <= 2.
template <class Element, int dim>
Vec<double, Element::dim> closest_parameter(const std::array<Vec<double, dim>, Element::n_nodes>& X,
                                            const Vec<double, dim>& target) {
  constexpr int max_iterations = 40, max_halvings = 20;
  const auto nearest = std::min_element(X.begin(), X.end(), [&](const auto& a, const auto& b) {
    return dot(a - target, a - target) < dot(b - target, b - target);
  });
  Vec<double, Element::dim> xi = Element::nodes[nearest - X.begin()];
  SquaredDistance<Element, dim> here(X, target, xi);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Vec<double, Element::dim> step = inverse(here.hessian) * here.descent;
    SquaredDistance<Element, dim> there(X, target, xi + step);
    for (int halving = 0; halving < max_halvings && !(there.value < here.value); ++halving) {
      step = 0.5 * step;
      there = SquaredDistance<Element, dim>(X, target, xi + step);
    }
    if (!(there.value < here.value)) break;
    xi += step;
    here = there;
  }
  return xi;
}

}  // namespace detail

/// Distance from x to the faces of a cell with nodes X (not zero when x is inside). Exact where the faces are
/// flat; on curved ones the distance to a point of theirs that is closest at least locally.
template <class Element, int dim>
double distance_to_faces(const std::array<Vec<double, dim>, Element::n_nodes>& X, const Vec<double, dim>& x);

/// Distance from x to a cell of lower dimension than the space.
template <class Element, int dim>
double distance_to_manifold(const std::array<Vec<double, dim>, Element::n_nodes>& X,
                            const Vec<double, dim>& x) {
  if constexpr (Element::dim == 0) {
    return std::sqrt(dot(x - X[0], x - X[0]));
  } else {
    const double to_faces = distance_to_faces<Element>(X, x);
    const Vec<double, Element::dim> xi = detail::closest_parameter<Element>(X, x);
    if (!Element::contains(xi, 0.0)) return to_faces;
    const Vec<double, dim> gap = x - map<Element>(xi, X);
    return std::min(to_faces, std::sqrt(dot(gap, gap)));
  }
}

template <class Element, int dim>
double distance_to_faces(const std::array<Vec<double, dim>, Element::n_nodes>& X, const Vec<double, dim>& x) {
  double distance = std::numeric_limits<double>::infinity();
  for_each_cell_face<Element>([&]<class Face>(std::span<const int> nodes) {
    std::array<Vec<double, dim>, Face::n_nodes> face_X;
    for (int a = 0; a < Face::n_nodes; ++a) face_X[a] = X[nodes[a]];
    distance = std::min(distance, distance_to_manifold<Face>(face_X, x));
  });
  return distance;
}

}  // namespace ifsi
