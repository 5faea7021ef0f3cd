#pragma once
/// \file
/// The inner loop of all block sparse products: one block row times a vector.

#include <cstring>

namespace ifsi {

/// Sums K_ij x_j over the blocks of a row, blocks row-major. Every entry of a block has its own accumulator,
/// so that no addition waits for another; the columns are added up once per row, in store(). Two to four
/// columns: the entries of a block fill the lanes of registers one after the other, and x is repeated along
/// them. The compiler is told, because left alone it transposes.
template <class T, int B>
class BlockRow {
 public:
  void add(const T* K, const T* x) {
    const Register factors = repeat(x);
    for (int m = 0; m < n_registers; ++m) {
      Register entries;
      std::memcpy(&entries, K + m * lanes, sizeof entries);
      sum_[m] += entries * factors;
    }
    if constexpr (n_registers * lanes < B * B) last_ += K[B * B - 1] * x[B - 1];
  }
  /// y = the row's sum.
  void store(T* y) const {
    T entries[B * B];
    std::memcpy(entries, sum_, sizeof sum_);
    if constexpr (n_registers * lanes < B * B) entries[B * B - 1] = last_;
    for (int r = 0; r < B; ++r) {
      y[r] = entries[r * B];
      for (int c = 1; c < B; ++c) y[r] += entries[r * B + c];
    }
  }

 private:
  static_assert(B >= 2 && B <= 4);
  static constexpr int bytes = B == 4 ? 64 : B == 3 ? 8 * sizeof(T) : 4 * sizeof(T);
  static constexpr int lanes = bytes / sizeof(T);
  static constexpr int n_registers = B * B / lanes;
  typedef T Register __attribute__((vector_size(bytes)));

  /// x_0 .. x_{B-1}, x_0 .. as far as the lanes go, which are a multiple of B or, for B = 3, 8.
  static Register repeat(const T* x) {
    if constexpr (B == 2) return Register{x[0], x[1], x[0], x[1]};
    if constexpr (B == 3) return Register{x[0], x[1], x[2], x[0], x[1], x[2], x[0], x[1]};
    if constexpr (B == 4) {
      typedef T Quad __attribute__((vector_size(4 * sizeof(T))));
      Quad q;
      std::memcpy(&q, x, sizeof q);
      if constexpr (lanes == 8)
        return __builtin_shufflevector(q, q, 0, 1, 2, 3, 0, 1, 2, 3);
      else
        return __builtin_shufflevector(q, q, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
    }
  }

  Register sum_[n_registers] = {};
  T last_ = 0;
};

template <class T>
class BlockRow<T, 1> {
 public:
  void add(const T* K, const T* x) { sum_ += *K * *x; }
  void store(T* y) const { *y = sum_; }

 private:
  T sum_ = 0;
};

}  // namespace ifsi
