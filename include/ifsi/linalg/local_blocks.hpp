#pragma once
/// \file
/// A rank's own square part of a block matrix, as preconditioners want it: small blocks in single precision.

#include <vector>

#include "ifsi/linalg/aligned.hpp"
#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Owned rows and owned columns of a matrix, D x D blocks of float, row-major. Half the bytes of double is
/// half the time of a sweep, and six digits are plenty for a preconditioner.
template <int D>
struct LocalBlocks {
  std::vector<int> row_ptr, cols;
  std::vector<int> diagonal;  ///< position of the diagonal block of each row
  AlignedVector<float> values;

  [[nodiscard]] int n_rows() const { return static_cast<int>(diagonal.size()); }
  [[nodiscard]] float* at(int k) { return &values[static_cast<std::size_t>(k) * D * D]; }
  [[nodiscard]] const float* at(int k) const { return &values[static_cast<std::size_t>(k) * D * D]; }

  /// Takes the leading D x D part of each B x B block of K.
  template <int B>
  void assign(const BlockCsr<B>& K) {
    static_assert(D <= B);
    row_ptr.assign(1, 0);
    cols.clear();
    diagonal.clear();
    values.clear();
    for (int i = 0; i < K.n_rows(); ++i) {
      for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k) {
        const int j = K.cols()[k];
        if (j >= K.n_rows()) continue;
        if (j == i) diagonal.push_back(static_cast<int>(cols.size()));
        cols.push_back(j);
        for (int r = 0; r < D; ++r)
          for (int c = 0; c < D; ++c) values.push_back(static_cast<float>(K.at(k)[r * B + c]));
      }
      row_ptr.push_back(static_cast<int>(cols.size()));
    }
  }
};

}  // namespace ifsi
