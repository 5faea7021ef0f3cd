#pragma once
/// \file
/// Norms of a velocity-pressure vector by block of equations, and the size of what cancels in a residual.

#include <cmath>
#include <span>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// A number for the momentum rows and one for the mass rows.
struct BlockNorms {
  double momentum = 0.0, mass = 0.0;
  [[nodiscard]] bool finite() const { return std::isfinite(momentum) && std::isfinite(mass); }
};

/// Euclidean norms over the owned rows of all ranks; the last unknown of each node is the mass row.
template <int B>
[[nodiscard]] BlockNorms block_norms(const Layout& layout, std::span<const double> x) {
  double squares[2] = {0.0, 0.0};
  for (int node = 0; node < layout.n_owned(); ++node)
    for (int i = 0; i < B; ++i) squares[i == B - 1] += x[node * B + i] * x[node * B + i];
  layout.communicator().sum_in_place(squares, 2);
  return {std::sqrt(squares[0]), std::sqrt(squares[1])};
}

/// Block norms of |K| |x|, the measure of a residual K x - f in the sense of a backward error: a residual
/// that is epsilon of this is solved exactly by a matrix changed by epsilon. Ghosts of x are up to date.
template <int B>
[[nodiscard]] BlockNorms absolute_product_norms(const BlockCsr<B>& K, std::span<const double> x) {
  double squares[2] = {0.0, 0.0};
  for (int row = 0; row < K.n_rows(); ++row) {
    double sums[B] = {};
    for (int k = K.row_ptr()[row]; k < K.row_ptr()[row + 1]; ++k) {
      const double* block = K.at(k);
      const double* x_col = &x[static_cast<std::size_t>(K.cols()[k]) * B];
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) sums[i] += std::abs(block[i * B + j] * x_col[j]);
    }
    for (int i = 0; i < B; ++i) squares[i == B - 1] += sums[i] * sums[i];
  }
  K.layout().communicator().sum_in_place(squares, 2);
  return {std::sqrt(squares[0]), std::sqrt(squares[1])};
}

}  // namespace ifsi
