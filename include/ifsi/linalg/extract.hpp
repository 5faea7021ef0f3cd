#pragma once
/// \file
/// Parts of a block matrix as matrices of their own.

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// The D x D part of each block of K that starts at (offset, offset): the velocity block for offset 0 and
/// D = dim, the pressure block for offset dim and D = 1.
template <int D, int B>
[[nodiscard]] BlockCsr<D> extract_diagonal_part(const BlockCsr<B>& K, int offset) {
  BlockCsr<D> part(K.shared_pattern());
  for (int k = 0; k < K.pattern().n_blocks(); ++k)
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) part.at(k)[r * D + c] = K.at(k)[(offset + r) * B + offset + c];
  return part;
}

}  // namespace ifsi
