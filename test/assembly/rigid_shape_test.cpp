// Volume, centroid and inertia of meshes against closed forms.
#include "ifsi/assembly/rigid_shape.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/ball.hpp"

namespace ifsi {
namespace {

template <class Element>
void expect_brick(const RigidShape<3>& shape, const Vec<double, 3>& sides) {
  const double volume = sides[0] * sides[1] * sides[2];
  EXPECT_NEAR(shape.volume, volume, 1e-13 * volume) << Element::name;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(shape.centre[i], 1.0 + 0.5 * sides[i], 1e-13);
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(shape.second_moments(i, j), i == j ? volume * sides[i] * sides[i] / 12.0 : 0.0, 1e-13);
  }
}

TEST(RigidShape, BrickIsExact) {
  const Vec<double, 3> sides{0.5, 1.0, 2.0}, upper{1.5, 2.0, 3.0};
  expect_brick<Hex1>(rigid_shape<Cartesian>(box<Hex1>({1.0, 1.0, 1.0}, upper, {2, 2, 3})), sides);
  expect_brick<Tet1>(rigid_shape<Cartesian>(box<Tet1>({1.0, 1.0, 1.0}, upper, {2, 2, 3})), sides);
}

TEST(RigidShape, BallTendsToTheTrueOne) {
  constexpr double pi = std::numbers::pi;
  double before = 1.0;
  for (int n : {4, 8}) {
    const auto mesh = ball<Hex1>({0.5, 0.3, n, n / 2});
    const auto shape = rigid_shape<Cartesian>(mesh);
    const double error = 1.0 - shape.volume / (pi / 6.0);
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 0.3 * before);  // second order
    before = error;
    EXPECT_NEAR(shape.second_moments(0, 0), shape.volume * 0.25 / 5.0, 2.0 * error * shape.volume * 0.05);
    for (const auto& x : boundary_points(mesh, 0)) EXPECT_NEAR(dot(x, x), 0.25, 1e-14);
  }
}

// Turned about the axis, half a disc is a ball; its centroid lies on the axis.
TEST(RigidShape, BodyOfRevolution) {
  const auto mesh = moved(ball<Quad1>({0.5, 0.3, 32, 8}, {true, false}), {0.0, 2.0});
  const auto shape = rigid_shape<Axisymmetric>(mesh);
  EXPECT_NEAR(shape.volume, std::numbers::pi / 6.0, 1e-3);
  EXPECT_EQ(shape.centre[0], 0.0);
  EXPECT_NEAR(shape.centre[1], 2.0, 1e-13);
}

}  // namespace
}  // namespace ifsi
