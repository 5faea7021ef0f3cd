#pragma once
/// \file
/// Elimination of prescribed unknowns from a distributed block system.

#include <cstdint>
#include <span>
#include <vector>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Which unknowns of each local node are prescribed: bit i of mask[node] stands for unknown i.
using ConstraintMask = std::vector<std::uint8_t>;

/// Zeroes the residual of prescribed unknowns (their increment is zero).
template <int B>
void constrain_residual(const ConstraintMask& mask, int n_owned, std::span<double> R) {
  for (int node = 0; node < n_owned; ++node)
    for (int i = 0; i < B; ++i)
      if (mask[node] >> i & 1) R[node * B + i] = 0.0;
}

/// Removes the rows and columns of prescribed unknowns but for the diagonal, which keeps its size: an
/// identity of the scale of its neighbours leaves multigrid and norms undisturbed.
/// Without `keep_diagonal` that goes too: for a matrix that is added to one that has it.
template <int B>
void constrain_matrix(const ConstraintMask& mask, BlockCsr<B>& K, bool keep_diagonal = true) {
  for (int row = 0; row < K.n_rows(); ++row)
    for (int k = K.row_ptr()[row]; k < K.row_ptr()[row + 1]; ++k) {
      const int col = K.cols()[k];
      if ((mask[row] | mask[col]) == 0) continue;
      double* block = K.at(k);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) {
          const bool diagonal = keep_diagonal && row == col && i == j;
          if (!diagonal && ((mask[row] >> i & 1) || (mask[col] >> j & 1))) block[i * B + j] = 0.0;
        }
    }
}

}  // namespace ifsi
