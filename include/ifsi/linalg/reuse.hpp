#pragma once
/// \file
/// When to renew what is costly to set up and grows stale with use.

namespace ifsi {

/// Keeps a set-up while it pays. Costs are counted in iterations of the solver that uses it. The mean cost per
/// solve, set-up included, falls as long as solves are cheaper than that mean; the first solve that is dearer says
/// that a renewal is due (the replacement rule for machines that wear out). Iteration counts and a fixed set-up
/// cost decide, not clocks, so that runs repeat.
class ReusePolicy {
 public:
  /// A new set-up that cost as much as `setup_cost` iterations.
  void renewed(double setup_cost) {
    setup_cost_ = total_ = setup_cost;
    n_solves_ = 0;
    due_ = false;
  }
  /// A solve took this many iterations.
  void record(int iterations) {
    total_ += iterations;
    ++n_solves_;
    due_ = iterations > total_ / n_solves_;
  }
  /// Says from outside that the set-up fits no longer (another time step, a failed solve).
  void invalidate() { due_ = true; }
  [[nodiscard]] bool due() const { return due_; }
  /// Iterations after which a stale set-up is given up in the middle of a solve.
  [[nodiscard]] int patience() const { return static_cast<int>(setup_cost_) + 15; }

 private:
  double setup_cost_ = 0, total_ = 0;
  int n_solves_ = 0;
  bool due_ = true;
};

}  // namespace ifsi
