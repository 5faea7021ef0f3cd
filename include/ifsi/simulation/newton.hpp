#pragma once
/// \file
/// Newton's method for a system of a momentum and a mass block, each converged on its own.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <string>

#include "ifsi/io/parameters.hpp"
#include "ifsi/linalg/block_norms.hpp"

namespace ifsi {

struct NewtonOptions {
  /// Converged when each block's residual is below rtol times the size of the terms that cancel in it.
  double rtol = 1e-6;
  int max_iterations = 12;
  int max_halvings = 8;         ///< of an update that makes the residual grow
  double growth_allowed = 10.;  ///< impulsive starts grow at first: a strict descent test would stall there

  void declare(Parameters& params, const std::string& prefix = "newton.") {
    params.add(prefix + "rtol", rtol, "-", "residual of each block relative to its terms", {1e-14, 1e-1});
    params.add(prefix + "max_iterations", max_iterations, "-", "Newton iterations per step", {1, 1000});
  }
};

struct NewtonReport {
  int iterations = 0;
  int gmres = 0;  ///< linear iterations in all
  bool converged = false;
  BlockNorms residual;  ///< last residual relative to its terms
  std::string failure;  ///< what went wrong, empty when converged
};

/// What a time step reports: Newton's part, and how well the step followed its prediction.
struct StepReport : NewtonReport {
  StepReport(NewtonReport newton = {}) : NewtonReport(std::move(newton)) {}
  /// Largest distance between the predicted and the final position of a solid node over the tolerated one;
  /// 0 without solids. It measures the local error in time: the prediction is one order below the scheme.
  double change = 0.0;
};

/// What Newton needs of a system: residual norms relative to the size of their terms, a linear solve to
/// relative tolerances per block, and an update that can be taken back.
template <class S>
concept NonlinearSystem = requires(S& s, BlockNorms target, double factor) {
  { s.assemble_residual() } -> std::same_as<void>;        // at the present state
  { s.assemble_tangent() } -> std::same_as<void>;         // residual and tangent
  { s.relative_residual() } -> std::same_as<BlockNorms>;  // of the last residual
  {s.solve(target).converged};                            // update so that |R + K du| <= target |R|
  { s.apply_update(factor) } -> std::same_as<void>;       // state += factor * update
};

/// Runs Newton until both blocks converge. Never throws for lack of convergence: the report says what
/// happened. `watch` sees the report after each residual evaluation.
template <NonlinearSystem System>
NewtonReport newton(System& system, const NewtonOptions& options,
                    const std::function<void(const NewtonReport&)>& watch = {}) {
  NewtonReport report;
  double step = 1.0;
  int halvings = 0;
  BlockNorms before;
  for (;; ++report.iterations) {
    if (report.iterations > 0)
      system.assemble_residual();
    else
      system.assemble_tangent();
    const BlockNorms now = system.relative_residual();
    const bool grew = report.iterations > 0 &&
                      !(now.momentum <= options.growth_allowed * std::max(before.momentum, options.rtol) &&
                        now.mass <= options.growth_allowed * std::max(before.mass, options.rtol));
    if ((grew || !now.finite()) && report.iterations > 0 && halvings < options.max_halvings) {
      step *= 0.5, ++halvings;
      system.apply_update(-step);  // half of what was added last
      --report.iterations;
      continue;
    }
    report.residual = now;
    if (watch) watch(report);
    if (!now.finite()) return report.failure = "residual is not finite", report;
    // At least one iteration: a good prediction passes any test, and steps of predictions alone drift away.
    if (report.iterations > 0 && now.momentum <= options.rtol && now.mass <= options.rtol)
      return report.converged = true, report;
    if (now.momentum == 0.0 && now.mass == 0.0) return report.converged = true, report;
    if (report.iterations == options.max_iterations)
      return report.failure = "no convergence in " + std::to_string(report.iterations) + " iterations",
             report;

    // Solve no further than this iteration can use: to a tenth of rtol. A prediction that meets rtol by
    // itself is improved tenfold.
    const auto target = [&](double r) { return std::clamp(0.1 * options.rtol / r, 1e-10, 1e-1); };
    if (report.iterations > 0) system.assemble_tangent();
    const auto linear = system.solve(BlockNorms{target(now.momentum), target(now.mass)});
    report.gmres += linear.iterations;
    if (!linear.converged) return report.failure = "linear solver: " + linear.message, report;
    system.apply_update(1.0);
    before = now;
    step = 1.0, halvings = 0;
  }
}

}  // namespace ifsi
