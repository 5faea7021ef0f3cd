// One contract for every solid law: the stress is the gradient of the energy, the tangent that of the stress,
// the frame does not matter, packs compute what scalars do.
#include <gtest/gtest.h>

#include <random>

#include "ifsi/core/pack.hpp"
#include "ifsi/material/materials.hpp"
#include "material/dual.hpp"

namespace {
using namespace ifsi;
using ifsi::testing::Dual;

template <class Law>
Law make();
template <>
NeoHookean make() {
  return NeoHookean(Lame{1.3, 2.1});
}
template <>
StVenantKirchhoff make() {
  return StVenantKirchhoff(Lame{1.3, 2.1});
}
template <>
UncoupledNeoHookean make() {
  return UncoupledNeoHookean(1.3, 7.0);
}
template <>
MooneyRivlin make() {
  return MooneyRivlin(0.4, 0.25, 7.0);
}
template <>
Yeoh make() {
  return Yeoh(0.65, 0.3, 0.8, 7.0);
}
template <>
CircumferentialFibre make() {
  return CircumferentialFibre(0.9, {0.2, -0.3});
}
template <>
TensionFibres<NeoHookean> make() {
  return {NeoHookean(Lame{1.3, 2.1}), 1.7, {0.6, 0.8, 0.0}, 20.0};
}

template <>
ThinSheet<NeoHookean> make() {
  return {NeoHookean(Lame{1.3, 2.1}), {0.6, 0.8, 0.0}, 0.3, 0.7};
}
template <>
ThinSheet<StVenantKirchhoff> make() {
  return {StVenantKirchhoff(Lame{1.3, 2.1}), {0.6, 0.8, 0.0}, 0.3, 0.7};
}

template <>
TensionFibres<ThinSheet<NeoHookean>> make() {
  return {make<ThinSheet<NeoHookean>>(), 1.7, {0.8, -0.6, 0.0}};
}

/// A law where F has n rows and points have dim coordinates.
template <class LawType, int n_, int dim_>
struct Case {
  using Law = LawType;
  static constexpr int n = n_, dim = dim_;
};

template <class C>
class LawContract : public ::testing::Test {
 protected:
  static constexpr int n = C::n, dim = C::dim;
  using Law = typename C::Law;
  using F_t = Mat<double, n>;
  Law law = make<Law>();
  Vec<double, dim> X = [] {
    Vec<double, dim> x{};
    for (int i = 0; i < dim; ++i) x[i] = 0.7 - 0.4 * i;
    return x;
  }();
  std::mt19937 random{7};

