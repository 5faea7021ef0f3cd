#pragma once
/// \file
/// Incomplete LU: a cheap approximate inverse of a block matrix dominated by its mass.

#include <vector>

#include "ifsi/linalg/triangle.hpp"

namespace ifsi {

/// Block ILU(0): L U has the pattern of A and agrees with A on it. Every rank factors the rows of its own
/// nodes and of its ghosts and keeps what it finds at its own (restricted additive Schwarz with one layer of
/// overlap, Cai and Sarkis 1999): ranks that do not see each other take up to a third more iterations. Good
/// as long as diffusion over a time step stays within a few cells; grows with the mesh beyond.
template <int D>
class BlockIlu {
 public:
  /// Collective. Factors the leading D x D part of each block of K. Throws Error(linear_solver) when a pivot
  /// block is singular.
  template <int B>
  void update(const BlockCsr<B>& K) {
    LU_.assign(K);
    factor();
  }
  void update(const LocalBlocks<D>& A) {
    LU_ = A;
    factor();
  }
  /// Collective. x = (L U)^-1 b on the owned nodes; both hold n_local * D numbers and may be the same. The
  /// ghosts of b are refreshed from their owners, those of x mean nothing.
  void apply(float* b, float* x) const;

 private:
  void factor();
  void eliminate_row(int i, std::vector<int>& position);

  /// Each row of L and U is multiplied by the inverse of its pivot D_i from the left, so that neither sweep
  /// has to wait for a product with the pivot: (L + D) D^-1 (D + U).
  LocalBlocks<D> LU_;
  AlignedVector<float> pivots_;  ///< D_i^-1
  Triangle<D, float> lower_, upper_;
};

/// ILU(0) applied several times, each time to what is left over. What diffuses over some cells in a time step
/// is reached in fewer iterations: half as many with two passes, a quarter fewer again with four. An even
/// number: after an odd one, parts with eigenvalues of (L U)^-1 A near two are left over with the sign
/// changed.
template <int D>
class RefinedIlu {
 public:
  /// All results but the last are multiplied by damping. With cells of order 2 (L U)^-1 A has eigenvalues
  /// beyond two, and what they belong to would grow.
  explicit RefinedIlu(int passes = 2, float damping = 1) : passes_(passes), damping_(damping) {}

  [[nodiscard]] int passes() const { return passes_; }

  /// Collective. Throws as BlockIlu does.
  template <int B>
  void update(const BlockCsr<B>& K) {
    A_.assign(K);
    ilu_.update(A_);
  }
  /// Collective. b and x as for BlockIlu, but different arrays; b is lost.
  void apply(float* b, float* x);

 private:
  void subtract_product_with(float* x, float* b) const;

  BlockIlu<D> ilu_;
  LocalBlocks<D> A_;
  int passes_;
  float damping_;
  AlignedVector<float> correction_;
};

extern template class BlockIlu<1>;
extern template class BlockIlu<2>;
extern template class BlockIlu<3>;

extern template class RefinedIlu<1>;
extern template class RefinedIlu<2>;
extern template class RefinedIlu<3>;

}  // namespace ifsi
