#pragma once
/// \file
/// The march in time: step control with retry, progress, checkpoints, stop requests.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "ifsi/io/checkpoint.hpp"
#include "ifsi/io/mesh_checkpoint.hpp"
#include "ifsi/io/run.hpp"
#include "ifsi/simulation/newton.hpp"

namespace ifsi {

struct TimeOptions {
  double dt = 0.01, end = 1.0;
  double dt_min_factor = 1e-3;    ///< dt may be cut to this part of what was asked for
  double checkpoint_every = 0.0;  ///< time between checkpoints; 0: only when stopped
  bool adaptive = false;          ///< dt follows the change within a step
  double dt_max = 0.0;            ///< adaptive steps stay below; 0: ten times dt

  void declare(Parameters& params) {
    params.add("time.dt", dt, "time", "time step", positive);
    params.add("time.end", end, "time", "end of the run", positive);
    params.add("time.dt_min_factor", dt_min_factor, "-", "smallest step after cuts, as a part of dt",
               {1e-9, 1.0});
    params.add("time.checkpoint_every", checkpoint_every, "time",
               "time between checkpoints (0: only when stopped)", non_negative);
    params.add("time.adaptive", adaptive, "-", "dt follows the change within a step");
    params.add("time.dt_max", dt_max, "time", "largest adaptive step (0: ten times dt)", non_negative);
  }
};

/// Halves the step when one fails, doubles it back towards the one asked for after eight good ones. Adaptive
/// steps start from the one asked for and aim at half of the tolerated change.
class StepControl {
 public:
  explicit StepControl(const TimeOptions& time)
      : dt_(time.dt), nominal_(time.dt), min_(time.dt_min_factor * time.dt) {
    if (time.adaptive) max_ = time.dt_max > 0.0 ? time.dt_max : 10.0 * time.dt;
  }
  /// The next step, so that `end` is met exactly and no crumb is left before it.
  [[nodiscard]] double next(double t, double end) const {
    const double left = end - t;
    const double n = std::max(1.0, std::ceil(left / dt_ - 1e-6));
    return n > 2.0 ? dt_ : left / n;
  }
  /// \param dt of the step. \param change see StepReport.
  void accepted(double dt, double change) {
    ++good_;
    if (max_ > 0.0) return adapt(dt, change);
    if (good_ < 8 || dt_ == nominal_) return;
    dt_ = std::min(2.0 * dt_, nominal_);
    good_ = 0;
  }
  /// \throws Error (nonlinear) with the reason when the step is as small as allowed.
  void rejected(double t, const std::string& reason) {
    dt_ *= 0.5, good_ = 0, ++cuts_;
    if (dt_ < min_)
      throw Error(ExitCode::nonlinear, "the step from t = " + std::to_string(t) + " fails even at dt = " +
                                           std::to_string(2.0 * dt_) + ": " + reason);
  }
  [[nodiscard]] int cuts() const { return cuts_; }

  void save(CheckpointWriter& checkpoint) const {
    checkpoint.number("steps.asked", nominal_);
    checkpoint.number("steps.dt", dt_), checkpoint.number("steps.good", good_);
  }
  /// Goes on with the steps of the run that is continued, unless another time step is asked for now.
  void restore(const Checkpoint& checkpoint) {
    if (!checkpoint.has("steps.asked") || checkpoint.number("steps.asked") != nominal_) return;
    dt_ = checkpoint.number("steps.dt"), good_ = static_cast<int>(checkpoint.number("steps.good"));
    dt_ = std::min(dt_, max_ > 0.0 ? max_ : nominal_);
  }

 private:
  /// The change of a step is of third order in dt. A factorisation is worth a few steps: dt grows by no less
  /// than a quarter, and not right after a cut.
  void adapt(double dt, double change) {
    const double factor = std::cbrt(0.5 / std::max(change, 1e-6));
    if (factor < 1.0) dt_ = dt * std::max(factor, 0.5);
    if (factor < 1.25 || good_ < 4) return;
    dt_ = std::min(dt_ * std::min(factor, 2.0), max_);
    good_ = 0;
  }

