// Crosses of nodes against bending: what they cost, and that their forces belong to it.
#include "ifsi/solid/sheet_bending.hpp"

#include <gtest/gtest.h>

#include "support/eigen.hpp"

namespace {
using namespace ifsi;
using Point = SheetBending::Point;
using Cross = std::array<Point, SheetBending::n>;

const SheetBending::Nodes first_nodes{0, 1, 2, 3, 4};

/// A cross of a curved lattice, its arms unlike and not at right angles.
const Cross curved{Point{0.1, 0.0, 0.05}, Point{-0.9, 0.1, 0.3}, Point{1.3, -0.2, 0.4},
                   Point{-0.1, -0.7, -0.2}, Point{0.3, 0.8, -0.1}};

SheetBending one_cross(const Cross& X) {
  SheetBending sheet;
  sheet.add(first_nodes, X, {2.0, 0.7});
  return sheet;
}

/// Each node off by up to about a fifth of an arm.
Cross deformed(Cross x) {
  for (int a = 0; a < SheetBending::n; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] += 0.2 * std::sin(5.0 * a + 2.0 * i + 1.0);
  return x;
}
Cross moved_rigidly(Cross x) {
  const double c = std::cos(2.1), s = std::sin(2.1);
  const Mat<double, 3> Q =
      Mat<double, 3>{c, 0, s, 0, 1, 0, -s, 0, c} * Mat<double, 3>{1, 0, 0, 0, c, -s, 0, s, c};
  for (auto& p : x) p = Q * p + Point{3.0, -1.0, 0.5};
  return x;
}

TEST(SheetBending, IsAtRestUndeformedAndWhereverThatIsMovedTo) {
  const auto sheet = one_cross(curved);
  for (const Cross& x : {curved, moved_rigidly(curved)}) {
    const auto t = sheet.term(0, x);
    EXPECT_NEAR(t.energy, 0.0, 1e-28);
    for (const Point& R : t.R)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(R[i], 0.0, 1e-14);
  }
  const Cross x = deformed(curved);
  EXPECT_GT(sheet.term(0, x).energy, 0.1);
  EXPECT_NEAR(sheet.term(0, moved_rigidly(x)).energy, sheet.term(0, x).energy, 1e-13);
}

// Of a symmetric sheet half of a cross has half of the energy and, on its nodes, half of the forces, but for
// the node whose image it knows: that has the image's as well.
TEST(SheetBending, AMirroredCrossIsHalfOfASymmetricOne) {
  const Point normal{0.6, 0.8, 0.0}, along{-0.8, 0.6, 0.0};
  const Mat<double, 3> image = Mat<double, 3>::identity() - 2.0 * outer(normal, normal);
  const auto symmetric_cross = [&](double bend) {
    const Point behind = 0.9 * normal + bend * along + Point{0.0, 0.0, 0.2 * bend};
    return Cross{Point::zero(), image * behind, behind, Point{0.0, 0.0, -0.8},
                 Point{0.0, 0.0, 1.1 + bend} + bend * along};
  };
  SheetBending whole, half;
  const Cross X = symmetric_cross(0.1), x = symmetric_cross(-0.3);
  whole.add(first_nodes, X, {2.0, 0.7});
  const auto known = [](Cross c) { return c[1] = c[2], c; };
  half.add_mirrored({0, 2, 2, 3, 4}, known(X), {2.0, 0.7}, normal);
  const auto a = whole.term(0, x), b = half.term(0, known(x));
  EXPECT_GT(a.energy, 0.01);
  EXPECT_NEAR(b.energy, 0.5 * a.energy, 1e-14);
  for (int i = 0; i < 3; ++i) {
    for (int k : {0, 3, 4}) EXPECT_NEAR(b.R[k][i], 0.5 * a.R[k][i], 1e-13);
    EXPECT_NEAR(b.R[1][i] + b.R[2][i], a.R[2][i], 1e-13);
  }
}

TEST(SheetBending, ForcesAreTheDerivativeOfTheEnergy) {
  const auto sheet = one_cross(curved);
  const Cross x = deformed(curved);
  const auto t = sheet.term(0, x);
  for (int a = 0; a < SheetBending::n; ++a)
    for (int i = 0; i < 3; ++i) {
      Cross more = x, less = x;
      more[a][i] += 1e-5, less[a][i] -= 1e-5;
      EXPECT_NEAR(t.R[a][i], (sheet.term(0, more).energy - sheet.term(0, less).energy) / 2e-5, 1e-8);
    }
}

TEST(SheetBending, ForcesBalance) {
  const Cross x = deformed(curved);
  const auto t = one_cross(curved).term(0, x);
  Point force{}, moment{};
  for (int a = 0; a < SheetBending::n; ++a) force += t.R[a], moment += cross(x[a], t.R[a]);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(force[i], 0.0, 1e-13);
    EXPECT_NEAR(moment[i], 0.0, 1e-13);
  }
}

