// Friction in narrow gaps: which gaps are found, what does not feel it, balance and derivatives of the
// forces.
#include "ifsi/coupling/surface_seal.hpp"

#include <gtest/gtest.h>

namespace {
using namespace ifsi;
using Point = Vec<double, 2>;

constexpr double seal_range = 0.4, resistance = 10.0;

/// Points 0, 1 of a body below, 2, 3 of one above, 4 far from all.
struct Surfaces {
  std::vector<Point> x = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.1}, {1.0, 0.3}, {0.1, 5.0}};
  SurfaceSeal<2> seal{
      {{0, 0, 2.0, x[0]}, {1, 0, 2.0, x[1]}, {2, 1, 1.0, x[2]}, {3, 1, 1.0, x[3]}, {4, 2, 1.0, x[4]}},
      seal_range,
      resistance};
};

TEST(SurfaceSeal, TapersWithoutJumps) {
  EXPECT_EQ(seal_taper(0.0), 1.0);
  EXPECT_EQ(seal_taper(0.5), 1.0);
  EXPECT_EQ(seal_taper(0.75), 0.5);
  EXPECT_EQ(seal_taper(1.0), 0.0);
  EXPECT_EQ(seal_taper(7.0), 0.0);
  EXPECT_LT(1.0 - seal_taper(0.501), 1e-4);
  EXPECT_LT(seal_taper(0.999), 1e-4);
}

TEST(SurfaceSeal, FindsTheMiddleOfTheNarrowestGap) {
  Surfaces s;
  const auto places = s.seal.find(s.x);
  ASSERT_EQ(places.size(), 5u);
  EXPECT_NEAR(places[0][1], 0.05, 1e-15);
  EXPECT_NEAR(places[2][1], 0.05, 1e-15);
  EXPECT_NEAR(places[3][1], 0.15, 1e-15);
  EXPECT_EQ(places[4], s.x[4]);  // nothing near
  ASSERT_EQ(s.seal.links().size(), 4u);
  EXPECT_EQ(s.seal.nodes(s.seal.links()[0], 100), (std::vector<int>{0, 2, 100}));
  EXPECT_NEAR(s.seal.links()[0].friction.coefficient, 0.5 * resistance * 2.0,
              1e-14);  // a gap of a quarter of the range
  EXPECT_NEAR(s.seal.links()[3].friction.coefficient, 0.5 * resistance * 0.5, 1e-14);  // of three quarters
}

TEST(SurfaceSeal, PointsOfOneBodyAndDistantOnesAreNoGap) {
  SurfaceSeal<2> seal({{0, 0, 1.0, {0.0, 0.0}}, {1, 0, 1.0, {0.0, 3.0}}, {2, 1, 1.0, {5.0, 0.0}}}, seal_range,
                      resistance);
  const std::vector<Point> x = {{0.0, 0.0}, {0.0, 0.1}, {0.4001, 0.0}};
  EXPECT_EQ(seal.find(x), x);
  EXPECT_TRUE(seal.links().empty());
}

TEST(SurfaceSeal, SeesTheImageInAMirror) {
  SurfaceSeal<2> seal({{0, 0, 1.0, {0.3, 0.1}}}, seal_range, resistance);
  seal.add_mirror({{0.0, 0.0}, {0.0, 1.0}, true});
  const std::vector<Point> x = {{0.3, 0.15}};  // 0.3 from its image
  EXPECT_EQ(seal.find(x)[0], (Point{0.3, 0.0}));
  ASSERT_EQ(seal.links().size(), 1u);
  EXPECT_EQ(seal.nodes(seal.links()[0], 1), (std::vector<int>{0, 1}));
  EXPECT_NEAR(seal.links()[0].friction.coefficient, 0.25 * resistance, 1e-14);
  const auto term = SurfaceSeal<2>::term(seal.links()[0], std::vector<Point>{{1.0, 5.0}, {3.0, 0.0}});
  EXPECT_NEAR(term.R[1][0], 0.25 * resistance * 2.0, 1e-14);
  EXPECT_EQ(term.R[1][1], 0.0);  // only along the plane
}

TEST(SurfaceSeal, LeavesOutWhatIsNotInTheFluid) {
  Surfaces s;
  s.seal.find(s.x);
  s.seal.keep_links([](int point) { return point != 0 && point != 3; });
  ASSERT_EQ(s.seal.links().size(), 2u);
  EXPECT_EQ(s.seal.links()[0].point, 1);
}

// Surfaces and fluid that move alike, as one linear field, feel nothing.
TEST(SurfaceSeal, NothingSlipsInALinearField) {
  Surfaces s;
  const auto places = s.seal.find(s.x);
  const Mat<double, 2> A{{0.3, -2.0, 1.1, 0.7}};
  const auto field = [&](const Point& x) { return A * x + Point{1.0, -2.0}; };
  for (const auto& link : s.seal.links()) {
    const auto term = SurfaceSeal<2>::term(
        link,
        std::vector<Point>{field(s.x[link.point]), field(s.x[link.partner]), field(places[link.point])});
    EXPECT_NEAR(term.power, 0.0, 1e-25);
    for (const auto& R : term.R) EXPECT_NEAR(dot(R, R), 0.0, 1e-25);
  }
}

TEST(SurfaceSeal, ForcesBalanceTakeEnergyAndAreLinear) {
  Surfaces s;
  s.seal.add_mirror({{0.0, -0.02}, {0.0, 1.0}, true});
  const auto places = s.seal.find(s.x);
  bool with_partner = false, with_image = false;
  for (const auto& link : s.seal.links()) {
    const auto nodes = s.seal.nodes(link, 5);
    const int n = static_cast<int>(nodes.size());
    (n == 3 ? with_partner : with_image) = true;
    std::vector<Point> v;
    for (int a = 0; a < n; ++a) v.push_back({1.0 + 3.0 * a * a, std::sin(2.0 + a)});
    const auto term = SurfaceSeal<2>::term(link, v);
    Point force = Point::zero();
    double moment = 0.0, power = 0.0;
    for (int a = 0; a < n; ++a) {
      const Point x = nodes[a] < 5 ? s.x[nodes[a]] : places[link.point];
      force += term.R[a];
      if (n == 3) moment += x[0] * term.R[a][1] - x[1] * term.R[a][0];
      power += dot(term.R[a], v[a]);
    }
    EXPECT_NEAR(dot(force, force), 0.0, 1e-25);
    EXPECT_NEAR(moment, 0.0, 1e-13);
    EXPECT_NEAR(power, term.power, 1e-12);
    EXPECT_GT(power, 0.0);
    for (int b = 0; b < n; ++b)
      for (int j = 0; j < 2; ++j) {
        auto moved = v;
        moved[b][j] += 0.5;
        const auto other = SurfaceSeal<2>::term(link, moved);
        for (int a = 0; a < n; ++a)
          for (int i = 0; i < 2; ++i)
            EXPECT_NEAR(other.R[a][i] - term.R[a][i], 0.5 * term.K[a * n + b](i, j), 1e-12);
      }
  }
  EXPECT_TRUE(with_partner);
  EXPECT_TRUE(with_image);
}
}  // namespace