  double dt_, nominal_, min_, max_ = 0.0;
  int good_ = 0, cuts_ = 0;
};

/// What a run with immersed bodies can know of its errors in time.
struct StepRecord {
  int steps = 0, rejected = 0;
  double largest_change = 0.0;  ///< of a step, over the tolerated one; 0: no bodies
  bool from_start = true;       ///< not continued from a checkpoint
};

/// Warnings of errors in time of more than 5 %, as they were seen (docs/stability.md) with changes of more
/// than 0.6, with one step in a hundred rejected (stiff solids, C frozen), and in runs of a few steps from an
/// impulsive start.
[[nodiscard]] inline std::vector<std::string> warnings_of(const StepRecord& record) {
  std::vector<std::string> warnings;
  if (record.largest_change > 0.6)
    warnings.push_back("the time step is coarse: solid nodes ended up to " +
                       std::to_string(record.largest_change) +
                       " of the tolerated distance from their prediction; take a smaller time.dt or "
                       "time.adaptive=true");
  if (100 * record.rejected > record.steps && record.largest_change > 0.0)
    warnings.push_back("steps rejected: " + std::to_string(record.rejected) +
                       ", accepted: " + std::to_string(record.steps) +
                       "; take a smaller time.dt or, for stiff solids, coupling.treatment=exact");
  if (record.from_start && record.steps < 20 && record.largest_change > 0.0)
    warnings.push_back("only " + std::to_string(record.steps) +
                       " time steps: those after a start or a sudden load are of first order in time.dt");
  return warnings;
}

/// A problem that steps in time: step(dt) leaves it unchanged when it does not converge.
template <class P>
concept TransientProblem = requires(P& p, CheckpointWriter& out, const Checkpoint& in) {
  { p.step(0.1) } -> std::convertible_to<StepReport>;
  { p.time() } -> std::convertible_to<double>;
  p.save(out);
  p.restore(in);
};

/// Marches to the end time. `observe(dt)` is called after each accepted step. A restarted run continues from
/// its checkpoint; a stop request writes one and ends the run with ExitCode::stopped.
template <TransientProblem Problem, class Observe>
void march(Run& run, Problem& problem, const TimeOptions& time, Observe&& observe) {
  StepControl control(time);
  if (run.restarted()) control.restore(Checkpoint(run.comm(), run.restart_file()));
  const auto save = [&] {
    CheckpointWriter checkpoint(run.comm());
    problem.save(checkpoint), control.save(checkpoint);
    return checkpoint.save(run.path(""), run.totals.steps);
  };
  StepRecord record{.from_start = !run.restarted()};
  double next_checkpoint = problem.time() + time.checkpoint_every;
  while (problem.time() < time.end * (1.0 - 1e-10)) {
    const double t = problem.time(), dt = control.next(t, time.end);
    const StepReport report = problem.step(dt);
    run.totals.newton += report.iterations;
    run.totals.gmres += report.gmres;
    if (!report.converged) {
      char line[200];
      std::snprintf(line, sizeof line, "step to t = %.6g rejected, dt %.3g is halved: %s", t + dt, dt,
                    report.failure.c_str());
      run.log(line);
      control.rejected(t, report.failure);
      ++record.rejected;
      continue;
    }
    control.accepted(dt, report.change);
    ++run.totals.steps, ++record.steps;
    record.largest_change = std::max(record.largest_change, report.change);
    observe(dt);
    char line[160];
    std::snprintf(line, sizeof line, "t %.5g  dt %.3g  newton %d  gmres %d  residual %.1e %.1e",
                  problem.time(), dt, report.iterations, report.gmres, report.residual.momentum,
                  report.residual.mass);
    run.progress(problem.time() / time.end, line);
    if (run.stop_requested())
      throw Error(ExitCode::stopped,
                  "stopped at t = " + std::to_string(problem.time()) + "; continue from " + save());
    if (time.checkpoint_every > 0.0 && problem.time() >= next_checkpoint) {
      save();
      next_checkpoint += time.checkpoint_every;
    }
  }
  if (record.largest_change > 0.0) run.metric("change_max", record.largest_change);
  for (const std::string& warning : warnings_of(record)) run.log("warning: " + warning);
}

}  // namespace ifsi
