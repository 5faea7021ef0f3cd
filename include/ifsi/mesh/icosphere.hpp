#pragma once
/// \file
/// Points spread evenly over a sphere.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

namespace detail {

/// Corners of an icosahedron with edges of length 2, symmetric to the three planes of the coordinates.
inline std::vector<Vec<double, 3>> icosahedron() {
  std::vector<Vec<double, 3>> corners;
  for (int d = 0; d < 3; ++d)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-std::numbers::phi, std::numbers::phi}) {
        Vec<double, 3> x{};
        x[(d + 1) % 3] = a, x[(d + 2) % 3] = b;
        corners.push_back(x);
      }
  return corners;
}

inline double distance(const Vec<double, 3>& x, const Vec<double, 3>& y) {
  return std::sqrt(dot(x - y, x - y));
}

}  // namespace detail

/// The 10 f^2 + 2 points of an icosahedron about the origin whose edges are cut into f = `frequency` parts,
/// thrown onto the sphere: unlike those of a cubed sphere they crowd nowhere. With the planes x = 0, y = 0
/// and z = 0 they are symmetric. \return points, their corners' first
inline std::vector<Vec<double, 3>> icosphere_points(double radius, int frequency) {
  const auto corners = detail::icosahedron();
  const int n = static_cast<int>(corners.size());
  const auto are_joined = [&](int a, int b) {
    return std::abs(detail::distance(corners[a], corners[b]) - 2.0) < 1e-9;
  };
  std::vector<Vec<double, 3>> points;
  const auto add = [&](const Vec<double, 3>& x) { points.push_back((radius / std::sqrt(dot(x, x))) * x); };
  const auto part = [&](int k) { return static_cast<double>(k) / frequency; };
  for (const auto& corner : corners) add(corner);
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      if (!are_joined(a, b)) continue;
      for (int i = 1; i < frequency; ++i) add(part(frequency - i) * corners[a] + part(i) * corners[b]);
      for (int c = b + 1; c < n; ++c)
        if (are_joined(a, c) && are_joined(b, c))
          for (int i = 1; i < frequency; ++i)
            for (int j = 1; i + j < frequency; ++j)
              add(part(frequency - i - j) * corners[a] + part(i) * corners[b] + part(j) * corners[c]);
    }
  return points;
}

/// Distance of neighbours if n points covered a sphere with equilateral triangles.
inline double even_spacing(double radius, double n) {
  return radius * std::sqrt(8.0 * std::numbers::pi / (std::numbers::sqrt3 * n));
}

/// How many points have that distance, at least two.
inline double even_count(double radius, double spacing) {
  return std::max(2.0, 8.0 * std::numbers::pi * radius * radius / (std::numbers::sqrt3 * spacing * spacing));
}

/// The frequency with which neighbours come nearest to a distance.
inline int icosphere_frequency(double radius, double spacing) {
  return std::max(1, static_cast<int>(std::lround(std::sqrt((even_count(radius, spacing) - 2.0) / 10.0))));
}

}  // namespace ifsi
