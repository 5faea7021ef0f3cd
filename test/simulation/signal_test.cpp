#include "ifsi/simulation/signal.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace ifsi {
namespace {

Signal sine(double dt, double phase) {
  Signal s;
  for (int k = 0; k * dt <= 3.0; ++k)
    s.add(k * dt, 2.0 + 5.0 * std::sin(2.0 * std::numbers::pi * (k * dt - phase)));
  return s;
}

// 20 samples in a period: the nearest one misses the top by up to 1.2 per cent, the parabola by 0.02.
TEST(SignalFigures, ExtremesAreThoseOfTheCurveNotOfTheSamples) {
  for (const double phase : {0.0, 0.01, 0.02, 0.025}) {
    const Signal s = sine(0.05, phase);
    EXPECT_NEAR(s.max().value, 7.0, 2e-3);
    EXPECT_NEAR(s.min(1.0).value, -3.0, 2e-3);
    EXPECT_GE(s.min(1.0).t, 1.0);
  }
}

TEST(SignalFigures, FrequencyAndMean) {
  const Signal s = sine(0.05, 0.013);
  EXPECT_NEAR(s.frequency(0.5), 1.0, 1e-3);
  EXPECT_NEAR(s.mean(0.0), 2.0, 0.1);
  EXPECT_EQ(s.last(), s.at(3.0));
}

// A window takes the noise of steps away and a known part of the curve; the ends, where it is cut, as well.
TEST(SignalFigures, WindowsTakeNoiseAway) {
  Signal noisy;
  const double dt = 0.01, width = 0.1, pi = std::numbers::pi;
  for (int k = 0; k <= 300; ++k)
    noisy.add(k * dt, 2.0 + 5.0 * std::sin(2.0 * pi * k * dt) + (k % 2 == 0 ? 0.8 : -0.8));
  const Signal smooth = noisy.averaged(width);
  const double kept = std::sin(pi * width) / (pi * width);
  EXPECT_NEAR(smooth.max().value, 2.0 + 5.0 * kept, 0.01);
  EXPECT_NEAR(smooth.min().value, 2.0 - 5.0 * kept, 0.01);
  EXPECT_NEAR(smooth.frequency(0.0), 1.0, 1e-3);
  EXPECT_NEAR(smooth.max(2.951).value, 0.0, 0.0);  // nothing there
  EXPECT_EQ(noisy.averaged(0.0).max().value, noisy.max().value);
}

// A large step, then a tiny one with a jump: the parabola through the three has its top far below all of
// them.
TEST(SignalFigures, UnequalStepsDoNotThrowTheExtremeAway) {
  Signal s;
  s.add(0.0, -194.0), s.add(0.01, -263.0), s.add(0.010625, -122.0);
  EXPECT_LE(s.min().value, -263.0);
  EXPECT_GE(s.min().value, -263.0 - 141.0 / 8.0);
  EXPECT_EQ(s.max().value, -122.0);
}

}  // namespace
}  // namespace ifsi
