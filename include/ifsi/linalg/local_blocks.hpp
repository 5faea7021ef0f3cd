#pragma once
/// \file
/// A rank's own square part of a block matrix, as preconditioners want it: small blocks in single precision.

#include <memory>

#include "ifsi/linalg/aligned.hpp"
#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/overlap.hpp"

namespace ifsi {

/// The rows and columns of a rank's nodes, owned and ghost, D x D blocks of float, row-major. Half the bytes
/// of double is half the time of a sweep, and six digits are plenty for a preconditioner.
template <int D>
class LocalBlocks {
 public:
  AlignedVector<float> values;

  [[nodiscard]] const OverlapPattern& pattern() const { return overlap_; }
  [[nodiscard]] const Layout& layout() const { return source_->layout; }
  [[nodiscard]] int n_rows() const { return overlap_.n_rows(); }
  [[nodiscard]] float* at(int k) { return &values[static_cast<std::size_t>(k) * D * D]; }
  [[nodiscard]] const float* at(int k) const { return &values[static_cast<std::size_t>(k) * D * D]; }

  /// Collective. Takes the leading D x D part of each B x B block of K; the ghosts' rows come from their
  /// owners. Which rows and columns these are is found out once per pattern.
  template <int B>
  void assign(const BlockCsr<B>& K) {
    static_assert(D <= B);
    if (source_ != K.shared_pattern()) {
      source_ = K.shared_pattern();
      overlap_ = make_overlap(*source_);
    }
    values.resize(static_cast<std::size_t>(overlap_.blocks.n_local()) * D * D);
    for (int k = 0; k < source_->n_blocks(); ++k)
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) at(k)[r * D + c] = static_cast<float>(K.at(k)[r * B + c]);
    overlap_.blocks.update_ghosts(values.data(), D * D);
  }

 private:
  std::shared_ptr<const Pattern> source_;
  OverlapPattern overlap_;
};

}  // namespace ifsi
