#pragma once
/// \file
/// The inner loop of all block sparse products: one block row times a vector.

#include <cstring>

namespace ifsi {

/// Sums K_ij x_j over the blocks of a row, blocks row-major. Every entry of a block has its own accumulator,
/// so that no addition waits for another; the columns are added up once per row, in store().
template <class T, int B>
struct BlockRow {
  T sum[B][B] = {};

  void add(const T* K, const T* x) {
    for (int r = 0; r < B; ++r)
      for (int c = 0; c < B; ++c) sum[r][c] += K[r * B + c] * x[c];
  }
  /// y = the row's sum.
  void store(T* y) const {
    for (int r = 0; r < B; ++r) {
      y[r] = sum[r][0];
      for (int c = 1; c < B; ++c) y[r] += sum[r][c];
    }
  }
};

/// Four columns fill a register: the compiler is told, because left alone it transposes.
template <class T>
struct BlockRow<T, 4> {
  typedef T Register __attribute__((vector_size(4 * sizeof(T))));
  Register sum[4] = {};

  void add(const T* K, const T* x) {
    Register xj, row;
    std::memcpy(&xj, x, sizeof xj);
    for (int r = 0; r < 4; ++r) {
      std::memcpy(&row, K + 4 * r, sizeof row);
      sum[r] += row * xj;
    }
  }
  void store(T* y) const {
    for (int r = 0; r < 4; ++r) y[r] = (sum[r][0] + sum[r][1]) + (sum[r][2] + sum[r][3]);
  }
};

}  // namespace ifsi