  /// A gradient with det F between 0.4 and 2, off identity by at most `size` in each entry.
  F_t some_F(double size = 0.35) {
    std::uniform_real_distribution<double> d(-size, size);
    for (;;) {
      F_t F = F_t::identity();
      for (double& f : F.data) f += d(random);
      if (det(F) > 0.4 && det(F) < 2) return F;
    }
  }
  static F_t some_rotation() {
    F_t Q = F_t::identity();
    const double c = std::cos(0.8), s = std::sin(0.8);
    Q(0, 0) = Q(1, 1) = c;
    Q(0, 1) = -s;
    Q(1, 0) = s;
    if constexpr (n == 3) {
      F_t R = F_t::identity();
      R(1, 1) = R(2, 2) = std::cos(-1.7);
      R(1, 2) = -std::sin(-1.7);
      R(2, 1) = std::sin(-1.7);
      Q = Q * R;
    }
    return Q;
  }
};

template <class T, int r, int c>
Mat<T, r, c> lifted(const Mat<double, r, c>& a) {
  Mat<T, r, c> m;
  for (int k = 0; k < r * c; ++k) m.data[k] = T(a.data[k]);
  return m;
}
template <class T, int n>
Vec<T, n> lifted(const Vec<double, n>& a) {
  Vec<T, n> v;
  for (int k = 0; k < n; ++k) v[k] = T(a[k]);
  return v;
}

using All = ::testing::Types<
    Case<NeoHookean, 2, 2>, Case<NeoHookean, 3, 3>, Case<NeoHookean, 3, 2>, Case<StVenantKirchhoff, 2, 2>,
    Case<StVenantKirchhoff, 3, 3>, Case<UncoupledNeoHookean, 2, 2>, Case<UncoupledNeoHookean, 3, 3>,
    Case<MooneyRivlin, 2, 2>, Case<MooneyRivlin, 3, 3>, Case<Yeoh, 2, 2>, Case<Yeoh, 3, 3>,
    Case<CircumferentialFibre, 2, 2>, Case<CircumferentialFibre, 3, 3>, Case<CircumferentialFibre, 3, 2>,
    Case<TensionFibres<NeoHookean>, 2, 2>, Case<TensionFibres<NeoHookean>, 3, 3>,
    Case<ThinSheet<NeoHookean>, 2, 2>, Case<ThinSheet<NeoHookean>, 3, 3>,
    Case<ThinSheet<StVenantKirchhoff>, 2, 2>, Case<TensionFibres<ThinSheet<NeoHookean>>, 3, 3>>;
TYPED_TEST_SUITE(LawContract, All);

TYPED_TEST(LawContract, ModelsTheConcept) { static_assert(SolidLaw<typename TypeParam::Law>); }

TYPED_TEST(LawContract, StressIsTheGradientOfTheEnergy) {
  constexpr int n = TypeParam::n;
  for (int trial = 0; trial < 20; ++trial) {
    const auto F = this->some_F();
    const auto P = this->law.first_piola(F, this->X);
    for (int k = 0; k < n * n; ++k) {
      auto F_dual = lifted<Dual<double>>(F);
      F_dual.data[k].slope = 1;
      EXPECT_NEAR(P.data[k], this->law.psi(F_dual, lifted<Dual<double>>(this->X)).slope, 1e-12);
    }
  }
}

TYPED_TEST(LawContract, TangentIsTheGradientOfTheStress) {
  constexpr int n = TypeParam::n;
  for (int trial = 0; trial < 20; ++trial) {
    const auto F = this->some_F();
    const auto A = this->law.tangent(F, this->X);
    for (int l = 0; l < n * n; ++l) {
      auto F_dual = lifted<Dual<double>>(F);
      F_dual.data[l].slope = 1;
      const auto P = this->law.first_piola(F_dual, lifted<Dual<double>>(this->X));
      for (int k = 0; k < n * n; ++k) EXPECT_NEAR(A(k, l), P.data[k].slope, 1e-11);
    }
  }
}

TYPED_TEST(LawContract, AgreesWithCentralDifferences) {
  constexpr int n = TypeParam::n;
  const auto F = this->some_F();
  const auto P = this->law.first_piola(F, this->X);
  const double h = 1e-6;
  for (int k = 0; k < n * n; ++k) {
    auto F_plus = F, F_minus = F;
    F_plus.data[k] += h;
    F_minus.data[k] -= h;
    const double slope = (this->law.psi(F_plus, this->X) - this->law.psi(F_minus, this->X)) / (2 * h);
    EXPECT_NEAR(P.data[k], slope, 1e-8);
  }
}

TYPED_TEST(LawContract, TheFrameDoesNotMatter) {
  const auto F = this->some_F(), Q = this->some_rotation();
  EXPECT_NEAR(this->law.psi(Q * F, this->X), this->law.psi(F, this->X), 1e-12);
  const auto P_rotated = this->law.first_piola(Q * F, this->X);
  const auto Q_P = Q * this->law.first_piola(F, this->X);
  for (int k = 0; k < TypeParam::n * TypeParam::n; ++k) EXPECT_NEAR(P_rotated.data[k], Q_P.data[k], 1e-12);
}

TYPED_TEST(LawContract, CauchyStressIsSymmetric) {
  const auto F = this->some_F();
  const auto tau = this->law.first_piola(F, this->X) * transpose(F);
  for (int i = 0; i < TypeParam::n; ++i)
    for (int j = 0; j < i; ++j) EXPECT_NEAR(tau(i, j), tau(j, i), 1e-13);
}

TYPED_TEST(LawContract, PacksComputeWhatScalarsDo) {
  constexpr int n = TypeParam::n, W = 4;
  Mat<Pack<W>, n> F_pack;
  std::array<Mat<double, n>, W> F;
  for (int l = 0; l < W; ++l) {
    F[l] = this->some_F();
    for (int k = 0; k < n * n; ++k) F_pack.data[k].set(l, F[l].data[k]);
  }
  const auto X = lifted<Pack<W>>(this->X);
  const Pack<W> psi = this->law.psi(F_pack, X);
  const auto P = this->law.first_piola(F_pack, X);
  const auto A = this->law.tangent(F_pack, X);
  for (int l = 0; l < W; ++l) {
    EXPECT_NEAR(psi[l], this->law.psi(F[l], this->X), 1e-13);
    const auto P_l = this->law.first_piola(F[l], this->X);
    const auto A_l = this->law.tangent(F[l], this->X);
    for (int k = 0; k < n * n; ++k) EXPECT_NEAR(P.data[k][l], P_l.data[k], 1e-13);
    for (int k = 0; k < n * n * n * n; ++k) EXPECT_NEAR(A.data[k][l], A_l.data[k], 1e-12);
  }
}

template <class Law>
class PlaneStrain : public ::testing::Test {};
using Laws = ::testing::Types<NeoHookean, StVenantKirchhoff, UncoupledNeoHookean, MooneyRivlin, Yeoh,
                              CircumferentialFibre>;
TYPED_TEST_SUITE(PlaneStrain, Laws);

TYPED_TEST(PlaneStrain, IsTheThreeDimensionalLawAtUnitThirdStretch) {
  const TypeParam law = make<TypeParam>();
  const Vec<double, 2> X = {0.4, 0.9};
  const Mat<double, 2> F = {1.2, 0.3, -0.2, 0.8};
  const Mat<double, 3> F3 = {1.2, 0.3, 0, -0.2, 0.8, 0, 0, 0, 1};
  EXPECT_NEAR(law.psi(F, X), law.psi(F3, X), 1e-14);
  const auto P = law.first_piola(F, X);
  const auto P3 = law.first_piola(F3, X);
  const auto A = law.tangent(F, X);
  const auto A3 = law.tangent(F3, X);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(P.data[i], P3(i / 2, i % 2), 1e-14);
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(A(i, j), A3(i / 2 * 3 + i % 2, j / 2 * 3 + j % 2), 1e-13);
  }
}

