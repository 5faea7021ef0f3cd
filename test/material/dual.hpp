#pragma once
/// \file
/// Dual numbers a + b eps, eps^2 = 0, over any number type: exact derivatives for checking. Nest them for
/// second derivatives.

#include <cmath>

namespace ifsi::testing {

template <class T>
struct Dual {
  T value;
  T slope;

  Dual() = default;
  Dual(double s) : value(s), slope(0.0) {}  // numbers mix freely with duals
  Dual(T v, T d) : value(v), slope(d) {}

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T q = a.value / b.value;
    return {q, (a.slope - q * b.slope) / b.value};
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend Dual log(const Dual& a) {
    using std::log;
    return {log(a.value), a.slope / a.value};
  }
  friend Dual exp(const Dual& a) {
    using std::exp;
    return {exp(a.value), exp(a.value) * a.slope};
  }
  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const T r = sqrt(a.value);
    return {r, a.slope / (2.0 * r)};
  }
  friend Dual pow(const Dual& a, double e) {
    using std::pow;
    return {pow(a.value, e), e * pow(a.value, e - 1.0) * a.slope};
  }
};

}  // namespace ifsi::testing