TEST(SheetBending, SlopesAreTheDerivativeOfTheForcesAtRest) {
  const auto sheet = one_cross(curved);
  const Cross x = moved_rigidly(curved);
  const auto t = sheet.term(0, x);
  for (int b = 0; b < SheetBending::n; ++b)
    for (int j = 0; j < 3; ++j) {
      Cross more = x, less = x;
      more[b][j] += 1e-6, less[b][j] -= 1e-6;
      const auto R_more = sheet.term(0, more).R, R_less = sheet.term(0, less).R;
      for (int a = 0; a < SheetBending::n; ++a)
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(t.K[a * SheetBending::n + b](i, j), (R_more[a][i] - R_less[a][i]) / 2e-6, 1e-8);
    }
}

TEST(SheetBending, SlopesArePositiveSemiDefiniteAnywhere) {
  constexpr int m = 3 * SheetBending::n;
  const auto t = one_cross(curved).term(0, deformed(curved));
  Eigen::Matrix<double, m, m> K;
  for (int k = 0; k < m * m; ++k)
    K(k / m, k % m) = t.K[k / m / 3 * SheetBending::n + k % m / 3](k / m % 3, k % m % 3);
  EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
  const auto values = Eigen::SelfAdjointEigenSolver<decltype(K)>(K).eigenvalues();
  EXPECT_GT(values[0], -1e-12);
  EXPECT_GT(values[m - 1], 1.0);
}

/// Energy per area of a flat lattice of n x n spacings rolled to a cylinder of radius R along either line.
double rolled(int n, double R, int along, std::array<double, 2> B) {
  const double h = 1.0 / n;
  SheetBending sheet;
  double energy = 0.0;
  for (int i = 1; i < n; ++i)
    for (int j = 1; j < n; ++j) {
      const std::array<std::array<int, 2>, 5> places{
          {{i, j}, {i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}};
      Cross X, x;
      for (int a = 0; a < 5; ++a) {
        X[a] = {h * places[a][0], h * places[a][1], 0.0};
        const double angle = X[a][along] / R;
        x[a] = X[a];
        x[a][along] = R * std::sin(angle), x[a][2] = R * (1.0 - std::cos(angle));
      }
      sheet.add(first_nodes, X, B);
      energy += sheet.term(sheet.size() - 1, x).energy;
    }
  return energy / (sheet.size() * h * h);
}

TEST(SheetBending, ARolledSheetHoldsHalfTheStiffnessTimesCurvatureSquared) {
  constexpr double R = 0.6;
  const std::array<double, 2> B{2.0, 0.7};
  for (int along : {0, 1}) {
    const double exact = 0.5 * B[along] / (R * R);
    const double coarse = rolled(6, R, along, B) - exact, fine = rolled(12, R, along, B) - exact;
    const double cut_off = -exact / (6.0 * 144.0 * R * R);  // of the series of the cosine in (h / R)^2
    EXPECT_NEAR(fine, cut_off, 0.02 * std::abs(cut_off));
    EXPECT_NEAR(coarse / fine, 4.0, 0.1);
  }
}

// Second differences of parabolas are exact, however far apart the nodes are.
TEST(SheetBending, UnevenArmsMeasureTheSameCurvature) {
  const Cross X{Point{0, 0, 0}, Point{-0.7, 0, 0}, Point{1.3, 0, 0}, Point{0, -0.4, 0}, Point{0, 0.2, 0}};
  Cross x = X;
  for (auto& p : x) p[2] = 0.5 * (1.5 * p[0] * p[0] - 3.0 * p[1] * p[1]);
  const double area = 1.0 * 0.3;
  EXPECT_NEAR(one_cross(X).term(0, x).energy, 0.5 * area * (2.0 * 1.5 * 1.5 + 0.7 * 3.0 * 3.0), 1e-14);
}

TEST(SheetBending, RefusesLinesThatSpanNoArea) {
  Cross along_one_line = curved, coincident = curved;
  along_one_line[3] = curved[1], along_one_line[4] = curved[2];
  coincident[4] = coincident[0];
  for (const Cross& X : {along_one_line, coincident}) {
    try {
      one_cross(X);
      ADD_FAILURE() << "accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::file);
      EXPECT_NE(std::string(e.what()).find("span no area"), std::string::npos) << e.what();
    }
  }
}
}  // namespace
