// On a flat sheet, however it is turned, the normal that a cell finds is the one that the law could have been
// told.
#include <gtest/gtest.h>

#include <cmath>

#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/solid/solid_cell.hpp"

namespace {
using namespace ifsi;
using Law = ThinSheet<NeoHookean>;
using Data = SolidCellData<Hex1, double>;
using Point = Vec<double, 3>;

template <class Formulation>
std::array<Point, 8> residual(const Data& data, const Point& normal) {
  const Law law(NeoHookean(Lame{1.3, 2.1}), normal, 0.05, 0.3);
  const SolidParameters<3> solid{.rho_s = 1.0, .rho_f = 0.0, .mu_f = 0.0, .mu_s = 0.0, .gravity = {}};
  std::array<Point, 8> R;
  SolidCell<Hex1, Law, Formulation, Cartesian, DefaultQuadrature<Hex1>, double>(data, law).residual(
      solid, [&](int a, const Point& R_a) { R[a] = R_a; });
  return R;
}

TEST(Sheet, FindsTheNormalOfACell) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Mat<double, 3> Q =
      Mat<double, 3>{c, 0, s, 0, 1, 0, -s, 0, c} * Mat<double, 3>{1, 0, 0, 0, c, -s, 0, s, c};
  Data data;
  const int signs[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int a = 0; a < 8; ++a) {
    data.X[a] = Q * Point{1.0 * signs[a][0], 0.8 * signs[a][1] + 0.2 * signs[a][0], 0.1 * signs[a][2]};
    for (int i = 0; i < 3; ++i) data.u[a][i] = 0.01 * std::sin(3.0 * a + 2.0 * i);
    data.v[a] = data.a[a] = Point::zero();
  }
  const auto found = residual<Sheet>(data, {1.0, 0.0, 0.0});  // which it must not use
  const auto told = residual<Displacement>(data, Q * Point{0.0, 0.0, 1.0});
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[a][i], told[a][i], 1e-13) << "node " << a;
}
}  // namespace
