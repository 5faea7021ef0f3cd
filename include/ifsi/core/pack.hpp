#pragma once
/// \file
/// W double lanes computed together: the number type of kernels that work on W cells at once.

#include <cmath>
#include <cstddef>
#include <utility>

namespace ifsi {

/// Lanes per register of the processor this translation unit is compiled for. Every processor has a
/// correct fallback: the compiler splits or scalarises what it has no register for.
#if defined(IFSI_LANES)
inline constexpr int default_lanes = IFSI_LANES;
#elif defined(__AVX512F__)
inline constexpr int default_lanes = 8;
#elif defined(__AVX2__)
inline constexpr int default_lanes = 4;
#else
inline constexpr int default_lanes = 2;
#endif

namespace detail {
template <int W>
struct LaneRegister {
  typedef double Type __attribute__((vector_size(W * sizeof(double))));
};
}  // namespace detail

/// W doubles that behave as one number. W is a power of two.
template <int W>
struct Pack {
  static_assert(W > 0 && (W & (W - 1)) == 0, "the lane count is a power of two");
  static constexpr int lanes = W;
  using Register = typename detail::LaneRegister<W>::Type;
  Register v;

  Pack() = default;
  Pack(double s) : v(s - Register{}) {}  // broadcast: numbers mix freely with packs
  explicit Pack(Register r) : v(r) {}

  double operator[](int lane) const { return v[lane]; }
  void set(int lane, double s) { v[lane] = s; }

  Pack& operator+=(Pack b) { return v += b.v, *this; }
  Pack& operator-=(Pack b) { return v -= b.v, *this; }
  Pack& operator*=(Pack b) { return v *= b.v, *this; }
  friend Pack operator+(Pack a, Pack b) { return Pack(Register(a.v + b.v)); }
  friend Pack operator-(Pack a, Pack b) { return Pack(Register(a.v - b.v)); }
  friend Pack operator*(Pack a, Pack b) { return Pack(Register(a.v * b.v)); }
  friend Pack operator/(Pack a, Pack b) { return Pack(Register(a.v / b.v)); }
  friend Pack operator-(Pack a) { return Pack(Register(-a.v)); }

  friend Pack sqrt(Pack a) {
    return a.map([](double x) { return std::sqrt(x); });
  }
  friend Pack pow(Pack a, double e) {
    return a.map([e](double x) { return std::pow(x, e); });
  }
  friend Pack log(Pack a) {
    return a.map([](double x) { return std::log(x); });
  }
  friend Pack exp(Pack a) {
    return a.map([](double x) { return std::exp(x); });
  }
  friend Pack max(Pack a, Pack b) { return Pack(Register(a.v > b.v ? a.v : b.v)); }
  friend Pack min(Pack a, Pack b) { return Pack(Register(a.v < b.v ? a.v : b.v)); }

 private:
  template <class F>
  Pack map(F f) const {
    Pack r;
    for (int l = 0; l < W; ++l) r.v[l] = f(v[l]);
    return r;
  }
};

namespace detail {

/// One step of a transposition: swaps the off-diagonal quarters of the 2s x 2s blocks in which rows x and y
/// are s apart.
template <int s, int W, std::size_t... k>
inline void exchange(Pack<W>& x, Pack<W>& y, std::index_sequence<k...>) {
  const auto low = __builtin_shufflevector(x.v, y.v, ((k & s) ? W + k - s : k)...);
  const auto high = __builtin_shufflevector(x.v, y.v, ((k & s) ? W + k : k + s)...);
  x.v = low;
  y.v = high;
}

template <int s, int W>
[[gnu::always_inline]] inline void transpose_from(Pack<W> (&rows)[W]) {
  if constexpr (s < W) {
#pragma GCC unroll 16
    for (int i = 0; i < W; ++i)
      if ((i & s) == 0) exchange<s>(rows[i], rows[i + s], std::make_index_sequence<W>());
    transpose_from<2 * s>(rows);
  }
}

}  // namespace detail

/// Transposes W x W numbers in registers: lane j of row i becomes lane i of row j.
template <int W>
[[gnu::always_inline]] inline void transpose(Pack<W> (&rows)[W]) {
  detail::transpose_from<1>(rows);
}

}  // namespace ifsi
