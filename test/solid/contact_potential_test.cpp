// The repulsion of surfaces: derivatives, smoothness at the range, and the pressure between flat surfaces.
#include "ifsi/solid/contact_potential.hpp"

#include <gtest/gtest.h>

namespace {
using namespace ifsi;

template <class Phi>
void expect_derivatives(const Phi& phi) {
  constexpr double h = 1e-5;
  for (double r : {0.05, 0.2, 0.5, 0.79}) {
    EXPECT_NEAR(phi(r).slope, (phi(r + h).value - phi(r - h).value) / (2 * h), 1e-6 * std::abs(phi(r).slope));
    EXPECT_NEAR(phi(r).curvature, (phi(r + h).slope - phi(r - h).slope) / (2 * h), 1e-6 * phi(r).curvature);
    EXPECT_LT(phi(r).slope, 0.0);
  }
  const Potential end = phi(0.8 * (1 - 1e-5)), beyond = phi(0.8);
  EXPECT_NEAR(end.value, 0.0, 1e-12);
  EXPECT_NEAR(end.slope, 0.0, 1e-7);
  EXPECT_NEAR(end.curvature, 0.0, 3e-2);
  EXPECT_EQ(beyond.value, 0.0);
  EXPECT_EQ(beyond.slope, 0.0);
  EXPECT_EQ(beyond.curvature, 0.0);
}

TEST(ContactPotential, DerivativesAndSmoothEnd) {
  expect_derivatives([](double r) { return point_repulsion<2>(r, 0.8, 3.0); });
  expect_derivatives([](double r) { return point_repulsion<3>(r, 0.8, 3.0); });
  expect_derivatives([](double r) { return plane_repulsion(r, 0.8, 3.0); });
}

// (eq. 33): points spread over a plane, a thirtieth of the range apart, press on one above them.
TEST(ContactPotential, PressureBetweenFlatSurfaces) {
  constexpr double R = 0.8, h = R / 60, P = 3.0;
  const auto pressure = [&](double g, int dim) {
    double p = 0.0;
    for (int i = -60; i <= 60; ++i)
      for (int j = dim == 3 ? -60 : 0; j <= (dim == 3 ? 60 : 0); ++j) {
        const double r = std::sqrt(g * g + h * h * (i * i + j * j));
        p -= dim == 3 ? h * h * g / r * point_repulsion<3>(r, R, P).slope
                      : h * g / r * point_repulsion<2>(r, R, P).slope;
      }
    return p;
  };
  for (int dim : {2, 3}) EXPECT_NEAR(pressure(0.5 * R, dim), P, 1e-4 * P) << dim;
  for (double s : {0.1, 0.3, 0.8}) {
    const double q = std::sqrt(1 - s * s), unit = 3 * (std::sqrt(3.0) - std::acosh(2.0));
    EXPECT_NEAR(pressure(s * R, 3), 4 * P * std::pow(1 - s, 3) / s, 1e-3 * P);
    EXPECT_NEAR(pressure(s * R, 2), 2 * P / unit * (q / s + 2 * s * q - 3 * s * std::acosh(1 / s)), 1e-3 * P);
    EXPECT_NEAR(-plane_repulsion(s * R, R, P).slope, 4 * P * std::pow(1 - s, 3) / s, 1e-12);
  }
}
}  // namespace
