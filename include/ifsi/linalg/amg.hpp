#pragma once
/// \file
/// Algebraic multigrid by hypre's BoomerAMG, as a preconditioner with a set-up that is kept.

#include <memory>
#include <span>
#include <string>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

struct AmgOptions {
  double strong_threshold = 0.5;  ///< 0.25 for scalar problems in the plane, 0.5 in space
  int aggressive_levels = 1;
  int cycles = 1;        ///< per application
  bool w_cycle = false;  ///< every level calls the next one twice
  int max_per_row = 4;   ///< entries kept per row of the interpolation
  /// Coarsens nodes (by the Frobenius norms of their blocks), not unknowns, where a node has several.
  bool nodal = false;
};

/// x ~ A^-1 b by V- or W-cycles from zero: HMIS coarsening, extended interpolation, l1-Gauss-Seidel forward
/// on the way down and backward on the way up. Several unknowns per node are separate functions ("unknown
/// approach").
class Amg {
 public:
  explicit Amg(AmgOptions options = {});
  ~Amg();
  Amg(Amg&&) noexcept;
  Amg& operator=(Amg&&) noexcept;

  /// Collective. Builds the hierarchy; entries that are exactly zero do not count as connections.
  /// Throws Error(linear_solver) when hypre reports one.
  template <int D>
  void setup(const BlockCsr<D>& A) {
    setup(A.pattern(), D, A.values);
  }
  void setup(const Pattern& pattern, int block, std::span<const double> values);

  /// Collective. b and x hold n_owned * block numbers; different arrays.
  void apply(const double* b, double* x) const;

  [[nodiscard]] bool ready() const;
  /// Levels and operator complexity, in one line. Collective.
  [[nodiscard]] std::string description() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ifsi
