#pragma once
/// \file
/// Meshes put together from blocks whose touching points coincide.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ifsi/mesh/global_mesh.hpp"

namespace ifsi {

/// Appends nx x ny cells of a plane tensor cell (quad). position(s, t) is the point at s in [0, nx], t in [0,
/// ny], asked at the nodes of the cells: whole numbers, and half numbers for order 2. (s, t) must be
/// right-handed.
template <class Element, class Position>
void append_block(GlobalMesh<Element>& mesh, int nx, int ny, Position&& position) {
  constexpr int k = Element::order;
  const int first = mesh.n_points(), stride = k * nx + 1;
  for (int j = 0; j <= k * ny; ++j)
    for (int i = 0; i <= k * nx; ++i)
      mesh.points.push_back(position(static_cast<double>(i) / k, static_cast<double>(j) / k));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      auto& cell = mesh.cells.emplace_back();
      for (int a = 0; a < Element::n_nodes; ++a) {
        const int di = static_cast<int>((Element::nodes[a][0] + 1) / 2 * k + 0.5);
        const int dj = static_cast<int>((Element::nodes[a][1] + 1) / 2 * k + 0.5);
        cell[a] = first + (k * j + dj) * stride + k * i + di;
      }
    }
}

namespace detail {

/// Points seen so far, found again within a tolerance: a hash over squares twice the tolerance wide.
class PointIndex {
 public:
  explicit PointIndex(double tolerance) : tolerance_(tolerance) {}

  /// A point within the tolerance of x, or -1.
  [[nodiscard]] int find(const Vec<double, 2>& x, const std::vector<Vec<double, 2>>& points) const {
    const auto [i, j] = square(x);
    for (std::int64_t di = -1; di <= 1; ++di)
      for (std::int64_t dj = -1; dj <= 1; ++dj) {
        const auto [first, last] = squares_.equal_range(key(i + di, j + dj));
        for (auto it = first; it != last; ++it)
          if (dot(points[it->second] - x, points[it->second] - x) <= tolerance_ * tolerance_)
            return it->second;
      }
    return -1;
  }
  void add(const Vec<double, 2>& x, int point) {
    const auto [i, j] = square(x);
    squares_.emplace(key(i, j), point);
  }

 private:
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> square(const Vec<double, 2>& x) const {
    return {std::llround(x[0] / (2 * tolerance_)), std::llround(x[1] / (2 * tolerance_))};
  }
  static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(j);
  }
  double tolerance_;
  std::unordered_multimap<std::uint64_t, int> squares_;
};

}  // namespace detail

/// Makes one point of all points closer than the tolerance (a length).
template <class Element>
void weld(GlobalMesh<Element>& mesh, double tolerance) {
  detail::PointIndex index(tolerance);
  std::vector<Vec<double, 2>> points;
  std::vector<int> number;
  for (const auto& x : mesh.points) {
    int point = index.find(x, points);
    if (point < 0) {
      point = static_cast<int>(points.size());
      points.push_back(x);
      index.add(x, point);
    }
    number.push_back(point);
  }
  mesh.points = std::move(points);
  for (auto& cell : mesh.cells)
    for (int& p : cell) p = number[p];
}

}  // namespace ifsi
