#pragma once
/// \file
/// Flexible GMRES with a stop test per block of equations (momentum, mass).

#include <functional>
#include <string>
#include <vector>

#include "ifsi/linalg/aligned.hpp"
#include "ifsi/linalg/block_norms.hpp"
#include "ifsi/linalg/layout.hpp"

namespace ifsi {

/// y = A x. Both arrays hold n_local * block numbers; owned entries of x are read, its ghosts may be
/// overwritten, owned entries of y are written.
using LinearMap = std::function<void(double* x, double* y)>;

/// Anything with apply(x, y) as a LinearMap; the object must outlive the map.
template <class T>
[[nodiscard]] LinearMap linear_map(T& object) {
  return [&object](double* x, double* y) { object.apply(x, y); };
}

/// What a linear solve says about itself. Norms are Euclidean, over all ranks.
struct SolverReport {
  int iterations = 0;
  BlockNorms initial;   ///< |b - A x| at the start
  BlockNorms residual;  ///< and at the end
  BlockNorms target;    ///< what it had to fall below
  bool converged = false;
  std::string message;  ///< why it did not converge; empty when it did
  /// Powers of ten between start and target, of the block that has further to go.
  [[nodiscard]] double decades() const;
};

/// How far to solve: a block of equations is done when its residual is below `relative` times its initial
/// norm, or below `absolute`, whichever is larger. A block whose initial residual is next to nothing beside
/// the other's is measured by a thousandth of that one instead, converted by GmresOptions::mass_per_momentum.
struct SolveTarget {
  BlockNorms relative{1e-6, 1e-6};
  BlockNorms absolute{};
};

struct GmresOptions {
  SolveTarget target;
  int max_iterations = 200;  ///< products with A in total, over all restarts
  int restart = 60;          ///< basis vectors kept before a restart
  int mass_component = -1;   ///< component of the block that is the mass equation; -1: all are momentum
  /// Size of the mass residual that goes with a unit momentum residual (units of one over the other).
  double mass_per_momentum = 1;
};

/// What a solve works in. Kept from one solve to the next it need not be asked of the system page by page
/// again.
struct GmresWorkspace {
  AlignedVector<double> residual, work;
  std::vector<AlignedVector<double>> basis, directions;
};

/// Solves A x = b from the given x by right-preconditioned flexible GMRES (Saad 1993): P may differ from step
/// to step. Each block of equations is divided by its target, so that the two count alike in what is
/// minimised: in one mixed norm the mass equation stays unsolved. Orthogonalisation: classical Gram-Schmidt,
/// repeated when cancellation asks for it. \param b, x  n_local * block numbers; x is the start and the
/// result. Collective. Throws Error(linear_solver) when the first residual is not finite; not converging, and
/// a preconditioner that gives NaN, are no errors here, only reported.
SolverReport fgmres(const Layout& layout, int block, const LinearMap& A, const LinearMap& preconditioner,
                    const double* b, double* x, const GmresOptions& options,
                    GmresWorkspace* workspace = nullptr);

}  // namespace ifsi
