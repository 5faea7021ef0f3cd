/// \file
/// A pack of W lanes does in each lane what a double does.

#include "ifsi/core/pack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ifsi/core/tensor.hpp"

namespace ifsi {
namespace {

template <class P>
class PackTest : public ::testing::Test {
 public:
  /// Positive numbers, different in every lane.
  static P sample(double start) {
    P p;
    for (int l = 0; l < P::lanes; ++l) p.set(l, start + 0.37 * l);
    return p;
  }
  /// Holds where `f` of packs equals `f` of the doubles in every lane, up to the rounding of fused
  /// operations.
  template <class F>
  static void expect_lanewise(F f) {
    const P a = sample(0.3), b = sample(1.7);
    const P r = f(a, b);
    for (int l = 0; l < P::lanes; ++l) EXPECT_NEAR(r[l], f(a[l], b[l]), 1e-15 * (1.0 + std::abs(r[l]))) << l;
  }
};

using Lanes = ::testing::Types<Pack<1>, Pack<2>, Pack<4>, Pack<8>>;
TYPED_TEST_SUITE(PackTest, Lanes);

TYPED_TEST(PackTest, BroadcastFillsEveryLane) {
  const TypeParam p = 2.5;
  for (int l = 0; l < TypeParam::lanes; ++l) EXPECT_EQ(p[l], 2.5);
}

TYPED_TEST(PackTest, ArithmeticIsLanewise) {
  this->expect_lanewise([](auto a, auto b) { return a + b; });
  this->expect_lanewise([](auto a, auto b) { return a - b; });
  this->expect_lanewise([](auto a, auto b) { return a * b; });
  this->expect_lanewise([](auto a, auto b) { return a / b; });
  this->expect_lanewise([](auto a, auto) { return -a; });
  this->expect_lanewise([](auto a, auto b) { return a += b; });
  this->expect_lanewise([](auto a, auto b) { return a -= b; });
  this->expect_lanewise([](auto a, auto b) { return a *= b; });
}

TYPED_TEST(PackTest, NumbersMixWithPacks) {
  this->expect_lanewise([](auto a, auto b) { return 2.0 * a + b / 3.0 - 1.0; });
}

TYPED_TEST(PackTest, FunctionsAreLanewise) {
  using std::exp, std::log, std::max, std::min, std::pow, std::sqrt;
  this->expect_lanewise([](auto a, auto) { return sqrt(a); });
  this->expect_lanewise([](auto a, auto) { return pow(a, 1.3); });
  this->expect_lanewise([](auto a, auto) { return log(a); });
  this->expect_lanewise([](auto a, auto) { return exp(a); });
}

TYPED_TEST(PackTest, MaxAndMinChooseInEachLane) {
  const TypeParam a = this->sample(0.0), middle = 0.9;
  for (int l = 0; l < TypeParam::lanes; ++l) {
    EXPECT_EQ(max(a, middle)[l], std::max(a[l], 0.9));
    EXPECT_EQ(min(a, middle)[l], std::min(a[l], 0.9));
  }
}

TYPED_TEST(PackTest, TransposeExchangesRowsAndLanes) {
  constexpr int W = TypeParam::lanes;
  TypeParam rows[W];
  for (int i = 0; i < W; ++i)
    for (int j = 0; j < W; ++j) rows[i].set(j, 10.0 * i + j);
  transpose(rows);
  for (int i = 0; i < W; ++i)
    for (int j = 0; j < W; ++j) EXPECT_EQ(rows[i][j], 10.0 * j + i);
}

TYPED_TEST(PackTest, TensorsOfPacksAreTensorsInEachLane) {
  Mat<TypeParam, 3> packed;
  for (int k = 0; k < 9; ++k) packed.data[k] = this->sample(k % 4 == 0 ? 5.0 : 0.1 * k);
  const Mat<TypeParam, 3> packed_inverse = inverse(packed);
  const TypeParam packed_det = det(packed);
  for (int l = 0; l < TypeParam::lanes; ++l) {
    Mat<double, 3> m;
    for (int k = 0; k < 9; ++k) m.data[k] = packed.data[k][l];
    EXPECT_NEAR(packed_det[l], det(m), 1e-12);
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(packed_inverse.data[k][l], inverse(m).data[k], 1e-14);
  }
}

}  // namespace
}  // namespace ifsi
