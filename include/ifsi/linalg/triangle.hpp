#pragma once
/// \file
/// One half of a block matrix, laid out for the sweeps of ILU(0) and Gauss-Seidel; small dense blocks.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/core/tensor.hpp"
#include "ifsi/linalg/aligned.hpp"
#include "ifsi/linalg/block_row.hpp"
#include "ifsi/linalg/local_blocks.hpp"

namespace ifsi {

/// Replaces a D x D block by its inverse; computed in double, since pivots may be nearly singular in float.
/// Throws Error(linear_solver), which names the row, when the block is singular.
template <int D>
void invert(float* block, int row) {
  Mat<double, D> A;
  for (int e = 0; e < D * D; ++e) A.data[e] = block[e];
  const double d = det(A);
  if (!(std::abs(d) > 0) || !std::isfinite(d))
    throw Error(ExitCode::linear_solver, "preconditioner: singular diagonal block at local node " +
                                             std::to_string(row) + "; expected a regular velocity block");
  const Mat<double, D> inverse_of_A = inverse(A);
  for (int e = 0; e < D * D; ++e) block[e] = static_cast<float>(inverse_of_A.data[e]);
}

/// y = A x for one block.
template <int D>
void multiply(const float* A, const float* x, float* y) {
  for (int r = 0; r < D; ++r) {
    float sum = 0;
    for (int c = 0; c < D; ++c) sum += A[r * D + c] * x[c];
    y[r] = sum;
  }
}

/// B = A B for blocks.
template <int D>
void multiply_from_left(const float* A, float* B) {
  float product[D * D] = {};
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c)
      for (int k = 0; k < D; ++k) product[r * D + c] += A[r * D + k] * B[k * D + c];
  std::copy_n(product, D * D, B);
}

/// The blocks on one side of the diagonal, row after row in the order in which a sweep needs them. Rows of
/// the whole matrix would be fetched twice, by either sweep for the half it uses. Stored: float or Bfloat16.
template <int D, class Stored>
class Triangle {
 public:
  /// The blocks of A below the diagonal, first row first; or those above it, last row first.
  void take_lower(const LocalBlocks<D>& A) {
    const OverlapPattern& at = A.pattern();
    clear(at);
    for (int i = 0; i < A.n_rows(); ++i) {
      for (int k = at.row_ptr[i]; k < at.diagonal[i]; ++k) append(A.at(k), at.cols[k]);
      row_end_.push_back(static_cast<int>(cols_.size()));
    }
  }
  void take_upper(const LocalBlocks<D>& A) {
    const OverlapPattern& at = A.pattern();
    clear(at);
    for (int i = A.n_rows() - 1; i >= 0; --i) {
      for (int k = at.row_ptr[i + 1] - 1; k > at.diagonal[i]; --k) append(A.at(k), at.cols[k]);
      row_end_.push_back(static_cast<int>(cols_.size()));
    }
  }

  /// Goes through the rows once, in their order.
  class Reader {
   public:
    explicit Reader(const Triangle& rows)
        : first_(rows.cols_.data()), col_(first_), end_(rows.row_end_.data()), block_(rows.values_.data()) {}
    /// y = b - the next row's sum of blocks times x, D numbers. y may be b.
    void next_residual(const float* b, const float* x, float* y) {
      BlockRow<float, D> row;
      for (const int* end = first_ + *end_++; col_ != end; ++col_, block_ += D * D)
        row.add(block_, x + static_cast<std::size_t>(*col_) * D);
      row.store_difference(b, y);
    }

   private:
    const int *first_, *col_, *end_;
    const Stored* block_;
  };

 private:
  void clear(const OverlapPattern& at) {
    const std::size_t n_blocks = (at.cols.size() - at.diagonal.size() + 1) / 2;  // the pattern is symmetric
    row_end_.clear(), cols_.clear(), values_.clear();
    row_end_.reserve(at.diagonal.size()), cols_.reserve(n_blocks), values_.reserve(n_blocks * D * D);
  }
  void append(const float* block, int col) {
    for (int e = 0; e < D * D; ++e) values_.emplace_back(block[e]);
    cols_.push_back(col);
  }

  std::vector<int> row_end_, cols_;
  AlignedVector<Stored> values_;
};

}  // namespace ifsi
