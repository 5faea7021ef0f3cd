#pragma once
/// \file
/// Bodies must be apart when a run begins.

#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/coupling/point_locator.hpp"
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

}  // namespace ifsi
