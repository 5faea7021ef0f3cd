#pragma once
/// \file
/// Solves the coupled flow system: picks a method, keeps set-ups as long as they pay.

#include <memory>
#include <span>
#include <string>

#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/gmres.hpp"
#include "ifsi/linalg/schur_parts.hpp"

namespace ifsi {

struct LinearSolverOptions {
  /// "auto": choose_method; "direct": LU of the whole matrix, kept and used as preconditioner while
  /// it pays; "gmres": GMRES with the block preconditioner.
  std::string method = "auto";
  std::string velocity = "auto";  ///< see SaddleOptions
  int max_iterations = 300;       ///< of one solve with a fresh set-up
  int restart = 60;
  bool enclosed = false;  ///< no boundary fixes the pressure level: constants are projected out
  bool reuse = true;      ///< false: renew the set-up in every solve
};

/// K = [A G; D L] with the unknowns (v, p) of a node side by side: B = dim + 1, the last row the mass
/// equation. Rows of prescribed unknowns are identity rows.
template <int B>
class LinearSolver {
 public:
  /// \param schur gives the parts of the Schur complement; without it only the direct method exists.
  /// Throws Error(configuration) for an unknown method.
  explicit LinearSolver(LinearSolverOptions options, SchurProvider schur = {});
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// Collective. Solves K x = rhs starting from the given x. Both hold n_local * B numbers; the ghosts of x
  /// are up to date afterwards. A block whose initial residual is next to nothing beside the other's
  /// (converted by the sizes of A and D) gets a thousandth of that as measure. Not converging is reported,
  /// not thrown; Error(linear_solver) tells of NaN in the right-hand side or a singular matrix.
  SolverReport solve(const BlockCsr<B>& K, std::span<const double> rhs, std::span<double> x,
                     const SolveTarget& target = {});
  SolverReport solve(const BlockCsr<B>& K, std::span<const double> rhs, std::span<double> x,
                     BlockNorms relative) {
    return solve(K, rhs, x, SolveTarget{relative, {}});
  }

  /// The set-up fits no longer (the time step changed, say): the next solve renews it.
  void invalidate();

  /// One line for the log: which method, and why. Known after the first solve.
  [[nodiscard]] std::string description() const;
  [[nodiscard]] long total_iterations() const;
  [[nodiscard]] long total_setups() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class LinearSolver<3>;
extern template class LinearSolver<4>;

}  // namespace ifsi
