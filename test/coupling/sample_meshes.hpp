#pragma once
/// \file
/// Meshes of every cell type with cells that are neither straight nor equal, and positions to look for in
/// them.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ifsi/element/geometry.hpp"
#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"

namespace ifsi::sample {

/// Reproducible numbers in [0, 1), the same on all ranks.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2654435761u + 12345) {}
  double operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1.0p-53;
  }
  double between(double a, double b) { return a + (b - a) * (*this)(); }
  int below(int n) { return static_cast<int>((*this)() * n); }
  template <int dim>
  Vec<double, dim> vector(double a, double b) {
    Vec<double, dim> x;
    for (int i = 0; i < dim; ++i) x[i] = between(a, b);
    return x;
  }

 private:
  std::uint64_t state_;
};

/// A smooth one-to-one map of space that keeps the unit box: what curves order-2 cells.
template <int dim>
Vec<double, dim> bend(const Vec<double, dim>& x) {
  constexpr double pi = 3.141592653589793;
  Vec<double, dim> y = x;
  for (int i = 0; i < dim; ++i) {
    double wave = 0.06 * std::sin(pi * x[i]);
    for (int j = 0; j < dim; ++j)
      if (j != i) wave *= std::cos(2 * pi * x[j] + i);
    y[i] += wave;
  }
  return y;
}

/// The unit box with `cells` per direction.
template <class Element>
GlobalMesh<Element> straight(const std::array<int, Element::dim>& cells) {
  constexpr int dim = Element::dim;
  Vec<double, dim> lower = Vec<double, dim>::zero(), upper = lower;
  for (int i = 0; i < dim; ++i) upper[i] = 1;
  return box<Element>(lower, upper, cells);
}

/// The same, bent; cells of order one are also shaken, so that no two are alike.
template <class Element>
GlobalMesh<Element> bent(const std::array<int, Element::dim>& cells) {
  GlobalMesh<Element> mesh = straight<Element>(cells);
  Random random(7);
  for (auto& x : mesh.points) {
    bool interior = true;
    for (int i = 0; i < Element::dim; ++i) interior = interior && x[i] > 1e-9 && x[i] < 1 - 1e-9;
    x = bend(x);
    if (Element::order > 1 || !interior) continue;
    for (int i = 0; i < Element::dim; ++i) x[i] += random.between(-0.12, 0.12) / cells[i];
  }
  return mesh;
}

/// A few cells per direction, another number along each axis.
template <int dim>
std::array<int, dim> counts(int n) {
  std::array<int, dim> cells;
  for (int i = 0; i < dim; ++i) cells[i] = n + i;
  return cells;
}

/// A random position in the reference cell.
template <class Element>
Vec<double, Element::dim> inside(Random& random) {
  for (;;) {
    const auto xi = random.vector<Element::dim>(-1, 1);
    if (Element::contains(xi, 0)) return xi;
  }
}

/// A random position on one face of the reference cell.
template <class Element>
Vec<double, Element::dim> on_face(Random& random) {
  const int face = random.below(Element::n_faces);
  if constexpr (requires { typename Element::OtherFace; })
    if (Element::face_shape(face) == Element::OtherFace::shape)
      return face_to_cell<Element, typename Element::OtherFace>(face,
                                                                inside<typename Element::OtherFace>(random));
  return face_to_cell<Element>(face, inside<typename Element::Face>(random));
}

/// Reference positions on vertices, edges and faces of a cell, edge middles and the centre.
template <class Element>
std::vector<Vec<double, Element::dim>> awkward(Random& random) {
  std::vector<Vec<double, Element::dim>> xis(Element::nodes.begin(), Element::nodes.end());
  xis.push_back(Element::center);
  for (int a = 0; a < Element::n_vertices; ++a)
    for (int b = 0; b < a; ++b) xis.push_back(0.5 * (Element::nodes[a] + Element::nodes[b]));
  for (int k = 0; k < 4; ++k) xis.push_back(on_face<Element>(random));
  return xis;
}

}  // namespace ifsi::sample
