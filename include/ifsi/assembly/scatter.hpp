#pragma once
/// \file
/// From lanes to memory: the lanes of a pack block belong to different cells and go to different places.

#include <cstring>

#include "ifsi/core/pack.hpp"
#include "ifsi/core/tensor.hpp"

namespace ifsi {

namespace detail {

/// Adds the W numbers of a register to those at `to`, of any alignment.
template <int W>
[[gnu::always_inline]] inline void add_register(const Pack<W>& values, double* to) {
  Pack<W> sum;
  std::memcpy(&sum.v, to, sizeof sum.v);
  sum += values;
  std::memcpy(to, &sum.v, sizeof sum.v);
}

}  // namespace detail

/// Adds lane l of n packs to the n consecutive numbers at to[l]; a null pointer takes nothing. Packs are
/// transposed W at a time in registers, so that each lane becomes one vector; what is left goes number by
/// number.
template <int n, int W>
[[gnu::always_inline]] inline void add_lanes(const Pack<W>* values, double* const* to) {
  constexpr int transposed = n / W * W;
  IFSI_UNROLL
  for (int first = 0; first < transposed; first += W) {
    Pack<W> lanes[W];
    IFSI_UNROLL
    for (int k = 0; k < W; ++k) lanes[k] = values[first + k];
    transpose(lanes);
    IFSI_UNROLL
    for (int l = 0; l < W; ++l)
      if (to[l] != nullptr) detail::add_register(lanes[l], to[l] + first);
  }
  if constexpr (transposed < n) {
    alignas(64) double rest[n - transposed][W];
    std::memcpy(rest, values + transposed, sizeof rest);
    for (int l = 0; l < W; ++l) {
      if (to[l] == nullptr) continue;
      for (int k = transposed; k < n; ++k) to[l][k] += rest[k - transposed][l];
    }
  }
}

}  // namespace ifsi
