#pragma once
/// \file
/// Sparse LU by UMFPACK or MUMPS, with the symbolic analysis kept as long as the pattern stays.

#include <memory>
#include <span>
#include <string>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// A x = b by a pivoting LU; with several ranks matrix and vectors are gathered on root, and the work is done
/// there, or shared by all ranks.
/// Not for large 3D problems: fill grows like n^(4/3).
class DirectSolver {
 public:
  /// What the last factorisation cost.
  struct Cost {
    double flops = 0;         ///< of the factorisation
    double lu_entries = 0;    ///< numbers in L and U
    double memory_bytes = 0;  ///< peak
  };

  /// on_root: by UMFPACK. shared: by MUMPS, where it was found when ifsi was built, else on root.
  enum class Work { on_root, shared };

  explicit DirectSolver(Work work = Work::on_root);
  ~DirectSolver();
  DirectSolver(DirectSolver&&) noexcept;
  DirectSolver& operator=(DirectSolver&&) noexcept;

  /// Collective. Factors K; analyses it first when its pattern object is not that of the last call.
  /// \param pinned global number of a scalar unknown to be set to zero (its row is replaced), or -1: makes a
  /// matrix
  ///   regular whose null space is known.
  /// Throws Error(linear_solver) on all ranks when the matrix is singular or memory runs out.
  template <int B>
  void factor(const BlockCsr<B>& K, long pinned = -1) {
    factor(K.shared_pattern(), B, K.values, pinned);
  }
  void factor(std::shared_ptr<const Pattern> pattern, int block, std::span<const double> values, long pinned);

  /// Collective. x = A^-1 b on owned entries, by the last factorisation.
  void apply(const double* b, double* x) const;

  [[nodiscard]] bool ready() const;
  /// Which library, and where.
  [[nodiscard]] std::string method() const;
  [[nodiscard]] const Cost& cost() const;
  /// The factorisation in units of an application: measured as 20 ns per entry and 7 Gflop/s against 2.6 ns
  /// per entry and solve (2D 3k .. 200k unknowns: 16 to 32).
  [[nodiscard]] double setup_cost() const { return 8 + cost().flops / (18 * cost().lu_entries); }

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ifsi
