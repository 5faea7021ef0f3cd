#include "ifsi/simulation/valve_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/scratch_folder.hpp"

namespace ifsi {
namespace {

constexpr double third = 2.0 * std::numbers::pi / 3.0;

std::vector<Vec<double, 3>> arc(double radius, double from, double to, int n) {
  std::vector<Vec<double, 3>> points;
  for (int k = 0; k <= n; ++k) {
    const double angle = from + (to - from) * k / n;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.1 * k});
  }
  return points;
}

TEST(OrificeArea, OfThreeArcsIsADisc) {
  double area = 0.0;
  for (int k = 0; k < 3; ++k)
    area += orifice_area(arc(1.2, (k - 0.49) * third, (k + 0.49) * third, 400), (k - 0.5) * third,
                         (k + 0.5) * third, 1.4);
  EXPECT_NEAR(area, std::numbers::pi * 1.44, 2e-4);
}

TEST(OrificeArea, OfASectorIsASixthAndEndsAtTheWall) {
  EXPECT_NEAR(6.0 * orifice_area(arc(1.2, 0.0, 0.5 * third, 200), 0.0, 0.5 * third, 1.4),
              std::numbers::pi * 1.44, 2e-4);
  EXPECT_NEAR(6.0 * orifice_area(arc(1.6, 0.0, 0.5 * third, 200), 0.0, 0.5 * third, 1.4),
              std::numbers::pi * 1.96, 2e-4);
}

/// A beat whose figures are known: flow and area rise and fall, the pressure difference is constant.
TEST(ValveCurves, FiguresOfABeatInClosedForm) {
  ValveCurves curves;
  constexpr int n = 4000;
  for (int k = 0; k <= n; ++k) {
    const double t = static_cast<double>(k) / n, s = std::sin(std::numbers::pi * t / 0.5);
    // Forward, back while the valve closes, a swing forward, a leak.
    const double flow = t < 0.5 ? 100.0 * s : t < 0.6 ? -20.0 : t < 0.65 ? 6.0 : t < 0.8 ? -8.0 : 0.0;
    curves.add({t, flow, t < 0.5 ? 1.0 + 2.0 * s : 1.0, (t < 0.5 ? 50.0 : 70.0) * std::abs(s),
                t < 0.5 ? 1000.0 : -5.0, 1e5 * t, 1.0 - 0.1 * s, -0.02 * t});
  }
  const auto f = curves.figures(1.1);
  EXPECT_EQ(f.goa_rest, 1.0);
  EXPECT_NEAR(f.goa_max, 3.0, 1e-6);
  EXPECT_NEAR(f.t_open, 0.5 / 6.0, 1e-4);  // the sine reaches a half at 30 degrees
  EXPECT_NEAR(f.t_close, 2.5 / 6.0, 1e-4);
  EXPECT_NEAR(f.t_turn, 0.5, 1e-3);
  EXPECT_NEAR(f.jet_peak, 50.0, 1e-4);
  EXPECT_NEAR(f.jet_closing, 70.0, 1e-4);
  EXPECT_NEAR(f.drop_mean, 1000.0, 1e-9);
  EXPECT_NEAR(f.drop_peak, 1000.0, 1e-12);
  EXPECT_NEAR(f.eoa, (100.0 / std::numbers::sqrt2) / std::sqrt(2.0 * 1000.0 / 1.1), 2e-3);
  EXPECT_NEAR(f.forward, 100.0 / std::numbers::pi, 1e-2);
  EXPECT_NEAR(f.closing, 2.0, 1e-2);
  EXPECT_NEAR(f.leak, 1.2 - 0.3, 1e-2);  // what swings forward is not lost
  EXPECT_NEAR(f.regurgitant_fraction(), 2.9 / 31.83, 1e-3);
  EXPECT_NEAR(f.s1_p99, 1e5, 1e-6);
  EXPECT_NEAR(f.det_F_min, 0.9, 1e-6);
  EXPECT_NEAR(f.volume_change, 0.02, 1e-12);
}

TEST(ValveCurves, AreReadBackFromTheirTable) {
  const test::ScratchFolder folder;
  ValveCurves written, read;
  {
    CsvFile table(folder.file("history.csv"), ValveCurves::columns());
    for (int k = 0; k < 9; ++k) {
      const ValveCurves::Sample s{0.1 * k, 3.0 * k,  1.0 + k,        7.0 * k,
                                  9.0 * k, 11.0 * k, 1.0 - 0.01 * k, 0.001 * k};
      if (k < 6) written.add(s);
      table.row(ValveCurves::row(s));
    }
  }
  read.read(folder.file("history.csv"), 0.5);
  const auto a = written.figures(1.0), b = read.figures(1.0);
  EXPECT_EQ(a.goa_max, b.goa_max);
  EXPECT_EQ(a.forward, b.forward);
  EXPECT_EQ(a.s1_p99, b.s1_p99);
  EXPECT_EQ(a.det_F_min, b.det_F_min);
  EXPECT_EQ(a.volume_change, b.volume_change);
}

}  // namespace
}  // namespace ifsi
