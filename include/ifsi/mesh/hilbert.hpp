#pragma once
/// \file
/// Position along a Hilbert curve: cells close on the curve are close in space.

#include <cstdint>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// Index along the Hilbert curve through a grid of 2^bits cells per axis (bits * dim <= 63).
/// J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707 (2004) 381: axes to transposed index.
template <int dim>
constexpr std::uint64_t hilbert_index(Vec<std::uint32_t, dim> x, int bits) {
  const std::uint32_t top = 1u << (bits - 1);
  for (std::uint32_t q = top; q > 1; q >>= 1)
    for (int i = 0; i < dim; ++i) {
      if (x[i] & q) {
        x[0] ^= q - 1;
      } else {
        const std::uint32_t t = (x[0] ^ x[i]) & (q - 1);
        x[0] ^= t;
        x[i] ^= t;
      }
    }
  for (int i = 1; i < dim; ++i) x[i] ^= x[i - 1];
  std::uint32_t t = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1)
    if (x[dim - 1] & q) t ^= q - 1;
  for (int i = 0; i < dim; ++i) x[i] ^= t;
  std::uint64_t index = 0;
  for (int b = bits - 1; b >= 0; --b)
    for (int i = 0; i < dim; ++i) index = index << 1 | (x[i] >> b & 1u);
  return index;
}

}  // namespace ifsi
