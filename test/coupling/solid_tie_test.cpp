// The tie of the fluid to a coarse solid: where its points are, what does not feel it, balance and
// derivatives of the forces.
#include "ifsi/coupling/solid_tie.hpp"

#include <gtest/gtest.h>

#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"

namespace {
using namespace ifsi;
using Point = Vec<double, 2>;

constexpr double tie_spacing = 0.7, tie_resistance = 20.0;

/// Two cells of a thin body, 0.03 x 0.2 each, in a fluid of cells 0.1: two spacings long.
struct CoarseSolid {
  Mesh<Quad1> fluid = distribute(box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {10, 10}), Communicator(MPI_COMM_SELF));
  GlobalMesh<Quad1> solid = box<Quad1>({0.5, 0.2}, {0.53, 0.6}, {1, 2});
  Interpolation<Quad1> C{fluid};
  SolidTie<2> tie{tie_spacing, tie_resistance};

  CoarseSolid() {
    C.locate(solid.points);
    tie.add_body<Quad1>(C, solid.cells, 0);
  }
  /// Positions of the nodes of a cell and its points.
  [[nodiscard]] std::vector<Point> places(int cell) {
    std::vector<Point> all = solid.points, chosen;
    for (const auto& x : tie.find(solid.points)) all.push_back(x);
    for (int a : tie.nodes(cell, solid.n_points())) chosen.push_back(all[a]);
    return chosen;
  }
};

TEST(SolidTie, PointsAreNoFurtherApartThanAsked) {
  CoarseSolid s;
  ASSERT_EQ(s.tie.n_cells(), 2);
  ASSERT_EQ(s.tie.n_points(), 6);  // 2 spacings in pieces of at most 0.7
  const auto x = s.tie.find(s.solid.points);
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(x[k][0], 0.515, 1e-14);
    EXPECT_NEAR(x[k][1], 0.2 + (k + 0.5) * 0.4 / 6.0, 1e-14);
  }
  EXPECT_EQ(s.tie.nodes(1, 100).size(), 7u);
  EXPECT_EQ(s.tie.nodes(1, 100)[4], 103);
}

TEST(SolidTie, FineCellsHaveNone) {
  CoarseSolid s;
  SolidTie<2> loose(2.1, tie_resistance);
  loose.add_body<Quad1>(s.C, s.solid.cells, 0);
  EXPECT_EQ(loose.n_points(), 0);
  // Nodes of order 2 lie half a cell apart.
  const auto fine = box<Quad2>({0.5, 0.2}, {0.53, 0.6}, {1, 4});
  s.C.locate(fine.points);
  SolidTie<2> of_order_2(tie_spacing, tie_resistance);
  of_order_2.add_body<Quad2>(s.C, fine.cells, 0);
  EXPECT_EQ(of_order_2.n_points(), 0);
}

TEST(SolidTie, CellsOutsideOfTheFluidHaveNone) {
  CoarseSolid s;
  auto moved = s.solid.points;
  for (auto& x : moved) x[1] += 0.6;  // the upper cell ends outside, and all of what is added below
  s.C.locate(moved);
  SolidTie<2> tie(tie_spacing, tie_resistance);
  tie.add_body<Quad1>(s.C, s.solid.cells, 0);
  EXPECT_EQ(tie.n_cells(), 2);
  EXPECT_NEAR(moved[tie.home(5)][1], 1.0, 1e-14);
  for (auto& x : moved) x[1] += 0.3;
  s.C.locate(moved);
  SolidTie<2> none(tie_spacing, tie_resistance);
  none.add_body<Quad1>(s.C, s.solid.cells, 0);
  EXPECT_EQ(none.n_points(), 0);
}

// A fluid that does what the solid's shape functions say feels nothing; where it slips as a whole, the
// friction is that of the volume.
TEST(SolidTie, OnlySlipIsResisted) {
  CoarseSolid s;
  const auto x = s.places(1);
  std::vector<Point> v;
  for (const auto& p : x) v.push_back({1.0 + 3.0 * p[0] - 2.0 * p[1], 5.0 * p[0] * p[1] - 2.0});
  std::vector<Point> R(v.size());
  EXPECT_NEAR(s.tie.add(1, v, R, {}), 0.0, 1e-25);
  for (const auto& r : R) EXPECT_NEAR(dot(r, r), 0.0, 1e-25);
  for (std::size_t k = 4; k < v.size(); ++k) v[k][0] += 0.5;
  constexpr double volume = 0.03 * 0.2;
  EXPECT_NEAR(s.tie.add(1, v, R, {}), tie_resistance * volume * 0.25, 1e-14);
}

TEST(SolidTie, ForcesBalanceTakeEnergyAndAreLinear) {
  CoarseSolid s;
  const auto x = s.places(0);
  const std::size_t n = x.size();
  std::vector<Point> v;
  for (std::size_t a = 0; a < n; ++a) v.push_back({1.0 + 0.3 * a * a, std::sin(2.0 + a)});
  std::vector<Point> R(n);
  std::vector<Mat<double, 2>> K(n * n, Mat<double, 2>::zero());
  const double taken = s.tie.add(0, v, R, K);
  Point force = Point::zero();
  double moment = 0.0, power = 0.0;
  for (std::size_t a = 0; a < n; ++a) {
    force += R[a];
    moment += x[a][0] * R[a][1] - x[a][1] * R[a][0];
    power += dot(R[a], v[a]);
  }
  EXPECT_NEAR(dot(force, force), 0.0, 1e-25);
  EXPECT_NEAR(moment, 0.0, 1e-13);
  EXPECT_NEAR(power, taken, 1e-12);
  EXPECT_GT(power, 0.0);
  for (std::size_t b = 0; b < n; ++b)
    for (int j = 0; j < 2; ++j) {
      auto moved = v;
      moved[b][j] += 0.5;
      std::vector<Point> other(n);
      s.tie.add(0, moved, other, {});
      for (std::size_t a = 0; a < n; ++a)
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(other[a][i] - R[a][i], 0.5 * K[a * n + b](i, j), 1e-12);
    }
}

TEST(SolidTie, PointsLeftOutFeelNothingUntilTheyAreFoundAgain) {
  CoarseSolid s;
  const auto power = [&] {
    std::vector<Point> v(7), R(7);
    v[4] = v[5] = {1.0, 0.0};
    return s.tie.add(0, v, R, {});
  };
  const double both = power();
  s.tie.leave_out(0);
  EXPECT_NEAR(power(), 0.5 * both, 1e-14);
  (void)s.tie.find(s.solid.points);
  EXPECT_EQ(power(), both);
}
}  // namespace
