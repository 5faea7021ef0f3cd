#pragma once
/// \file
/// Coordinate systems as a compile-time policy of fluid and solid kernels alike.

#include <numbers>

namespace ifsi {

/// Cartesian (x, y[, z]); plane strain in two dimensions.
struct Cartesian {
  static constexpr bool axisymmetric = false;
  /// Factor of the volume element at a point; `radius` is its first coordinate.
  template <class T>
  static T measure(const T&) {
    return T(1.0);
  }
};

/// Cylindrical (r, z) of a body of revolution without swirl: first coordinate r, second z.
struct Axisymmetric {
  static constexpr bool axisymmetric = true;
  template <class T>
  static T measure(const T& radius) {
    return T(2.0 * std::numbers::pi) * radius;
  }
};

}  // namespace ifsi