/// Stretched and bent, the sheet is in plane stress; sheared, it resists as it was told.
TEST(ThinSheet, IsInPlaneStress) {
  const Lame lame{1.3, 2.1};
  const double nu = 0.5 * lame.lambda / (lame.lambda + lame.mu), E = lame.young_modulus();
  const ThinSheet<NeoHookean> law(NeoHookean(lame), {0.0, 1.0, 0.0}, 0.02, 1.0);
  const Vec<double, 2> X = {0.0, 0.0};
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Mat<double, 2> F = Mat<double, 2>{c, -s, s, c} * Mat<double, 2>{1.25, 0.0, 0.0, 0.8};  // det F = 1
  const Vec<double, 2> N = {0.0, 1.0}, PN = law.first_piola(F, X) * N;
  EXPECT_NEAR(PN[0], 0.0, 1e-13);
  EXPECT_NEAR(PN[1], 0.0, 1e-13);
  EXPECT_GT(law.first_piola(F, X)(0, 0), 0.1);
  const auto A = law.tangent(Mat<double, 2>::identity(), X);
  EXPECT_NEAR(A(0, 0), E / (1.0 - nu * nu) + 1.0, 1e-12);
  EXPECT_NEAR(A(1, 1), 0.02, 1e-12);
  EXPECT_NEAR(A(1, 2), 0.02, 1e-12);
}

