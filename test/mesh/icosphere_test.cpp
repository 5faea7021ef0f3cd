#include "ifsi/mesh/icosphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ifsi {
namespace {

class Icosphere : public testing::TestWithParam<int> {};

TEST_P(Icosphere, HasTenPointsPerSquareOfTheFrequencyOnTheSphere) {
  const auto points = icosphere_points(0.25, GetParam());
  EXPECT_EQ(points.size(), 10u * GetParam() * GetParam() + 2u);
  for (const auto& x : points) EXPECT_NEAR(dot(x, x), 0.0625, 1e-15);
}

TEST_P(Icosphere, SpreadsThemEvenly) {
  const auto points = icosphere_points(0.25, GetParam());
  const double spacing = even_spacing(0.25, 10.0 * GetParam() * GetParam() + 2.0);
  EXPECT_EQ(icosphere_frequency(0.25, spacing), GetParam());
  for (const auto& x : points) {
    double nearest = 1.0;
    for (const auto& y : points)
      if (&x != &y) nearest = std::min(nearest, detail::distance(x, y));
    EXPECT_GT(nearest, 0.8 * spacing);
    EXPECT_LT(nearest, 1.2 * spacing);
  }
}

TEST_P(Icosphere, IsSymmetricToThePlanesOfTheCoordinates) {
  const auto points = icosphere_points(1.0, GetParam());
  for (int d = 0; d < 3; ++d)
    for (auto x : points) {
      x[d] = -x[d];
      EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                              [&](const auto& y) { return detail::distance(x, y) < 1e-12; }));
    }
}

INSTANTIATE_TEST_SUITE_P(Frequencies, Icosphere, testing::Values(1, 2, 3, 5));

}  // namespace
}  // namespace ifsi
