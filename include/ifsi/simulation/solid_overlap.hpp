#pragma once
/// \file
/// Bodies must be apart when a run begins; how near they come later.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/coupling/point_locator.hpp"
#include "ifsi/coupling/point_tree.hpp"
#include "ifsi/mesh/distribute.hpp"

namespace ifsi {

namespace detail {

/// Whether the locator's body holds x in its inside: bodies may touch.
template <class Element>
bool holds_inside(const PointLocator<Element>& body, const Vec<double, Element::dim>& x) {
  const auto at = body.find(x);
  return at.found() && Element::outside(at.xi) < -1e-6;
}

/// A node or centre of a cell of `mesh` that is inside of the locator's body; nullptr when there is none.
/// Centres are looked at too, since meshes that overlap by whole cells have their nodes on each other's
/// faces.
template <class Element>
const Vec<double, Element::dim>* point_inside(const PointLocator<Element>& body,
                                              const GlobalMesh<Element>& mesh,
                                              Vec<double, Element::dim>& center) {
  for (const auto& x : mesh.points)
    if (holds_inside(body, x)) return &x;
  for (const auto& cell : mesh.cells) {
    center = Vec<double, Element::dim>::zero();
    for (int p : cell) center += (1.0 / Element::n_nodes) * mesh.points[p];
    if (holds_inside(body, center)) return &center;
  }
  return nullptr;
}

}  // namespace detail

/// \throws Error (configuration) when a node of one body, or the centre of one of its cells, lies inside
/// another.
template <class Body>
void refuse_overlap(const std::vector<Body>& bodies) {
  using Element = typename Body::Element;
  if (bodies.size() < 2) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto mesh = distribute(bodies[b].mesh(), Communicator(MPI_COMM_SELF));
    const PointLocator<Element> locator(mesh);
    for (std::size_t other = 0; other < bodies.size(); ++other) {
      Vec<double, Element::dim> center;
      const auto* x = other == b ? nullptr : detail::point_inside(locator, bodies[other].mesh(), center);
      if (x == nullptr) continue;
      std::string at;
      for (double coordinate : x->data) at += (at.empty() ? "" : ", ") + std::to_string(coordinate);
      throw Error(ExitCode::configuration,
                  "solids '" + bodies[other].name() + "' and '" + bodies[b].name() + "' overlap at (" + at +
                      "); expected bodies that are apart, or touch, when a run begins");
    }
  }
}

/// How near two bodies of a scene are to each other.
struct SolidNearness {
  double distance = std::numeric_limits<double>::infinity();  ///< least, of nodes of two bodies
  int inside = 0;                                             ///< nodes that are inside another body
};
/// \param x positions of all nodes, body after body.
template <class Body>
[[nodiscard]] SolidNearness nearness(const std::vector<Body>& bodies,
                                     const std::vector<Vec<double, Body::dim>>& x) {
  SolidNearness near;
  std::size_t begin = 0;
  for (const Body& body : bodies) {
    const std::size_t end = begin + body.n_nodes();
    auto moved = body.mesh();
    std::copy(x.begin() + begin, x.begin() + end, moved.points.begin());
    const PointTree<Body::dim> tree(moved.points);
    const auto mesh = distribute(moved, Communicator(MPI_COMM_SELF));
    const PointLocator<typename Body::Element> locator(mesh);
    for (std::size_t a = 0; a < x.size(); ++a) {
      if (a >= begin && a < end) continue;
      const auto d = x[a] - moved.points[tree.nearest(x[a])];
      near.distance = std::min(near.distance, std::sqrt(dot(d, d)));
      near.inside += detail::holds_inside(locator, x[a]);
    }
    begin = end;
  }
  return near;
}

}  // namespace ifsi