/// Newton's method for the director takes steps that would turn the sheet inside out, were they not limited.
TEST(ThinSheet, FindsItsThicknessAtLargeStretches) {
  const ThinSheet<NeoHookean> law(NeoHookean(Lame::from_young(1.0, 0.4)), {0.0, 0.0, 1.0}, 0.05, 0.3);
  const Vec<double, 3> X = {0.0, 0.0, 0.0}, N = {0.0, 0.0, 1.0};
  for (double stretch : {0.5, 1.5, 2.5}) {
    const Mat<double, 3> F = {stretch, 0.0, 0.0, 0.0, stretch, 0.0, 0.0, 0.0, 1.0 / (stretch * stretch)};
    const auto PN = law.first_piola(F, X) * N;
    EXPECT_NEAR(PN[2], 0.0, 1e-9) << stretch;
  }
}

/// Whatever the sheet's plane and the director do, no volume vanishes without bound on its energy.
TEST(ThinSheet, ResistsTheLossOfItsVolume) {
  const ThinSheet<NeoHookean> law(NeoHookean(Lame::from_young(1.0, 0.4)), {0.0, 0.0, 1.0}, 0.002, 0.1);
  const Vec<double, 3> X = {0.0, 0.0, 0.0};
  for (double J : {1e-2, 1e-4, 1e-6}) {
    const Mat<double, 3> F = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, J};
    EXPECT_NEAR(law.first_piola(F, X)(2, 2), -0.5 * 0.1 / J, 0.1);  // (eq. 29)
  }
}

TEST(ThinSheet, RefusesWhatIsNoSheet) {
  const NeoHookean law(Lame{1.3, 2.1});
  EXPECT_THROW(ThinSheet<NeoHookean>(law, {0.0, 2.0, 0.0}, 1.0, 1.0), Error);
  EXPECT_THROW(ThinSheet<NeoHookean>(law, {0.0, 1.0, 0.0}, 0.0, 1.0), Error);
}

template <class Law>
class Isotropic : public ::testing::Test {};
using IsotropicLaws =
    ::testing::Types<NeoHookean, StVenantKirchhoff, UncoupledNeoHookean, MooneyRivlin, Yeoh>;
TYPED_TEST_SUITE(Isotropic, IsotropicLaws);

/// At rest: no energy, no stress, and Hooke's tangent with the Young's modulus that the law reports.
TYPED_TEST(Isotropic, IsHookesLawAtRest) {
  const TypeParam law = make<TypeParam>();
  const auto I = Mat<double, 3>::identity();
  const Vec<double, 3> X = {0, 0, 0};
  EXPECT_NEAR(law.psi(I, X), 0, 1e-15);
  for (double p : law.first_piola(I, X).data) EXPECT_NEAR(p, 0, 1e-15);
  const auto A = law.tangent(I, X);
  const double mu = A(1, 1), lambda = A(0, 4);
  EXPECT_NEAR(mu, 1.3, 1e-13);
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J)
      for (int k = 0; k < 3; ++k)
        for (int L = 0; L < 3; ++L) {
          const double hooke =
              lambda * (i == J) * (k == L) + mu * ((i == k) * (J == L) + (i == L) * (J == k));
          EXPECT_NEAR(A(3 * i + J, 3 * k + L), hooke, 1e-13);
        }
  EXPECT_NEAR(law.young_modulus(), (Lame{mu, lambda}.young_modulus()), 1e-12);
}

TYPED_TEST(Isotropic, RigidRotationGivesNoStress) {
  const TypeParam law = make<TypeParam>();
  const double c = std::cos(2.0), s = std::sin(2.0);
  const Mat<double, 2> Q = {c, -s, s, c};
  for (double p : law.first_piola(Q, Vec<double, 2>{0, 0}).data) EXPECT_NEAR(p, 0, 1e-14);
}
}  // namespace
