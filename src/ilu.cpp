#include "ifsi/linalg/ilu.hpp"

namespace ifsi {
namespace {

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
  lower_.take_lower(LU_);
  upper_.take_upper(LU_);
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
  typename Triangle<D, float>::Reader rows_of_L(lower_), rows_of_U(upper_);
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

template class BlockIlu<1>;
template class BlockIlu<2>;
template class BlockIlu<3>;
template class RefinedIlu<1>;
template class RefinedIlu<2>;
template class RefinedIlu<3>;

}  // namespace ifsi
