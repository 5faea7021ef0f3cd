#pragma once
/// \file
/// Keeps denormal numbers out of single-precision sweeps.

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace ifsi {

/// While it lives, numbers too small for a normal float become zero. Sweeps from a local source decay through
/// 1e-38 within a few dozen cells, and arithmetic on denormals is a hundred times slower.
class FlushDenormals {
 public:
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
#if defined(__SSE__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | flush_to_zero | denormals_are_zero); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  unsigned saved_;
#else
  FlushDenormals() = default;
#endif
};

}  // namespace ifsi
