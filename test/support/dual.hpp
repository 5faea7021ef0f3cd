#pragma once
// A forward-mode automatic differentiation number: value and n derivatives.

#include <array>
#include <cmath>

namespace ifsi::test {

template <int n>
struct Dual {
  double v = 0.0;
  std::array<double, n> d{};

  Dual() = default;
  Dual(double value) : v(value) {}
  static Dual variable(double value, int index) {
    Dual r(value);
    r.d[index] = 1.0;
    return r;
  }
  // f(a) with df/da = slope
  static Dual chain(const Dual& a, double value, double slope) {
    Dual r(value);
    for (int i = 0; i < n; ++i) r.d[i] = slope * a.d[i];
    return r;
  }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator-(const Dual& a) { return Dual(0.0) - a; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r(a.v * b.v);
    for (int i = 0; i < n; ++i) r.d[i] = a.d[i] * b.v + a.v * b.d[i];
    return r;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual r(a.v / b.v);
    for (int i = 0; i < n; ++i) r.d[i] = (a.d[i] - r.v * b.d[i]) / b.v;
    return r;
  }
  Dual& operator+=(const Dual& b) {
    v += b.v;
    for (int i = 0; i < n; ++i) d[i] += b.d[i];
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    v -= b.v;
    for (int i = 0; i < n; ++i) d[i] -= b.d[i];
    return *this;
  }
  friend Dual pow(const Dual& a, double e) { return chain(a, std::pow(a.v, e), e * std::pow(a.v, e - 1.0)); }
  // The only square root of the flow kernel is tau_M, whose derivative the tangent leaves out on purpose (eq.
  // 7).
  friend Dual sqrt(const Dual& a) { return Dual(std::sqrt(a.v)); }
};

}  // namespace ifsi::test
