#pragma once
/// \file
/// W double lanes computed together: the number type of kernels that work on W cells at once.

#include <cmath>

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

}  // namespace ifsi
