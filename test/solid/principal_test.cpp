// Principal values against their invariants and closed forms.
#include "ifsi/solid/principal.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {
using namespace ifsi;

Mat<double, 3> symmetric(double xx, double yy, double zz, double xy, double yz, double xz) {
  return {xx, xy, xz, xy, yy, yz, xz, yz, zz};
}

TEST(PrincipalValues, DiagonalTensorsAreSorted) {
  EXPECT_EQ(principal_values(symmetric(1, 3, 2, 0, 0, 0)), (std::array<double, 3>{3, 2, 1}));
}

TEST(PrincipalValues, PureShear) {
  const auto s = principal_values(symmetric(0, 0, 0, 2, 0, 0));
  EXPECT_NEAR(s[0], 2, 1e-15);
  EXPECT_NEAR(s[1], 0, 1e-15);
  EXPECT_NEAR(s[2], -2, 1e-15);
}

TEST(PrincipalValues, InvariantsAreKept) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> d(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const double tiny = trial % 2 ? 1e-9 : 1;  // nearly diagonal tensors, too
    const auto a = symmetric(d(random), d(random), d(random), tiny * d(random), tiny * d(random), d(random));
    const auto s = principal_values(a);
    EXPECT_GE(s[0], s[1]);
    EXPECT_GE(s[1], s[2]);
    EXPECT_NEAR(s[0] + s[1] + s[2], trace(a), 1e-14);
    EXPECT_NEAR(s[0] * s[0] + s[1] * s[1] + s[2] * s[2], inner(a, a), 1e-13);
    EXPECT_NEAR(s[0] * s[1] * s[2], det(a), 1e-13);
  }
}
}  // namespace
