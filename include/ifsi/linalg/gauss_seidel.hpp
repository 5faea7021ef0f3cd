#pragma once
/// \file
/// Symmetric Gauss-Seidel accelerated by Chebyshev polynomials: an approximate inverse of a diffusive block
/// matrix.

#include <vector>

#include "ifsi/linalg/triangle.hpp"

namespace ifsi {

/// Factors w_1 .. w_n of x <- x + w_k M^-1 (b - A x) that keep the error in an interval [lowest, 1] of
/// eigenvalues of M^-1 A smallest: one over the zeros of a Chebyshev polynomial, which n make it 1 / T_n((1 +
/// lowest) / (1 - lowest)) at most (Golub, Varga 1961). As many as bring that below `error`. Both numbers lie
/// between 0 and 1.
[[nodiscard]] std::vector<float> chebyshev_weights(double lowest, double error);

/// M^-1 A of symmetric Gauss-Seidel, M = (D + L) D^-1 (D + U), has all eigenvalues in (0, 1] where A is
/// symmetric and positive definite, so that no mesh and no viscosity makes it diverge. Every rank has the
/// rows of its own nodes and of its ghosts and keeps what it finds at its own (restricted additive Schwarz
/// with one layer of overlap, Cai and Sarkis 1999); passes need no exchange.
template <int D>
class GaussSeidel {
 public:
  /// \param weights of the passes, one forward and one backward sweep each; at least one.
  explicit GaussSeidel(std::vector<float> weights = {1.0f}) : weights_(std::move(weights)) {}

  [[nodiscard]] int passes() const { return static_cast<int>(weights_.size()); }

  /// Collective. Takes the leading D x D part of each block of K. Throws Error(linear_solver) when a diagonal
  /// block is singular.
  template <int B>
  void update(const BlockCsr<B>& K) {
    A_.assign(K);
    scale();
  }
  /// Collective. x = what the passes make of zero on the owned nodes; both hold n_local * D numbers. b is
  /// lost, the ghosts of x mean nothing.
  void apply(float* b, float* x);

 private:
  void scale();
  void first_pass(float* b, float* x);
  void next_pass(const float* b, float* x, float weight);

  LocalBlocks<D> A_;
  AlignedVector<float> inverse_;         ///< D_i^-1
  Triangle<D, Bfloat16> lower_, upper_;  ///< D^-1 L, D^-1 U
  AlignedVector<float> swept_;           ///< the last pass alone
  AlignedVector<float> above_;           ///< D^-1 U x of the result so far
  std::vector<float> weights_;
};

extern template class GaussSeidel<2>;
extern template class GaussSeidel<3>;

}  // namespace ifsi
