#pragma once
/// \file
/// Cheap approximate inverses of a block matrix dominated by its mass: incomplete LU and Gauss-Seidel.

#include <vector>

#include "ifsi/linalg/local_blocks.hpp"

namespace ifsi {

/// Block ILU(0): L U has the pattern of A and agrees with A on it. Ranks do not see each other (block
/// Jacobi). Good as long as diffusion over a time step stays within a few cells; grows with the mesh beyond.
template <int D>
class BlockIlu {
 public:
  /// Factors the leading D x D part of each block of K. Throws Error(linear_solver) when a pivot block is
  /// singular.
  template <int B>
  void update(const BlockCsr<B>& K) {
    LU_.assign(K);
    factor();
  }
  /// x = (L U)^-1 b over the owned rows; b and x hold n_rows * D numbers and may be the same.
  void apply(const float* b, float* x) const;

 private:
  void factor();
  void eliminate_row(int i, std::vector<int>& position);

  LocalBlocks<D> LU_;  ///< L strictly below the diagonal (unit diagonal), U above, inverse pivots on it
};

extern template class BlockIlu<1>;
extern template class BlockIlu<2>;
extern template class BlockIlu<3>;

/// Symmetric block Gauss-Seidel sweeps. No factorisation: the set-up is a copy.
template <int D>
class BlockGaussSeidel {
 public:
  /// Throws Error(linear_solver) when a diagonal block is singular.
  template <int B>
  void update(const BlockCsr<B>& K) {
    A_.assign(K);
    invert_diagonals();
  }
  /// x = what one forward and one backward sweep make of x = 0. b and x are different arrays.
  void apply(const float* b, float* x) const;

 private:
  void invert_diagonals();

  LocalBlocks<D> A_;
  AlignedVector<float> inverse_;  ///< of the diagonal blocks
};

extern template class BlockGaussSeidel<1>;
extern template class BlockGaussSeidel<2>;
extern template class BlockGaussSeidel<3>;

}  // namespace ifsi
