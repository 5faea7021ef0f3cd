// Quantiles over volume: weights count, not the number of samples.
#include "ifsi/solid/volume_quantile.hpp"

#include <gtest/gtest.h>

namespace {
using ifsi::volume_quantile;

TEST(VolumeQuantile, IsTheSmallestValueThatThePartDoesNotExceed) {
  const std::vector<ifsi::VolumeSample> samples = {{3, 1}, {1, 2}, {2, 5}, {4, 2}};
  EXPECT_EQ(volume_quantile(samples, 0.0), 1);
  EXPECT_EQ(volume_quantile(samples, 0.2), 1);
  EXPECT_EQ(volume_quantile(samples, 0.21), 2);
  EXPECT_EQ(volume_quantile(samples, 0.7), 2);
  EXPECT_EQ(volume_quantile(samples, 0.75), 3);
  EXPECT_EQ(volume_quantile(samples, 1.0), 4);
}

TEST(VolumeQuantile, OfNothingIsZero) { EXPECT_EQ(volume_quantile({}, 0.99), 0); }
}  // namespace
