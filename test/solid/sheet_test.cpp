// In a flat cell, however it is turned, the normal or the direction of fibres that it finds is the one that
// the law could have been told.
#include <gtest/gtest.h>

#include <cmath>

#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/solid/solid_cell.hpp"

namespace {
using namespace ifsi;
using Data = SolidCellData<Hex1, double>;
using Point = Vec<double, 3>;

const NeoHookean matrix(Lame{1.3, 2.1});

template <class Formulation, class Law>
std::array<Point, 8> residual(const Data& data, const Law& law) {
  const SolidParameters<3> solid{.rho_s = 1.0, .rho_f = 0.0, .mu_f = 0.0, .mu_s = 0.0, .gravity = {}};
  std::array<Point, 8> R;
  SolidCell<Hex1, Law, Formulation, Cartesian, DefaultQuadrature<Hex1>, double>(data, law).residual(
      solid, [&](int a, const Point& R_a) { R[a] = R_a; });
  return R;
}

/// A sheared plate along the first two axes, turned by Q and deformed.
Data turned_cell(const Mat<double, 3>& Q) {
  Data data;
  const int signs[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int a = 0; a < 8; ++a) {
    data.X[a] = Q * Point{1.0 * signs[a][0], 0.8 * signs[a][1] + 0.2 * signs[a][0], 0.1 * signs[a][2]};
    for (int i = 0; i < 3; ++i) data.u[a][i] = 0.01 * std::sin(3.0 * a + 2.0 * i);
    data.v[a] = data.a[a] = Point::zero();
  }
  return data;
}

void expect_same(const std::array<Point, 8>& found, const std::array<Point, 8>& told) {
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[a][i], told[a][i], 1e-13) << "node " << a;
}

const double c = std::cos(0.7), s = std::sin(0.7);
const Mat<double, 3> Q =
    Mat<double, 3>{c, 0, s, 0, 1, 0, -s, 0, c} * Mat<double, 3>{1, 0, 0, 0, c, -s, 0, s, c};
const Point wrong = {1.0, 0.0, 0.0};  // which the cell must not use

TEST(Sheet, FindsTheNormalOfACell) {
  const Data data = turned_cell(Q);
  const auto law = [](const Point& normal) { return ThinSheet(matrix, normal, 0.05, 0.3); };
  expect_same(residual<Sheet>(data, law(wrong)), residual<Displacement>(data, law(Q * Point{0.0, 0.0, 1.0})));
}

TEST(Fibred, FindsTheFirstAxisOfACell) {
  const Data data = turned_cell(Q);
  const auto law = [](const Point& direction) { return TensionFibres(matrix, 5.0, direction); };
  const double length = std::hypot(1.0, 0.2);
  expect_same(residual<Fibred>(data, law(wrong)),
              residual<Displacement>(data, law(Q * Point{1.0 / length, 0.2 / length, 0.0})));
}

TEST(FibredSheet, FindsBoth) {
  const Data data = turned_cell(Q);
  const auto law = [](const Point& normal, const Point& direction) {
    return TensionFibres(ThinSheet(matrix, normal, 0.05, 0.3), 5.0, direction);
  };
  const double length = std::hypot(1.0, 0.2);
  expect_same(residual<FibredSheet>(data, law(wrong, wrong)),
              residual<Displacement>(
                  data, law(Q * Point{0.0, 0.0, 1.0}, Q * Point{1.0 / length, 0.2 / length, 0.0})));
}

// Fibres lie in the sheet: the director, which relaxes the matrix, does not stretch them.
TEST(FibredSheet, IsTheSumOfItsParts) {
  const Point N{0.6, 0.8, 0.0}, A{0.8, -0.6, 0.0};
  const ThinSheet sheet(matrix, N, 0.05, 0.3);
  const TensionFibres both(sheet, 5.0, A);
  const TensionFibres fibres(matrix, 5.0, A);
  const Mat<double, 3> F{1.2, 0.1, -0.2, 0.05, 0.9, 0.1, 0.15, 0.0, 1.1};
  const Mat<double, 3> sum =
      sheet.first_piola(F, wrong) + fibres.first_piola(F, wrong) - matrix.first_piola(F, wrong);
  const Mat<double, 3> P = both.first_piola(F, wrong);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(P.data[k], sum.data[k], 1e-13);
}

// Stretched along the fibres the law carries their stress, shortened only its matrix.
TEST(TensionFibres, AreSlackInCompression) {
  const TensionFibres law(matrix, 5.0, {1.0, 0.0, 0.0});
  for (const double stretch : {0.8, 1.3}) {
    Mat<double, 3> F = Mat<double, 3>::identity();
    F(0, 0) = stretch;
    const double fibres = law.first_piola(F, wrong)(0, 0) - matrix.first_piola(F, wrong)(0, 0);
    const double expected = stretch < 1.0 ? 0.0 : 0.5 * 5.0 * (stretch * stretch - 1.0) * stretch;
    EXPECT_NEAR(fibres, expected, 1e-14);
  }
}

TEST(TensionFibres, RefuseNegativeStiffness) {
  const Point A{1.0, 0.0, 0.0};
  EXPECT_THROW(TensionFibres(matrix, -5.0, A), Error);
  EXPECT_THROW(TensionFibres(matrix, 5.0, A, -1.0), Error);
}

// P = S lambda, S = E_f e exp(a e^2): at e = 0.345 and a = 4 by hand.
TEST(TensionFibres, Stiffen) {
  const TensionFibres law(matrix, 5.0, {1.0, 0.0, 0.0}, 4.0);
  Mat<double, 3> F = Mat<double, 3>::identity();
  F(0, 0) = 1.3;
  const double fibres = law.first_piola(F, wrong)(0, 0) - matrix.first_piola(F, wrong)(0, 0);
  EXPECT_NEAR(fibres, 5.0 * 0.345 * 1.3 * std::exp(4.0 * 0.119025), 1e-14);
}
}  // namespace
