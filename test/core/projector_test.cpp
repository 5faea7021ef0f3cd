#include "ifsi/core/projector.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ifsi {
namespace {

using V = Vec<double, 3>;
using M = Mat<double, 3>;

void expect_near(const M& a, const M& b, double tolerance) {
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(a.data[k], b.data[k], tolerance);
}

// What planes through a point leave free: a plane, a line whatever their angle, nothing.
TEST(Projector, PlanesTakeDirectionsAway) {
  const V n{0.6, 0.8, 0.0}, m{std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  M P = M::identity();
  remove_direction(P, n);
  expect_near(P, M::identity() - outer(n, n), 1e-15);
  remove_direction(P, -1.0 * n);
  remove_direction(P, n + V{1e-7, 0.0, 1e-7});  // the same plane but for round-off of its points
  expect_near(P, M::identity() - outer(n, n), 1e-15);
  remove_direction(P, m);
  V t{n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2], n[0] * m[1] - n[1] * m[0]};
  expect_near(P, (1.0 / dot(t, t)) * outer(t, t), 1e-15);
  remove_direction(P, V{0.0, 0.3, 1.0});
  EXPECT_EQ(P, M::zero());
}

TEST(Projector, OntoTheRangeOfAMatrix) {
  const V n{0.6, 0.8, 0.0};
  const M plane = M::identity() - outer(n, n);
  expect_near(projector_onto_range(0.3 * plane, 1e-3), plane, 1e-15);
  expect_near(projector_onto_range(0.3 * plane + 0.7 * M::identity(), 1e-3), M::identity(), 1e-15);
  expect_near(projector_onto_range(0.3 * outer(n, n), 1e-3), outer(n, n), 1e-15);
  EXPECT_EQ(projector_onto_range(1e-4 * plane, 1e-3), M::zero());
}

}  // namespace
}  // namespace ifsi
