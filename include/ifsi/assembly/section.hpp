#pragma once
/// \file
/// Integrals of nodal fields over a plane section of a mesh.

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/mesh/mesh.hpp"

namespace ifsi {

namespace detail {

/// Tetrahedra between the nodes of a cell: itself, or the eighths of one of order 2.
template <class Element>
constexpr auto node_tetrahedra() {
  if constexpr (Element::n_nodes == 4)
    return std::array<std::array<int, 4>, 1>{{{0, 1, 2, 3}}};
  else
    return std::array<std::array<int, 4>, 8>{{{0, 4, 6, 7},
                                              {4, 1, 5, 8},
                                              {6, 5, 2, 9},
                                              {7, 8, 9, 3},
                                              {4, 9, 5, 6},
                                              {4, 9, 6, 7},
                                              {4, 9, 7, 8},
                                              {4, 9, 8, 5}}};
}

}  // namespace detail

/// The section of a mesh of tetrahedra with the plane where coordinate `axis` is `at`. The plane cuts
/// a cell in a triangle or a quadrilateral, over which a linear field integrates exactly: what is kept is a
/// weight per node. Fields of order 2 are taken as linear in each eighth of their cells. A plane through
/// nodes is taken to pass just below them. Collective throughout.
template <class Element>
class Section {
  static_assert(Element::dim == 3 && (Element::n_nodes == 4 || Element::n_nodes == 10));
  using Point = Vec<double, 3>;

 public:
  /// \throws Error (configuration) when the plane misses the mesh.
  Section(const Mesh<Element>& mesh, int axis, double at) : comm_(mesh.comm) {
    std::map<int, double> weights;
    for (int c = 0; c < mesh.n_owned_cells; ++c)
      for (const auto& nodes : detail::node_tetrahedra<Element>())
        add_tetrahedron(mesh, c, nodes, axis, at, weights);
    weights_.assign(weights.begin(), weights.end());
    for (const auto& [node, weight] : weights_) area_ += weight;
    area_ = comm_.sum(area_);
    if (!(area_ > 0.0))
      throw Error(ExitCode::configuration, std::string("the plane ") + "xyz"[axis] + " = " +
                                               std::to_string(at) + " does not cut the mesh");
  }

  [[nodiscard]] double area() const { return area_; }
  /// Integral of one component of interleaved nodal values, `block` per node, ghosts up to date.
  [[nodiscard]] double integral(std::span<const double> u, int block, int component) const {
    double sum = 0.0;
    for (const auto& [node, weight] : weights_)
      sum += weight * u[static_cast<std::size_t>(node) * block + component];
    return comm_.sum(sum);
  }
  [[nodiscard]] double mean(std::span<const double> u, int block, int component) const {
    return integral(u, block, component) / area_;
  }

 private:
  /// A corner of the cut: a point on the edge from a node below the plane to one above.
  struct Corner {
    int low, high;
    double t;  ///< part of the way
    Point x;
  };

  static void add_tetrahedron(const Mesh<Element>& mesh, int c, const std::array<int, 4>& nodes, int axis,
                              double at, std::map<int, double>& weights) {
    const auto X = mesh.cell_coordinates(c);
    std::vector<int> low, high;
    for (int a : nodes) (X[a][axis] < at ? low : high).push_back(a);
    if (low.empty() || high.empty()) return;
    const auto corner = [&](int a, int b) {
      const double t = (at - X[a][axis]) / (X[b][axis] - X[a][axis]);
      return Corner{mesh.cells[c][a], mesh.cells[c][b], t, X[a] + t * (X[b] - X[a])};
    };
    std::vector<Corner> cut;  // around the polygon
    if (low.size() == 2)
      cut = {corner(low[0], high[0]), corner(low[0], high[1]), corner(low[1], high[1]),
             corner(low[1], high[0])};
    else
      for (int a : low)
        for (int b : high) cut.push_back(corner(a, b));
    for (std::size_t k = 2; k < cut.size(); ++k) add_triangle({cut[0], cut[k - 1], cut[k]}, weights);
  }

  static void add_triangle(const std::array<Corner, 3>& corners, std::map<int, double>& weights) {
    const Point e = corners[1].x - corners[0].x, f = corners[2].x - corners[0].x;
    const double third = std::sqrt(std::max(0.0, dot(e, e) * dot(f, f) - dot(e, f) * dot(e, f))) / 6.0;
    for (const Corner& corner : corners) {
      weights[corner.low] += (1.0 - corner.t) * third;
      weights[corner.high] += corner.t * third;
    }
  }

  Communicator comm_;
  std::vector<std::pair<int, double>> weights_;  ///< local node, weight
  double area_ = 0.0;
};

}  // namespace ifsi
