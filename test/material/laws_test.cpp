// Each law against closed forms, and the parameters it refuses.
#include <gtest/gtest.h>

#include "ifsi/material/materials.hpp"

namespace {
using namespace ifsi;

const Vec<double, 3> X0 = {0, 0, 0};
const Vec<double, 2> X0_plane = {0, 0};

Mat<double, 3> stretches(double a, double b, double c) { return {a, 0, 0, 0, b, 0, 0, 0, c}; }

TEST(NeoHookean, StretchByHand) {
  const NeoHookean law(Lame{2, 3});
  const auto P = law.first_piola(stretches(1.5, 1, 0.8), X0);
  const double ln_J = std::log(1.2);
  EXPECT_NEAR(P(0, 0), 2 * (1.5 - 1 / 1.5) + 3 * ln_J / 1.5, 1e-14);
  EXPECT_NEAR(P(1, 1), 3 * ln_J, 1e-14);
  EXPECT_NEAR(P(2, 2), 2 * (0.8 - 1 / 0.8) + 3 * ln_J / 0.8, 1e-14);
}

TEST(StVenantKirchhoff, StretchByHand) {
  const StVenantKirchhoff law(Lame{2, 3});
  const auto P = law.first_piola(stretches(1.5, 1, 1), X0);
  const double E = 0.5 * (1.5 * 1.5 - 1);
  EXPECT_NEAR(P(0, 0), 1.5 * (2 * 2 + 3) * E, 1e-14);
  EXPECT_NEAR(P(1, 1), 3 * E, 1e-14);
}

TEST(UncoupledNeoHookean, IsochoricStretchByHand) {
  const UncoupledNeoHookean law(2, 5);
  const double a = 1.44, b = 1 / 1.2;  // a b^2 = 1
  const auto tau = law.first_piola(stretches(a, b, b), X0) * stretches(a, b, b);
  const double third = (a * a + 2 * b * b) / 3;
  EXPECT_NEAR(tau(0, 0), 2 * (a * a - third), 1e-14);
  EXPECT_NEAR(tau(1, 1), 2 * (b * b - third), 1e-14);
}

TEST(UncoupledNeoHookean, DilatationByHand) {
  const UncoupledNeoHookean law(2, 5);
  const auto P = law.first_piola(stretches(1.1, 1.1, 1.1), X0);
  const double J = 1.331;
  EXPECT_NEAR(P(0, 0), 0.5 * 5 * (J - 1 / J) * J / 1.1, 1e-13);
}

TEST(MooneyRivlin, IsochoricStretchByHand) {
  const MooneyRivlin law(2, 3, 5);
  const double a = 1.44, b = 1 / 1.2;  // a b^2 = 1
  const auto tau = law.first_piola(stretches(a, b, b), X0) * stretches(a, b, b);
  const double difference = 2 * (2 + 3 * b * b) * (a * a - b * b);  // Rivlin: 2 (C10 + C01 / a) (a^2 - 1/a)
  EXPECT_NEAR(tau(0, 0) - tau(1, 1), difference, 1e-13);
  EXPECT_NEAR(trace(tau), 0, 1e-13);
}

TEST(Yeoh, EnergyByHand) {
  const Yeoh law(2, 3, 4, 5);
  const double x = 1.44 * 1.44 + 2 / 1.44 - 3;
  EXPECT_NEAR(law.psi(stretches(1.44, 1 / 1.2, 1 / 1.2), X0), 2 * x + 3 * x * x + 4 * x * x * x, 1e-13);
}

TEST(CircumferentialFibre, PullsAlongTheCircle) {
  const CircumferentialFibre law(3, {1, 1});
  const auto P = law.first_piola(Mat<double, 2>::identity(), Vec<double, 2>{1, 4});
  EXPECT_NEAR(P(0, 0), 3, 1e-15);
  for (int k = 1; k < 4; ++k) EXPECT_NEAR(P.data[k], 0, 1e-15);
}

void expect_configuration_error(void (*make)(), const std::string& word) {
  try {
    make();
    ADD_FAILURE() << "accepted; expected a complaint about " << word;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::configuration);
    EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
  }
}

TEST(Moduli, BadParametersAreNamed) {
  expect_configuration_error([] { Lame::from_young(1, 0.5); }, "nu = 0.5");
  expect_configuration_error([] { Lame::from_young(1, -1); }, "nu");
  expect_configuration_error([] { Lame::from_young(1, NAN); }, "nu");
  expect_configuration_error([] { Lame::from_young(-2, 0.3); }, "E = -2");
  expect_configuration_error([] { Lame::from_shear(-2, 0.3); }, "mu = -2");
  expect_configuration_error([] { NeoHookean(Lame{-1, 1}); }, "shear modulus mu");
  expect_configuration_error([] { NeoHookean(Lame{1, -1}); }, "bulk modulus");
  expect_configuration_error([] { StVenantKirchhoff(Lame{NAN, 1}); }, "shear modulus mu");
  expect_configuration_error([] { UncoupledNeoHookean(0, 1); }, "C0");
  expect_configuration_error([] { UncoupledNeoHookean(1, INFINITY); }, "kappa");
  expect_configuration_error([] { MooneyRivlin(1, -1, 1); }, "C10 + C01");
  expect_configuration_error([] { Yeoh(0, 1, 1, 1); }, "c1");
  expect_configuration_error([] { CircumferentialFibre(-1, {0, 0}); }, "mu");
}

TEST(Moduli, ConversionsAreConsistent) {
  const Lame lame = Lame::from_young(5.6e7, 0.4);
  EXPECT_NEAR(lame.mu, 2e7, 1e-6);
  EXPECT_NEAR(lame.lambda, 8e7, 1e-6);
  EXPECT_NEAR(lame.young_modulus(), 5.6e7, 1e-6);
  EXPECT_NEAR(Lame::from_shear(2e7, 0.4).lambda, 8e7, 1e-6);
  EXPECT_NEAR(young_modulus(lame.mu, lame.bulk_modulus()), 5.6e7, 1e-6);
}

/// The least that a law can be.
struct SmallestLaw {
  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>&) const {
    return inner(F, F);
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>&) const {
    return 2.0 * F;
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>&, const Vec<T, dim>&) const {
    return 2.0 * Tangent<T, n>::identity();
  }
  double young_modulus() const { return 1; }
};
struct LawWithoutTangent {
  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>&) const {
    return inner(F, F);
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>&) const {
    return 2.0 * F;
  }
  double young_modulus() const { return 1; }
};
static_assert(SolidLaw<SmallestLaw> && !UncoupledLaw<SmallestLaw> && !SolidLaw<LawWithoutTangent>);
static_assert(UncoupledLaw<UncoupledNeoHookean> && !UncoupledLaw<NeoHookean>);
}  // namespace
