#include "ifsi/linalg/ilu.hpp"

#include <cmath>
#include <string>

#include "ifsi/core/error.hpp"
#include "ifsi/core/tensor.hpp"
#include "ifsi/linalg/block_row.hpp"

namespace ifsi {
namespace {

/// Replaces a block by its inverse; computed in double, since pivots may be nearly singular in float.
template <int D>
void invert(float* block, int row) {
  Mat<double, D> A;
  for (int e = 0; e < D * D; ++e) A.data[e] = block[e];
  const double d = det(A);
  if (!(std::abs(d) > 0) || !std::isfinite(d))
    throw Error(ExitCode::linear_solver, "incomplete factorisation: singular diagonal block at local node " +
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

/// C -= A B for blocks.
template <int D>
void subtract_product(const float* A, const float* B, float* C) {
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c)
      for (int k = 0; k < D; ++k) C[r * D + c] -= A[r * D + k] * B[k * D + c];
}

/// y = b - sum of the blocks [begin, end) times x. y may be b.
template <int D>
void row_residual(const LocalBlocks<D>& A, int begin, int end, const float* b, const float* x, float* y) {
  const int* cols = A.pattern().cols.data();
  BlockRow<float, D> row;
  for (int k = begin; k < end; ++k) row.add(A.at(k), x + static_cast<std::size_t>(cols[k]) * D);
  row.store_difference(b, y);
}

}  // namespace

/// Goes through a triangle from its first row to its last.
template <int D>
class BlockIlu<D>::Reader {
 public:
  explicit Reader(const Triangle& rows)
      : first_(rows.cols.data()), col_(first_), end_(rows.row_end.data()), block_(rows.values.data()) {}
  /// y = b - the next row's sum of blocks times x. y may be b.
  void next_residual(const float* b, const float* x, float* y) {
    BlockRow<float, D> row;
    for (const int* end = first_ + *end_++; col_ != end; ++col_, block_ += D * D)
      row.add(block_, x + static_cast<std::size_t>(*col_) * D);
    row.store_difference(b, y);
  }

