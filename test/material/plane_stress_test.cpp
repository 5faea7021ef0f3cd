// A law in a surface: the director balances it, and the rest follows from the energy.
#include "ifsi/material/plane_stress.hpp"

#include <gtest/gtest.h>

#include "ifsi/material/materials.hpp"
#include "material/dual.hpp"

namespace {
using namespace ifsi;
using Slope = ifsi::testing::Dual<double>;
using Spatial = Vec<double, 3>;
using Gradient = Mat<double, 3>;

const Lame lame_of_sheet = Lame::from_young(1.3, 0.4);
const PlaneStress<NeoHookean> sheet_law{NeoHookean(lame_of_sheet)};
const Spatial X_sheet{0.0, 0.0, 0.0}, N_sheet{0.48, 0.6, 0.64}, A_sheet{0.8, -0.6, 0.0};
const Spatial along_sheet = (1.0 / std::sqrt(0.48 * 0.48 + 0.6 * 0.6)) * Spatial{0.6, -0.48, 0.0};

/// Stretches a, b along and across with a shear, turned; what happens along N counts for nothing.
Gradient stretched(double a, double b, double across_the_sheet = 1.0) {
  const Spatial across = cross(N_sheet, along_sheet);
  const Gradient F = outer(a * along_sheet + 0.2 * a * across, along_sheet) + outer(b * across, across) +
                     across_the_sheet * outer(N_sheet + 0.4 * along_sheet, N_sheet);
  const double c = std::cos(0.7), s = std::sin(0.7);
  return Gradient{c, 0, s, 0, 1, 0, -s, 0, c} * Gradient{1, 0, 0, 0, c, -s, 0, s, c} * F;
}

/// F with unit slope along entry k.
Mat<Slope, 3> with_slope(const Gradient& F, int k) {
  Mat<Slope, 3> F_dual;
  for (int l = 0; l < 9; ++l) F_dual.data[l] = Slope(F.data[l], l == k ? 1.0 : 0.0);
  return F_dual;
}
Vec<Slope, 3> constant(const Spatial& x) { return {Slope(x[0]), Slope(x[1]), Slope(x[2])}; }

template <class Law>
double normal_stress(const Law& matrix, const Gradient& F) {
  const Spatial PN = matrix.first_piola(PlaneStress(matrix).relaxed(F, X_sheet, N_sheet), X_sheet) * N_sheet;
  return std::sqrt(dot(PN, PN));
}

// What is left is the round-off of two terms of up to some hundreds.
TEST(PlaneStress, NothingPullsAcross) {
  for (double nu : {0.0, 0.3, 0.49})
    for (double a : {0.1, 0.5, 1.0, 2.5, 4.0})
      for (double b : {0.2, 1.0, 1.5, 4.0})
        EXPECT_NEAR(normal_stress(NeoHookean(Lame::from_young(1.3, nu)), stretched(a, b)), 0.0, 1e-11)
            << "nu " << nu << ", stretches " << a << " " << b;
  for (double a : {0.5, 1.4}) {
    EXPECT_NEAR(normal_stress(StVenantKirchhoff(lame_of_sheet), stretched(a, 1.0)), 0.0, 1e-12);
    EXPECT_NEAR(normal_stress(UncoupledNeoHookean(1.3, 7.0), stretched(a, 1.0)), 0.0, 1e-12);
  }
}

TEST(PlaneStress, TheDirectorIsOneOfLeastEnergyOnTheSideOfTheNormal) {
  const Gradient F = sheet_law.relaxed(stretched(1.5, 1.2), X_sheet, N_sheet);
  EXPECT_GT(det(F), 0.0);
  const double least = sheet_law.psi(F, X_sheet, N_sheet);
  for (int i = 0; i < 3; ++i)
    for (double size : {-0.05, 0.05}) {
      Spatial d{};
      d[i] = size;
      EXPECT_GT(NeoHookean(lame_of_sheet).psi(Gradient(F + outer(d, N_sheet)), X_sheet), least);
    }
}

TEST(PlaneStress, DoesNotDependOnWhatTheNormalIsTold) {
  const Gradient F = sheet_law.relaxed(stretched(1.5, 0.8), X_sheet, N_sheet),
                 other = sheet_law.relaxed(stretched(1.5, 0.8, -3.0), X_sheet, N_sheet);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(other.data[k], F.data[k], 1e-13);
}

/// Energy, stress and tangent of a law as functions of F alone, F being relaxed first.
template <class Law, class... Directions>
void expect_consistent(const Law& law, const Gradient& F, const Directions&... directions) {
  const Gradient F_d = law.relaxed(F, X_sheet, N_sheet), P = law.first_piola(F_d, X_sheet, directions...);
  const auto A = law.tangent(F_d, X_sheet, directions...);
  const auto X = constant(X_sheet);
  for (int l = 0; l < 9; ++l) {
    const auto F_l = law.relaxed(with_slope(F, l), X, constant(N_sheet));
    EXPECT_NEAR(law.psi(F_l, X, constant(directions)...).slope, P.data[l], 1e-12);
    const auto P_l = law.first_piola(F_l, X, constant(directions)...);
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(P_l.data[k].slope, A(k, l), 1e-11) << k << " " << l;
  }
}

TEST(PlaneStress, StressAndTangentAreDerivativesOfTheRelaxedEnergy) {
  for (double a : {0.6, 1.0, 2.2}) {
    expect_consistent(sheet_law, stretched(a, 1.3), N_sheet);
    expect_consistent(PlaneStress(UncoupledNeoHookean(1.3, 7.0)), stretched(a, 0.9), N_sheet);
  }
}

// Hooke's law of plane stress, and none against displacements and gradients across.
TEST(PlaneStress, IsHookesAtRest) {
  const double E = 1.3, nu = 0.4;
  const Spatial e3{0.0, 0.0, 1.0};
  const auto I = Gradient::identity();
  EXPECT_NEAR(sheet_law.psi(sheet_law.relaxed(I, X_sheet, e3), X_sheet, e3), 0.0, 1e-15);
  const auto A = sheet_law.tangent(sheet_law.relaxed(I, X_sheet, e3), X_sheet, e3);
  EXPECT_NEAR(A(0, 0), E / (1.0 - nu * nu), 1e-13);
  EXPECT_NEAR(A(0, 4), nu * E / (1.0 - nu * nu), 1e-13);
  EXPECT_NEAR(A(1, 1), 0.5 * E / (1.0 + nu), 1e-13);
  EXPECT_NEAR(A(0, 0) - A(0, 4) * A(4, 0) / A(4, 4), sheet_law.young_modulus(), 1e-13);
  for (int k = 0; k < 9; ++k)
    for (int across : {2, 5, 6, 7, 8}) EXPECT_NEAR(A(k, across), 0.0, 1e-13) << k;
}

// Two families at right angles in a sheet: each pulls with its own modulus, and only if it is longer.
TEST(TensionFibresAcross, PullAlongTheirOwnDirection) {
  const Spatial N{0.0, 0.0, 1.0}, A{0.0, 1.0, 0.0};  // across: -e1
  const TensionFibres law(sheet_law, 5.0, A, 0.0, 0.7);
  const Gradient pulled{1.3, 0, 0, 0, 0.9, 0, 0, 0, 1}, pressed{0.8, 0, 0, 0, 1.2, 0, 0, 0, 1};
  for (const Gradient& F : {pulled, pressed}) {
    const Gradient F_d = law.relaxed(F, X_sheet, N);
    const Gradient fibres = law.first_piola(F_d, X_sheet, A, N) - sheet_law.first_piola(F_d, X_sheet, N);
    const auto stress = [](double modulus, double l) {
      return modulus * std::max(0.5 * (l * l - 1.0), 0.0) * l;
    };
    EXPECT_NEAR(fibres(0, 0), stress(0.7, F(0, 0)), 1e-14);
    EXPECT_NEAR(fibres(1, 1), stress(5.0, F(1, 1)), 1e-14);
    EXPECT_NEAR(inner(fibres, fibres), fibres(0, 0) * fibres(0, 0) + fibres(1, 1) * fibres(1, 1), 1e-13);
    const double e = std::max(0.5 * (F(0, 0) * F(0, 0) - 1.0), 0.0),
                 f = std::max(0.5 * (F(1, 1) * F(1, 1) - 1.0), 0.0);
    EXPECT_NEAR(law.psi(F_d, X_sheet, A, N) - sheet_law.psi(F_d, X_sheet, N),
                0.5 * (0.7 * e * e + 5.0 * f * f), 1e-14);
  }
}

TEST(TensionFibresAcross, StressAndTangentAreDerivativesOfTheEnergy) {
  const TensionFibres law(sheet_law, 5.0, A_sheet, 3.0, 0.7);
  for (double a : {0.8, 1.3})
    for (double b : {0.7, 1.2}) expect_consistent(law, stretched(a, b), along_sheet, N_sheet);
}

TEST(TensionFibresAcross, AreNoneWhereNoNormalIsKnown) {
  const NeoHookean matrix(lame_of_sheet);
  const TensionFibres with(matrix, 5.0, A_sheet, 0.0, 0.7), without(matrix, 5.0, A_sheet);
  EXPECT_EQ(with.first_piola(stretched(1.2, 1.4), X_sheet),
            without.first_piola(stretched(1.2, 1.4), X_sheet));
}

TEST(TensionFibresAcross, RefuseNegativeStiffness) {
  EXPECT_THROW(TensionFibres(sheet_law, 5.0, A_sheet, 0.0, -1.0), Error);
  EXPECT_THROW(TensionFibres(sheet_law, 5.0, A_sheet, 0.0, NAN), Error);
}

static_assert(SurfaceLaw<PlaneStress<NeoHookean>> && !FibredSurfaceLaw<PlaneStress<NeoHookean>>);
static_assert(FibredSurfaceLaw<TensionFibres<PlaneStress<NeoHookean>>>);
static_assert(!FibredSurfaceLaw<TensionFibres<NeoHookean>> && !SurfaceLaw<NeoHookean>);
}  // namespace
