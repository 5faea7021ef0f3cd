#pragma once
/// \file
/// Numbers of 16 bits to store what only a preconditioner reads.

#include <bit>
#include <cstdint>

namespace ifsi {

/// The upper half of a float: its range, and eight bits of precision (2^-9 = 0.2 % when rounded). Sweeps over
/// large meshes run at the speed of the memory, where half the bytes are half the time.
struct Bfloat16 {
  std::uint16_t bits = 0;

  Bfloat16() = default;
  /// Rounded to nearest, halfway to even. NaN stays NaN.
  explicit Bfloat16(float x) {
    const auto all = std::bit_cast<std::uint32_t>(x);
    if (x != x)
      bits = static_cast<std::uint16_t>(all >> 16 | 0x40u);
    else
      bits = static_cast<std::uint16_t>((all + 0x7fffu + (all >> 16 & 1u)) >> 16);
  }
  explicit operator float() const { return std::bit_cast<float>(std::uint32_t{bits} << 16); }
};

}  // namespace ifsi
