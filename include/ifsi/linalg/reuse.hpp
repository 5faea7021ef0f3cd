#pragma once
/// \file
/// When to renew what is costly to set up and grows stale with use.

#include <algorithm>

namespace ifsi {

/// Keeps a set-up while it pays. Costs are counted in iterations of the solver that uses it. The first solve
/// after a renewal shows how many iterations a decade of residual takes when all is fresh; what later solves
/// need beyond that is the price of staleness. A renewal is due once that price adds up to the cost of one:
/// never more than twice what the best plan in hindsight would have paid. It is due at once after a solve of
/// more than `most` iterations of which a fifth is owed to staleness. Iteration counts decide, not clocks,
/// so that runs repeat.
class ReusePolicy {
 public:
  static constexpr int most = 25;  ///< iterations that a kept set-up should not take

  /// A new set-up that cost as much as `setup_cost` iterations.
  void renewed(double setup_cost) {
    setup_cost_ = setup_cost;
    surplus_ = 0;
    rate_ = 0;
    due_ = false;
  }
  /// A solve took this many iterations for this many decades of residual.
  void record(int iterations, double decades) {
    if (rate_ == 0 && decades > 0) rate_ = iterations / decades;
    surplus_ += std::max(0.0, iterations - expected(decades));
    due_ = due_ || surplus_ > setup_cost_ || (iterations > most && iterations > 1.25 * expected(decades));
  }
  /// Says from outside that the set-up fits no longer (another time step, a failed solve).
  void invalidate() { due_ = true; }
  [[nodiscard]] bool due() const { return due_; }
  /// Iterations after which a stale set-up is given up in the middle of a solve of so many decades.
  [[nodiscard]] int patience(double decades) const {
    return static_cast<int>(2 * expected(decades) + setup_cost_ + 10);
  }

 private:
  [[nodiscard]] double expected(double decades) const { return std::max(1.0, rate_ * decades); }

  double setup_cost_ = 0, surplus_ = 0;
  double rate_ = 0;  ///< iterations per decade when fresh; 0 until known
  bool due_ = true;
};

}  // namespace ifsi
