#include "ifsi/linalg/reuse.hpp"

#include <gtest/gtest.h>

namespace {
using ifsi::ReusePolicy;

TEST(ReusePolicy, StartsWithNothingToUse) { EXPECT_TRUE(ReusePolicy().due()); }

TEST(ReusePolicy, KeepsWhatDoesNotWearOut) {
  ReusePolicy policy;
  policy.renewed(10);
  for (int solve = 0; solve < 1000; ++solve) policy.record(12, 3);
  EXPECT_FALSE(policy.due());
}

TEST(ReusePolicy, RenewsWhenTheSurplusHasPaidForARenewal) {
  ReusePolicy policy;
  policy.renewed(10);
  policy.record(6, 3);  // two per decade
  for (int solve = 0; solve < 5; ++solve) {
    EXPECT_FALSE(policy.due());
    policy.record(8, 3);  // surplus 2
  }
  EXPECT_FALSE(policy.due());
  policy.record(8, 3);
  EXPECT_TRUE(policy.due());
  policy.renewed(10);
  EXPECT_FALSE(policy.due());
}

TEST(ReusePolicy, OneLongSolveIsEnoughUnlessAFreshSetUpTakesAsLong) {
  const auto due_after = [](int fresh, int kept) {
    ReusePolicy policy;
    policy.renewed(100);
    policy.record(fresh, 6), policy.record(kept, 6);
    return policy.due();
  };
  EXPECT_FALSE(due_after(15, 25));
  EXPECT_TRUE(due_after(15, 26));
  EXPECT_FALSE(due_after(24, 29));
}

TEST(ReusePolicy, ATighterSolveIsNoSurplus) {
  ReusePolicy policy;
  policy.renewed(1);
  policy.record(4, 2);
  policy.record(12, 6);
  EXPECT_FALSE(policy.due());
}

TEST(ReusePolicy, CanBeToldThatItIsStale) {
  ReusePolicy policy;
  policy.renewed(10);
  policy.invalidate();
  EXPECT_TRUE(policy.due());
}

TEST(ReusePolicy, PatienceGrowsWithWhatIsAskedFor) {
  ReusePolicy policy;
  policy.renewed(10);
  policy.record(6, 3);
  EXPECT_GE(policy.patience(3), 2 * 6);
  EXPECT_GT(policy.patience(9), policy.patience(3));
}
}  // namespace
