#pragma once
/// \file
/// A distributed matrix with further nodes: rows that belong to no mesh node, all on the last rank.

#include <algorithm>
#include <memory>
#include <vector>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Numbers the nodes of K, then `n_extra` further ones owned by the last rank, and copies matrices and
/// vectors over. Numbers of K's nodes stay as they are.
class Border {
 public:
  Border() = default;
  /// Collective.
  Border(const std::shared_ptr<const Pattern>& K, int n_extra)
      : n_mesh_owned_(K->n_rows()),
        n_here_(is_last(K->layout) ? n_extra : 0),
        first_extra_(K->layout.n_global()) {
    std::vector<long> ghosts;
    for (int g = n_mesh_owned_; g < K->layout.n_local(); ++g) ghosts.push_back(K->layout.global(g));
    auto pattern = std::make_shared<Pattern>(
        Pattern{Layout(K->layout.communicator(), n_mesh_owned_ + n_here_, ghosts), K->row_ptr, K->cols});
    for (int& col : pattern->cols)
      if (col >= n_mesh_owned_) col += n_here_;
    for (int k = 0; k < n_here_; ++k) {
      pattern->cols.push_back(n_mesh_owned_ + k);
      pattern->row_ptr.push_back(pattern->n_blocks());
    }
    pattern_ = pattern;
  }

  [[nodiscard]] const std::shared_ptr<const Pattern>& pattern() const { return pattern_; }
  [[nodiscard]] const Layout& layout() const { return pattern_->layout; }
  /// Further nodes on this rank: all of them on the last, none elsewhere.
  [[nodiscard]] int n_here() const { return n_here_; }
  [[nodiscard]] int n_mesh_owned() const { return n_mesh_owned_; }
  /// Local index (on the last rank) and global number of the k-th further node.
  [[nodiscard]] int local(int k) const { return n_mesh_owned_ + k; }
  [[nodiscard]] long global(int k) const { return first_extra_ + k; }

  /// K with `diagonal` in the further rows.
  template <int B>
  void extend(const BlockCsr<B>& K, double diagonal, BlockCsr<B>& to) const {
    if (to.shared_pattern() != pattern_) to = BlockCsr<B>(pattern_);
    std::copy(K.values.begin(), K.values.end(), to.values.begin());
    std::fill(to.values.begin() + K.values.size(), to.values.end(), 0.0);
    for (int k = 0; k < n_here_; ++k)
      for (int i = 0; i < B; ++i) to.at(K.pattern().n_blocks() + k)[i * B + i] = diagonal;
  }

 private:
  static bool is_last(const Layout& layout) {
    return layout.communicator().rank() + 1 == layout.communicator().size();
  }

  int n_mesh_owned_ = 0, n_here_ = 0;
  long first_extra_ = 0;
  std::shared_ptr<const Pattern> pattern_;
};

}  // namespace ifsi
