// Statics and dynamics of a solid alone, against exact solutions and the benchmarks of the literature.
#include "ifsi/simulation/solid_problem.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/simulation/solid_cases.hpp"

namespace {
using namespace ifsi;

template <class Body>
class MeanDilatationProblem : public ::testing::Test {};
using MeanDilatationBodies = ::testing::Types<SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation>,
                                              SolidBody<Hex1, UncoupledNeoHookean, MeanDilatation>,
                                              SolidBody<Wedge1, UncoupledNeoHookean, MeanDilatation>>;
TYPED_TEST_SUITE(MeanDilatationProblem, MeanDilatationBodies);

/// Patch test: boundary nodes moved linearly, Newton finds the linear displacement inside a distorted mesh.
TYPED_TEST(MeanDilatationProblem, PatchTest) {
  constexpr int dim = TypeParam::dim;
  using Element = typename TypeParam::Element;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> d(-0.06, 0.06);
  GlobalMesh<Element> mesh;
  if constexpr (dim == 2)
    mesh = box<Element>({0, 0}, {1, 1}, {3, 3});
  else
    mesh = box<Element>({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  std::vector<bool> inner;
  for (auto& X : mesh.points) {
    bool inside = true;
    for (double x : X.data) inside &= x > 1e-9 && x < 1 - 1e-9;
    inner.push_back(inside);
    for (double& x : X.data) x += inside ? d(random) : 0;
  }
  SolidProblem<TypeParam> problem(TypeParam("patch", mesh, UncoupledNeoHookean(1, 3), {}));
  const auto exact = [&](int node, int i) {
    double u = 0;
    for (int j = 0; j < dim; ++j) u += 0.2 * std::sin(5.0 * i + 3 * j + 1) * mesh.points[node][j];
    return u;
  };
  for (int a = 0; a < mesh.n_points(); ++a)
    for (int i = 0; i < dim; ++i)
      if (!inner[a]) problem.prescribe(a, i, exact(a, i));
  problem.solve_static();
  for (int a = 0; a < mesh.n_points(); ++a)
    for (int i = 0; i < dim; ++i) EXPECT_NEAR(problem.u()[a * dim + i], exact(a, i), 1e-10);
}

/// Displacement of the upper corner of Cook's membrane, nearly incompressible, plane strain.
template <class Body>
double cook(int n, int* iterations = nullptr) {
  constexpr int dim = Body::dim;
  SolidProblem<Body> problem(
      Body("cook", cook_membrane<typename Body::Element>(n), UncoupledNeoHookean(80.1938, 400942), {}));
  problem.clamp("left");
  if constexpr (dim == 3)
    for (int a = 0; a < problem.body().n_nodes(); ++a) problem.prescribe(a, 2, 0);
  Vec<double, dim> traction{}, corner{};
  traction[1] = 6.25;
  corner[0] = 48;
  corner[1] = 60;
  problem.add_traction("right", traction);
  problem.solve_static();
  if (iterations != nullptr) *iterations = problem.newton_iterations();
  return problem.displacement(problem.node_at(corner))[1];
}

TYPED_TEST(MeanDilatationProblem, CooksMembrane) {
  int iterations = 0;
  const double u = cook<TypeParam>(30, &iterations);
  EXPECT_NEAR(u, 6.88, 0.01);
  EXPECT_LE(iterations, 6) << "in one load step, thanks to the predicted pressure";
}

TEST(CooksMembrane, ConvergesToTheReference) {
  using Body = SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation>;
  const double u16 = cook<Body>(16), u32 = cook<Body>(32), u64 = cook<Body>(64);
  EXPECT_NEAR(u64, 6.929, 0.005 * 6.929);
  EXPECT_GT(u32, u16);
  EXPECT_GT(u64, u32);
  EXPECT_LT(u64 - u32, 0.6 * (u32 - u16));
}

TEST(CooksMembrane, PlainElementsLock) {
  const double u = cook<SolidBody<Quad1, UncoupledNeoHookean>>(30);
  EXPECT_LT(u, 4.8);
  EXPECT_GT(u, 1);
}

/// The tangent with the pressure predicted from the same state is the tangent.
TEST(RobustTangent, IsTheTangentWithoutAStep) {
  using Body = SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation>;
  const Body body("cook", cook_membrane<Quad1>(2), UncoupledNeoHookean(1, 10), {});
  std::vector<double> u(body.n_dofs()), plain, robust, off;
  for (int k = 0; k < body.n_dofs(); ++k) u[k] = 0.3 * std::sin(7.0 * k);
  const auto collect = [](std::vector<double>& to) {
    return [&to](int, std::span<const double>, std::span<const double> K) {
      to.insert(to.end(), K.begin(), K.end());
    };
  };
  body.residual_and_tangent({u}, {}, body.all_cells(), collect(plain));
  body.residual_and_robust_tangent({u}, u, {}, body.all_cells(), collect(robust));
  body.residual_and_robust_tangent({u}, std::vector<double>(u.size()), {}, body.all_cells(), collect(off));
  double difference = 0;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    EXPECT_NEAR(plain[k], robust[k], 1e-12);
    difference = std::max(difference, std::abs(plain[k] - off[k]));
  }
  EXPECT_GT(difference, 1e-3);
}

using Flag = SolidBody<Quad2, StVenantKirchhoff>;

/// The flag of Turek & Hron hanging in gravity.
struct FlagProblem : SolidProblem<Flag> {
  FlagProblem(int n_x, int n_y, double mu)
      : SolidProblem(Flag("flag", turek_hron_flag<Quad2>(n_x, n_y),
                          StVenantKirchhoff(Lame::from_shear(mu, 0.4)), {1000, 0, 0, 0, {0, -2}})) {
    clamp("left");
  }
  /// Displacement of the point A in mm.
  Vec<double, 2> tip() const { return 1e3 * displacement(node_at({0.6, 0.2})); }
};

TEST(TurekHron, CSM1) {
  FlagProblem flag(35, 2, 0.5e6);
  flag.solve_static();
  EXPECT_NEAR(flag.tip()[0], -7.187, 0.01 * 7.187);
  EXPECT_NEAR(flag.tip()[1], -66.10, 0.01 * 66.10);
  // the clamp carries the weight of 2 m/s2 x 1000 kg/m3 x the area up to the round root
  const double area = flag.totals().reference_volume;
  EXPECT_NEAR(area, 0.35 * 0.02 + 0.02 * 0.05 - (0.01 * std::sqrt(0.0024) + 0.0025 * std::asin(0.2)), 1e-6);
  EXPECT_NEAR(flag.reaction("left")[1], 2000 * area, 1e-4);
  EXPECT_NEAR(flag.reaction("left")[0], 0, 1e-4);
}

TEST(TurekHron, CSM2) {
  FlagProblem flag(35, 2, 2e6);
  flag.solve_static();
  EXPECT_NEAR(flag.tip()[0], -0.469, 0.01 * 0.469);
  EXPECT_NEAR(flag.tip()[1], -16.97, 0.01 * 16.97);
}

/// The flag let go: its tip swings by -63.6 +- 65.2 mm at 1.0995 Hz.
TEST(TurekHron, CSM3) {
  FlagProblem flag(20, 1, 0.5e6);
  const double dt = 0.02;
  const GeneralizedAlpha scheme = second_order_scheme(1);
  std::vector<double> y = {0};
  for (int i = 0; i < 100; ++i) {
    flag.step(dt, scheme);
    y.push_back(flag.tip()[1]);
  }
  std::vector<double> minima, times;  // of the parabola through three samples
  for (std::size_t i = 1; i + 1 < y.size(); ++i)
    if (y[i] < y[i - 1] && y[i] <= y[i + 1]) {
      const double slope = 0.5 * (y[i + 1] - y[i - 1]), curvature = y[i + 1] - 2 * y[i] + y[i - 1];
      minima.push_back(y[i] - 0.5 * slope * slope / curvature);
      times.push_back(dt * (static_cast<double>(i) - slope / curvature));
    }
  ASSERT_EQ(minima.size(), 2u);
  EXPECT_NEAR(minima[0], -63.607 - 65.160, 0.01 * 128.8);
  EXPECT_NEAR(1 / (times[1] - times[0]), 1.0995, 0.01 * 1.0995);
  EXPECT_NEAR(*std::max_element(y.begin() + 60, y.end()), -63.607 + 65.160, 0.02 * 65.2);
}

using Block = SolidBody<Hex1, NeoHookean>;
Block block(SolidParameters<3> p = {}) {
  return Block("block", box<Hex1>({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), NeoHookean(Lame{1, 1.5}), p);
}

/// A block drawn to 1.6 times its length between smooth plates: stretch and force by the law alone.
TEST(Block, UniaxialTension) {
  SolidProblem<Block> problem(block());
  problem.prescribe("left", 0, 0);
  problem.prescribe("right", 0, 0.6);
  problem.prescribe("bottom", 1, 0);
  problem.prescribe("front", 2, 0);
  problem.solve_static();
  const Vec<double, 3> corner = problem.displacement(problem.node_at({1, 1, 1}));
  EXPECT_NEAR(corner[1], corner[2], 1e-10);
  const Mat<double, 3> F = {1.6, 0, 0, 0, 1 + corner[1], 0, 0, 0, 1 + corner[2]};
  const auto P = problem.body().law().first_piola(F, Vec<double, 3>{});
  EXPECT_NEAR(P(1, 1), 0, 1e-8);
  EXPECT_LT(corner[1], -0.05);
  EXPECT_NEAR(problem.reaction("right")[0], P(0, 0), 1e-7);
}

/// The same block under water: all sides pressed, the volume follows from the law.
TEST(Block, HydrostaticPressure) {
  SolidProblem<Block> problem(block());
  problem.prescribe("left", 0, 0);
  problem.prescribe("bottom", 1, 0);
  problem.prescribe("front", 2, 0);
  for (const char* side : {"right", "top", "back"}) problem.add_pressure(side, 0.9);
  problem.solve_static();
  const double a = 1 + problem.displacement(problem.node_at({1, 1, 1}))[0];
  const auto P = problem.body().law().first_piola(a * Mat<double, 3>::identity(), Vec<double, 3>{});
  EXPECT_NEAR(P(0, 0), -0.9 * a * a, 1e-7);
  EXPECT_LT(a, 0.95);
  EXPECT_LE(problem.newton_iterations(), 7) << "the tangent of the follower load is consistent";
}

TEST(Block, FreeFallIsExact) {
  SolidParameters<3> p;
  p.gravity[2] = -9;
  SolidProblem<Block> problem(block(p));
  for (int i = 0; i < 10; ++i) problem.step(0.1, second_order_scheme(0.5));
  for (int k = 0; k < problem.body().n_dofs(); ++k) {
    EXPECT_NEAR(problem.u()[k], k % 3 == 2 ? -4.5 : 0, 1e-10);
    EXPECT_NEAR(problem.v()[k], k % 3 == 2 ? -9 : 0, 1e-10);
  }
  EXPECT_NEAR(problem.totals().momentum[2], -9, 1e-9);
}

/// A free block, spinning and pulsating: momentum is kept exactly, energy as far as rho_inf allows.
TEST(Block, MomentumAndEnergyOfFreeMotion) {
  double energy[2];
  for (int damped : {0, 1}) {
    SolidProblem<Block> problem(block());
    std::vector<double> v;
    for (const auto& X : problem.body().mesh().points)
      for (double s : {0.3 - 0.8 * (X[1] - 0.5), 0.8 * (X[0] - 0.5), 0.5 * (X[2] - 0.5)}) v.push_back(s);
    problem.set_initial(std::vector<double>(v.size()), v);
    const auto before = problem.totals();
    for (int i = 0; i < 200; ++i) problem.step(0.05, second_order_scheme(damped ? 0.0 : 1.0));
    const auto after = problem.totals();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(after.momentum[i], before.momentum[i], 1e-9);
    energy[damped] = (after.elastic_energy + after.kinetic_energy) / before.kinetic_energy;
  }
  EXPECT_NEAR(energy[0], 1, 0.01);
  EXPECT_LT(energy[1], energy[0]);
  EXPECT_GT(energy[1], 0.5);
}

/// First axial vibration of a bar held at one end: cos(w t) with w = pi/2 c/L; second order in time.
TEST(Bar, VibrationIsSecondOrderInTime) {
  const auto amplitude_error = [](int n_steps) {
    SolidParameters<2> p;
    const Lame lame{1, 0};  // no lateral contraction: a true one-dimensional wave, c^2 = 2 mu / rho
    SolidProblem<Flag> bar(Flag("bar", box<Quad2>({0, 0}, {1, 0.1}, {8, 1}), StVenantKirchhoff(lame), p));
    bar.prescribe("left", 0, 0);
    bar.prescribe("bottom", 1, 0);
    bar.prescribe("top", 1, 0);
    std::vector<double> u;
    for (const auto& X : bar.body().mesh().points) {
      u.push_back(1e-5 * std::sin(0.5 * M_PI * X[0]));
      u.push_back(0);
    }
    const std::vector<double> rest(u.size());
    bar.set_initial(u, rest);
    const double period = 4 / std::sqrt(2.0);
    for (int i = 0; i < n_steps; ++i) bar.step(1.2 * period / n_steps, second_order_scheme(0.8));
    return std::abs(bar.displacement(bar.node_at({1, 0}))[0] / 1e-5 - std::cos(2.4 * M_PI));
  };
  const double coarse = amplitude_error(20), fine = amplitude_error(40);
  EXPECT_LT(fine, 0.05);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
}

/// Lame's thick tube under inner pressure, small strain, as a body of revolution.
TEST(BodyOfRevolution, ThickTube) {
  using Tube = SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation, Axisymmetric>;
  // Small, but not so small that kappa (J - 1) is lost in round-off where there is no fused multiply-add.
  const double mu = 1, kappa = 500, p = 1e-4, a = 1, b = 2;
  SolidProblem<Tube> tube(
      Tube("tube", box<Quad1>({a, 0}, {b, 0.5}, {40, 4}), UncoupledNeoHookean(mu, kappa), {}));
  tube.prescribe("bottom", 1, 0);
  tube.prescribe("top", 1, 0);
  tube.add_pressure("left", p);
  tube.solve_static();
  const double lambda = kappa - 2 * mu / 3, C = p * a * a / (b * b - a * a);
  for (double r : {1.0, 1.5, 2.0}) {
    const double exact = C * r / (2 * (lambda + mu)) + C * b * b / (2 * mu * r);
    EXPECT_NEAR(tube.displacement(tube.node_at({r, 0}))[0], exact, 2e-3 * exact);
  }
  const auto fields = tube.body().fields(tube.u());
  const int node = tube.node_at({1.5, 0.25});
  EXPECT_NEAR(fields.cauchy[6 * node], C * (1 - b * b / 2.25), 0.02 * p);      // radial
  EXPECT_NEAR(fields.cauchy[6 * node + 2], C * (1 + b * b / 2.25), 0.02 * p);  // hoop
}

/// A thick shell under inner pressure: a sphere meshed in (r, z) from its equator to its pole.
TEST(BodyOfRevolution, ThickSphere) {
  using Shell = SolidBody<Quad2, NeoHookean, Displacement, Axisymmetric>;
  const double p = 1e-5, a = 1, b = 2;
  const Lame lame{1, 1.5};
  auto mesh = box<Quad2>({a, 0}, {b, 0.5 * M_PI}, {6, 8});
  for (auto& x : mesh.points) x = {x[0] * std::abs(std::cos(x[1])), x[0] * std::sin(x[1])};
  SolidProblem<Shell> shell(Shell("shell", mesh, NeoHookean(lame), {}));
  shell.prescribe("bottom", 1, 0);
  shell.prescribe("top", 0, 0);
  shell.add_pressure("left", p);
  shell.solve_static();
  const double C = p * a * a * a / (b * b * b - a * a * a);
  for (double r : {1.0, 1.5, 2.0}) {
    const double exact = C * (r / (3 * lame.bulk_modulus()) + b * b * b / (4 * lame.mu * r * r));
    EXPECT_NEAR(shell.displacement(shell.node_at({r, 0}))[0], exact, 2e-4 * exact);
    EXPECT_NEAR(shell.displacement(shell.node_at({0, r}))[1], exact, 2e-4 * exact);
  }
}

TEST(SolidProblem, FailureIsDiagnosed) {
  SolidParameters<2> p;
  SolidProblem<Flag> column(
      Flag("column", box<Quad2>({0, 0}, {1, 1}, {2, 2}), StVenantKirchhoff(Lame{1, 1}), p));
  column.clamp("bottom");
  column.add_traction("top", {0, -50});  // beyond what St Venant-Kirchhoff can bear
  try {
    column.solve_static();
    ADD_FAILURE() << "found an equilibrium";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::nonlinear);
    EXPECT_NE(std::string(e.what()).find("column"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("of the load"), std::string::npos) << e.what();
  }
}

TEST(SolidProblem, RefusesAnUnknownScheme) { EXPECT_THROW(second_order_scheme(1.5), Error); }
}  // namespace
