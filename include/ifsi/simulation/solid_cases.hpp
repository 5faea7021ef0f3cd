#pragma once
/// \file
/// Meshes of the solid benchmarks: Cook's membrane and the flag of Turek & Hron.

#include <cmath>

#include "ifsi/mesh/box.hpp"

namespace ifsi {

/// Cook's membrane, the trapezoid (0,0), (48,44), (48,60), (0,44), with n cells along each side. In space it
/// is one unit thick, one cell through the thickness; the triangles of wedges lie across it, since triangles
/// *in* the membrane would have a constant volume ratio each, and nothing for a mean to relieve. Boundaries
/// left, right, bottom, top(, front, back).
template <class Element>
GlobalMesh<Element> cook_membrane(int n) {
  GlobalMesh<Element> mesh;
  if constexpr (Element::dim == 2) {
    mesh = box<Element>({0, 0}, {1, 1}, {n, n});
  } else if constexpr (Element::shape == Shape::wedge) {
    mesh = box<Element>({0, 0, 0}, {1, 1, 1}, {n, 1, n});  // extruded along its third axis
    mesh.boundary_names = {"bottom", "top", "front", "back", "left", "right"};
    for (auto& x : mesh.points) x = {x[2], x[0], x[1]};
  } else {
    mesh = box<Element>({0, 0, 0}, {1, 1, 1}, {n, n, 1});
  }
  for (auto& x : mesh.points) {
    const double s = x[0], t = x[1];
    x[0] = 48 * s;
    x[1] = 44 * s + t * (44 - 28 * s);
  }
  return mesh;
}

/// The elastic flag of Turek & Hron (2006): from the back of the cylinder at (0.2, 0.2), radius 0.05, to x =
/// 0.6, 0.02 thick. Boundaries left (on the cylinder), right, bottom, top. \param radius of the arc the root
/// lies on: a little less than 0.05 puts the root's nodes inside the polygon that stands for the cylinder.
template <class Element>
GlobalMesh<Element> turek_hron_flag(int n_x, int n_y, double radius = 0.05) {
  GlobalMesh<Element> mesh = box<Element>({0, -0.01}, {1, 0.01}, {n_x, n_y});
  for (auto& x : mesh.points) {
    const double root = 0.2 + std::sqrt(radius * radius - x[1] * x[1]);
    x = {root + x[0] * (0.6 - root), 0.2 + x[1]};
  }
  return mesh;
}

}  // namespace ifsi
