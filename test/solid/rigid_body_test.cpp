// The motion of a rigid body: velocities, rotation, the balance of momentum and its tangent.
#include "ifsi/solid/rigid_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ifsi {
namespace {

using Body = RigidBody<3, Cartesian>;

RigidShape<3> brick() { return {2.0, {1.0, 2.0, 3.0}, {0.5, 0.1, 0.0, 0.1, 0.7, 0.2, 0.0, 0.2, 0.9}}; }
constexpr std::array<bool, 6> all{true, true, true, true, true, true};

TEST(RigidBody, PointsMoveWithTranslationAndRotation) {
  const auto P = RigidMotion<3, Cartesian>::velocity_at({1.0, -2.0, 0.5});
  const auto v = P * Vec<double, 6>{1.0, 2.0, 3.0, 0.1, 0.2, 0.3};  // V + omega x r
  EXPECT_NEAR(v[0], 1.0 + (0.2 * 0.5 - 0.3 * -2.0), 1e-15);
  EXPECT_NEAR(v[1], 2.0 + (0.3 * 1.0 - 0.1 * 0.5), 1e-15);
  EXPECT_NEAR(v[2], 3.0 + (0.1 * -2.0 - 0.2 * 1.0), 1e-15);
  const auto plane = RigidMotion<2, Cartesian>::velocity_at({3.0, 4.0}) * Vec<double, 3>{0.0, 0.0, 2.0};
  EXPECT_EQ(plane[0], -8.0);
  EXPECT_EQ(plane[1], 6.0);
  EXPECT_EQ((RigidMotion<2, Axisymmetric>::velocity_at({3.0, 4.0})(1, 0)), 1.0);
}

TEST(RigidBody, RotationsAreRotations) {
  const Vec<double, 3> theta{0.3, -1.1, 0.7};
  const auto Q = rotation(theta);
  EXPECT_NEAR(det(Q), 1.0, 1e-14);
  const auto QtQ = transpose(Q) * Q;
  const auto kept = Q * theta;  // the axis stays
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(kept[i], theta[i], 1e-14);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(QtQ(i, j), i == j, 1e-14);
  }
  const auto tiny = rotation(Vec<double, 3>{0.0, 0.0, 1e-6});
  EXPECT_NEAR(tiny(1, 0), 1e-6, 1e-18);
  EXPECT_NEAR(tiny(0, 0), 1.0 - 5e-13, 1e-16);
}

// A steady spin about z turns a point by exactly omega t, whatever the step.
TEST(RigidBody, SpinsByTheAngleOfItsRate) {
  Body body(brick(), 1.0, {0.0, 0.0, 0.0}, all);
  const double dt = 0.3, omega = 0.8;
  body.begin_steady();
  body.add(1.0, {0.0, 0.0, 0.0, 0.0, 0.0, omega});
  body.end_step();
  for (int k = 0; k < 10; ++k) {
    body.begin_step(GeneralizedAlpha::from_rho_inf(0.5), dt, false);
    body.end_step();
  }
  const double angle = 10 * dt * omega;
  EXPECT_NEAR(body.orientation()(0, 0), std::cos(angle), 1e-13);
  EXPECT_NEAR(body.orientation()(1, 0), std::sin(angle), 1e-13);
  EXPECT_NEAR(body.orientation()(2, 2), 1.0, 1e-13);
  EXPECT_NEAR(body.position()[0], 1.0, 1e-13);
}

// Free fall: backward Euler finds the acceleration, the second order scheme keeps to the parabola.
TEST(RigidBody, FallsFreely) {
  const double g = 9.81, m = 3.0 * 2.0;
  Body body(brick(), 3.0, {0.0, 0.0, -m * g}, all);
  const auto fall = [&](const GeneralizedAlpha& scheme, double dt) {
    body.begin_step(scheme, dt, false);
    const auto R = body.residual();
    EXPECT_NEAR(body.tangent()(2, 2), scheme.c_inertia(dt) * m, 1e-9 * scheme.c_inertia(dt));
    body.add(1.0, {0.0, 0.0, -R[2] / body.tangent()(2, 2), 0.0, 0.0, 0.0});
    EXPECT_NEAR(body.residual()[2], 0.0, 1e-6);
    body.end_step();
  };
  fall(GeneralizedAlpha::backward_euler(), 1e-7);
  for (int k = 0; k < 20; ++k) fall(GeneralizedAlpha::from_rho_inf(0.0), 0.05);
  EXPECT_NEAR(body.velocity()[2], -g, 1e-5);
  EXPECT_NEAR(body.position()[2], 3.0 - 0.5 * g, 1e-5);
}

// Moments, gyroscopic terms included: the tangent is the derivative of the residual.
TEST(RigidBody, TangentIsTheDerivative) {
  Body body(brick(), 1.5, {1.0, 2.0, 3.0}, all);
  body.begin_step(GeneralizedAlpha::from_rho_inf(0.5), 0.1, true);
  body.add(1.0, {0.1, 0.2, 0.3, 0.7, -0.4, 1.1});
  const auto K = body.tangent();
  for (int j = 0; j < 6; ++j) {
    auto step = Vec<double, 6>::zero();
    step[j] = 1e-5;
    body.add(1.0, step);
    const auto plus = body.residual();
    body.add(-2.0, step);
    const auto minus = body.residual();
    body.add(1.0, step);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR((plus[i] - minus[i]) / 2e-5, K(i, j), 1e-7) << i << ' ' << j;
  }
  EXPECT_GT(std::abs(K(3, 4) - K(4, 3)), 1e-2);  // the gyroscopic part is not symmetric
}

}  // namespace
}  // namespace ifsi
