#pragma once
/// \file
/// Friction between nodes that do not move alike.

#include <cstddef>
#include <span>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// Friction on the slip sum_a w_a v_a of some nodes; weights that add up to zero feel no common motion. The
/// force on node a is w_a times that on the slip, so that its power is that of the slip, and never negative.
template <int dim>
struct Friction {
  using Point = Vec<double, dim>;
  using Block = Mat<double, dim>;

  double coefficient;                   ///< force per velocity
  Block direction = Block::identity();  ///< projector: all of the slip, or a part of it

  /// Adds the forces, as a residual, and their slopes (n x n blocks, row by row; none when K is empty) of n
  /// nodes with the weights w and the velocities v. Nodes without weight are passed over. \return the power
  double add(std::span<const double> w, std::span<const Point> v, std::span<Point> R,
             std::span<Block> K) const {
    const std::size_t n = w.size();
    Point slip = Point::zero();
    for (std::size_t a = 0; a < n; ++a) slip += w[a] * v[a];
    const Point force = coefficient * (direction * slip);
    for (std::size_t a = 0; a < n; ++a) {
      if (w[a] == 0.0) continue;
      R[a] += w[a] * force;
      for (std::size_t b = 0; !K.empty() && b < n; ++b)
        if (w[b] != 0.0) K[a * n + b] += (coefficient * w[a] * w[b]) * direction;
    }
    return dot(force, slip);
  }
};

}  // namespace ifsi
