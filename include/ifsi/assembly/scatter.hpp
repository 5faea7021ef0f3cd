#pragma once
/// \file
/// From lanes to memory: the lanes of a pack block belong to different cells and go to different places.

#include "ifsi/core/pack.hpp"

namespace ifsi {

/// Adds lane l of n packs to the n consecutive numbers at to[l]; a null pointer takes nothing.
template <int n, int W>
inline void add_lanes(const Pack<W>* values, double* const* to) {
  alignas(64) double buffer[n][W];
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < W; ++l) buffer[k][l] = values[k][l];
  for (int l = 0; l < W; ++l) {
    if (to[l] == nullptr) continue;
    for (int k = 0; k < n; ++k) to[l][k] += buffer[k][l];
  }
}

}  // namespace ifsi
