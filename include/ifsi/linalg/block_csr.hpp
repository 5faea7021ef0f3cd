#pragma once
/// \file
/// Distributed sparse matrix of dense B x B blocks, one block row per owned node.

#include <memory>
#include <vector>

#include "ifsi/linalg/aligned.hpp"
#include "ifsi/linalg/block_row.hpp"
#include "ifsi/linalg/pattern.hpp"

namespace ifsi {

/// Rows are the owned nodes of the layout, columns its local nodes. Block k of the pattern occupies
/// values[k * B * B ...], row-major. Vectors hold n_local * B numbers, the B unknowns of a node side by side.
template <int B>
class BlockCsr {
 public:
  static constexpr int block = B;

  BlockCsr() = default;
  explicit BlockCsr(std::shared_ptr<const Pattern> pattern)
      : values(static_cast<std::size_t>(pattern->n_blocks()) * B * B, 0.0), pattern_(std::move(pattern)) {}
  BlockCsr(const Layout& layout, std::vector<int> row_ptr, std::vector<int> cols)
      : BlockCsr(std::make_shared<const Pattern>(Pattern{layout, std::move(row_ptr), std::move(cols)})) {}

  AlignedVector<double> values;

  [[nodiscard]] const Pattern& pattern() const { return *pattern_; }
  [[nodiscard]] std::shared_ptr<const Pattern> shared_pattern() const { return pattern_; }
  [[nodiscard]] const Layout& layout() const { return pattern_->layout; }
  [[nodiscard]] const std::vector<int>& row_ptr() const { return pattern_->row_ptr; }
  [[nodiscard]] const std::vector<int>& cols() const { return pattern_->cols; }
  [[nodiscard]] int n_rows() const { return pattern_->n_rows(); }
  /// Block index of (row, col), or -1.
  [[nodiscard]] int find(int row, int col) const { return pattern_->find(row, col); }
  /// The B * B numbers of block k, row-major.
  [[nodiscard]] double* at(int k) { return &values[static_cast<std::size_t>(k) * B * B]; }
  [[nodiscard]] const double* at(int k) const { return &values[static_cast<std::size_t>(k) * B * B]; }

  void set_zero() { std::fill(values.begin(), values.end(), 0.0); }

  /// y = K x on the owned rows. The ghost entries of x are refreshed from their owners first.
  void apply(double* x, double* y) const {
    layout().update_ghosts(x, B);
    multiply(x, y);
  }

  /// y = K x on the owned rows, with the ghosts of x up to date.
  void multiply(const double* x, double* y) const {
    const int* row_ptr = pattern_->row_ptr.data();
    const int* cols = pattern_->cols.data();
    for (int i = 0, n = n_rows(); i < n; ++i) {
      BlockRow<double, B> row;
      for (int k = row_ptr[i]; k < row_ptr[i + 1]; ++k)
        row.add(at(k), x + static_cast<std::size_t>(cols[k]) * B);
      row.store(y + static_cast<std::size_t>(i) * B);
    }
  }

 private:
  std::shared_ptr<const Pattern> pattern_;
};

}  // namespace ifsi