 private:
  const int *first_, *col_, *end_;
  const float* block_;
};

template <int D>
void BlockIlu<D>::factor() {
  const OverlapPattern& at = LU_.pattern();
  std::vector<int> position(LU_.n_rows(), -1);
  pivots_.resize(static_cast<std::size_t>(LU_.n_rows()) * D * D);
  for (int i = 0; i < LU_.n_rows(); ++i) {
    eliminate_row(i, position);
    float* pivot = &pivots_[static_cast<std::size_t>(i) * D * D];
    std::copy_n(LU_.at(at.diagonal[i]), D * D, pivot);
    invert<D>(pivot, i);
    for (int k = at.row_ptr[i]; k < at.row_ptr[i + 1]; ++k)
      if (k != at.diagonal[i]) multiply_from_left<D>(pivot, LU_.at(k));
  }
  line_up();
}

/// Copies L and U to where the sweeps read them.
template <int D>
void BlockIlu<D>::line_up() {
  const auto& [row_ptr, cols, diagonal, blocks] = LU_.pattern();
  const std::size_t n_blocks = (cols.size() - row_ptr.size() + 1) / 2;  // the pattern is symmetric
  for (Triangle* triangle : {&lower_, &upper_}) {
    triangle->clear();
    triangle->cols.reserve(n_blocks);
    triangle->values.reserve(n_blocks * D * D);
  }
  for (int i = 0; i < LU_.n_rows(); ++i) {
    for (int k = row_ptr[i]; k < diagonal[i]; ++k) lower_.append(LU_.at(k), cols[k]);
    lower_.end_row();
  }
  for (int i = LU_.n_rows() - 1; i >= 0; --i) {
    for (int k = row_ptr[i + 1] - 1; k > diagonal[i]; --k) upper_.append(LU_.at(k), cols[k]);
    upper_.end_row();
  }
}

/// Row i after the rows above it. `position` maps a column to its block in row i; -1 elsewhere, also on
/// return.
template <int D>
void BlockIlu<D>::eliminate_row(int i, std::vector<int>& position) {
  const auto& [row_ptr, cols, diagonal, blocks] = LU_.pattern();
  for (int k = row_ptr[i]; k < row_ptr[i + 1]; ++k) position[cols[k]] = k;
  for (int k = row_ptr[i]; k < diagonal[i]; ++k) {
    const int j = cols[k];
    for (int u = diagonal[j] + 1; u < row_ptr[j + 1]; ++u)
      if (const int to = position[cols[u]]; to >= 0) subtract_product<D>(LU_.at(k), LU_.at(u), LU_.at(to));
  }
  for (int k = row_ptr[i]; k < row_ptr[i + 1]; ++k) position[cols[k]] = -1;
}

template <int D>
void BlockIlu<D>::apply(float* b, float* x) const {
  LU_.layout().update_ghosts(b, D);
  Reader rows_of_L(lower_), rows_of_U(upper_);
  float scaled[D];
  for (int i = 0; i < LU_.n_rows(); ++i) {
    multiply<D>(&pivots_[static_cast<std::size_t>(i) * D * D], b + static_cast<std::size_t>(i) * D, scaled);
    rows_of_L.next_residual(scaled, x, x + static_cast<std::size_t>(i) * D);
  }
  for (int i = LU_.n_rows() - 1; i >= 0; --i) {
    float* xi = x + static_cast<std::size_t>(i) * D;
    rows_of_U.next_residual(xi, x, xi);
  }
}

template <int D>
void RefinedIlu<D>::apply(float* b, float* x) {
  const std::size_t n_mine = static_cast<std::size_t>(A_.layout().n_owned()) * D;
  correction_.resize(static_cast<std::size_t>(A_.layout().n_local()) * D);
  std::fill_n(x, n_mine, 0.0f);
  for (int pass = 1;; ++pass) {
    ilu_.apply(b, correction_.data());
    const float factor = pass < passes_ ? damping_ : 1.0f;
    for (std::size_t e = 0; e < n_mine; ++e) x[e] += correction_[e] *= factor;
    if (pass == passes_) return;
    subtract_product_with(correction_.data(), b);
  }
}

/// b -= A x on the owned rows.
template <int D>
void RefinedIlu<D>::subtract_product_with(float* x, float* b) const {
  const OverlapPattern& at = A_.pattern();
  A_.layout().update_ghosts(x, D);
  for (int i = 0; i < A_.layout().n_owned(); ++i) {
    float* bi = b + static_cast<std::size_t>(i) * D;
    row_residual<D>(A_, at.row_ptr[i], at.row_ptr[i + 1], bi, x, bi);
  }
}

template <int D>
void BlockGaussSeidel<D>::invert_diagonals() {
  inverse_.resize(static_cast<std::size_t>(A_.n_rows()) * D * D);
  for (int i = 0; i < A_.n_rows(); ++i) {
    float* block = &inverse_[static_cast<std::size_t>(i) * D * D];
    std::copy_n(A_.at(A_.pattern().diagonal[i]), D * D, block);
    invert<D>(block, i);
  }
}

template <int D>
void BlockGaussSeidel<D>::apply(float* b, float* x) const {
  A_.layout().update_ghosts(b, D);
  const OverlapPattern& at = A_.pattern();
  float rest[D];
  const auto relax = [&](int i, int begin, int end) {
    row_residual<D>(A_, begin, end, b + static_cast<std::size_t>(i) * D, x, rest);
  };
  // Forward, from zero: what lies above the diagonal has not been reached yet.
  for (int i = 0; i < A_.n_rows(); ++i) {
    relax(i, at.row_ptr[i], at.diagonal[i]);
    multiply<D>(&inverse_[static_cast<std::size_t>(i) * D * D], rest, x + static_cast<std::size_t>(i) * D);
  }
  // Backward: the whole row, the old value of the diagonal taken out again by adding a correction.
  for (int i = A_.n_rows() - 1; i >= 0; --i) {
    relax(i, at.row_ptr[i], at.row_ptr[i + 1]);
    float correction[D];
    multiply<D>(&inverse_[static_cast<std::size_t>(i) * D * D], rest, correction);
    for (int r = 0; r < D; ++r) x[static_cast<std::size_t>(i) * D + r] += correction[r];
  }
}

template class BlockIlu<1>;
template class BlockIlu<2>;
template class BlockIlu<3>;
template class RefinedIlu<1>;
template class RefinedIlu<2>;
template class RefinedIlu<3>;
template class BlockGaussSeidel<1>;
template class BlockGaussSeidel<2>;
template class BlockGaussSeidel<3>;

}  // namespace ifsi
