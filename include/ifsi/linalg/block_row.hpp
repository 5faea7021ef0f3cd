#pragma once
/// \file
/// The inner loop of all block sparse products: one block row times a vector.

#include <cstdint>
#include <cstring>

#include "ifsi/linalg/bfloat16.hpp"

namespace ifsi {

/// Sums K_ij x_j over the blocks of a row, blocks row-major. Every entry of a block has its own accumulator,
/// so that no addition waits for another; the columns are added up once per row, in store(). Two to four
/// columns: the entries of a block fill registers of four lanes one after the other, and x is repeated along
/// them. The compiler is told, because left alone it transposes. Blocks may be stored in Bfloat16 where T is
/// float.
template <class T, int B>
class BlockRow {
 public:
  template <class Stored>
  void add(const Stored* K, const T* x) {
    if constexpr (B == 2) add(0, K, Register{x[0], x[1], x[0], x[1]});
    if constexpr (B == 3) {
      add(0, K, Register{x[0], x[1], x[2], x[0]});
      add(1, K, Register{x[1], x[2], x[0], x[1]});
      last_ += static_cast<T>(K[8]) * x[2];
    }
    if constexpr (B == 4) {
      Register columns;
      std::memcpy(&columns, x, sizeof columns);
      for (int m = 0; m < n_registers; ++m) add(m, K, columns);
    }
  }
  /// y = the row's sum.
  void store(T* y) const {
    T entries[B * B];
    std::memcpy(entries, sum_, sizeof sum_);
    if constexpr (B == 3) entries[8] = last_;
    for (int r = 0; r < B; ++r) {
      y[r] = entries[r * B];
      for (int c = 1; c < B; ++c) y[r] += entries[r * B + c];
    }
  }
  /// y = b - the row's sum; b and y may be the same. Two numbers go to memory as one, as they are read by
  /// add(): a row that needs them right away would have to wait until both have arrived.
  void store_difference(const T* b, T* y) const {
    if constexpr (B == 2) {
      typedef T Pair __attribute__((vector_size(2 * sizeof(T))));
      Pair result;
      std::memcpy(&result, b, sizeof result);
      result -=
          __builtin_shufflevector(sum_[0], sum_[0], 0, 2) + __builtin_shufflevector(sum_[0], sum_[0], 1, 3);
      std::memcpy(y, &result, sizeof result);
    } else {
      T sum[B];
      store(sum);
      for (int r = 0; r < B; ++r) y[r] = b[r] - sum[r];
    }
  }

 private:
  static_assert(B >= 2 && B <= 4);
  static constexpr int n_registers = B * B / 4;
  typedef T Register __attribute__((vector_size(4 * sizeof(T))));

  /// Part m of the block times the x of its columns. By reference: how a register is passed depends on the
  /// processor.
  void add(int m, const T* K, const Register& factors) {
    Register entries;
    std::memcpy(&entries, K + 4 * m, sizeof entries);
    sum_[m] += entries * factors;
  }
  void add(int m, const Bfloat16* K, const Register& factors) {
    typedef std::uint16_t Halves __attribute__((vector_size(8)));
    typedef std::uint32_t Words __attribute__((vector_size(16)));
    Halves halves;
    std::memcpy(&halves, K + 4 * m, sizeof halves);
    const Words words = __builtin_convertvector(halves, Words) << 16;
    Register entries;
    std::memcpy(&entries, &words, sizeof entries);
    sum_[m] += entries * factors;
  }

  Register sum_[n_registers] = {};
  T last_ = 0;  ///< the ninth entry of B = 3
};

template <class T>
class BlockRow<T, 1> {
 public:
  template <class Stored>
  void add(const Stored* K, const T* x) {
    sum_ += static_cast<T>(*K) * *x;
  }
  void store(T* y) const { *y = sum_; }
  void store_difference(const T* b, T* y) const { *y = *b - sum_; }

 private:
  T sum_ = 0;
};

}  // namespace ifsi
