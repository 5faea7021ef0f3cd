// The coupled problem: its tangent, its constraint, its conservation, and the same answer on any number of
// ranks.
#include <gtest/gtest.h>

#include <random>

#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/balances.hpp"
#include "ifsi/simulation/fsi_case.hpp"
#include "ifsi/simulation/fsi_problem.hpp"

namespace ifsi {
namespace {

using Body = SolidBody<Quad1, NeoHookean>;

FsiOptions fsi_options(double rho_inf_solid, const std::string& treatment = "frozen") {
  FsiOptions options;
  options.rho_inf_solid = rho_inf_solid;
  options.treatment = treatment;
  return options;
}

std::vector<Body> leaflet(double rho_s = 1.5) {
  std::vector<Body> bodies;
  bodies.emplace_back(
      "leaflet", box<Quad1>({0.913, 0.0}, {1.013, 0.57}, {2, 12}), NeoHookean(Lame::from_young(2e3, 0.4)),
      Body::Parameters{.rho_s = rho_s, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});
  return bodies;
}

FlowBoundary<2> channel() {
  FlowBoundary<2> boundary;
  boundary.velocity("left", [](const auto& x, double t) {
    return Vec<double, 2>{std::min(1.0, 20.0 * t) * x[1] * (1.0 - x[1]), 0.0};
  });
  boundary.traction_free("right");
  boundary.no_slip("top"), boundary.no_slip("bottom");
  return boundary;
}

template <class Element>
struct ProbedIn : FsiProblem<Element, Body> {
  using Base = FsiProblem<Element, Body>;
  ProbedIn(const Mesh<Element>& mesh, const FlowOptions& flow, const FsiOptions& fsi,
           std::vector<Body> bodies = leaflet(), FlowBoundary<2> boundary = channel(), double mu = 0.1)
      : Base(mesh, std::move(boundary), 1.0, Newtonian{mu}, std::move(bodies), flow, fsi) {}
  using Base::R_, Base::k_p_;
  std::vector<double>& unknowns() { return this->state_.u; }
  void moved() { this->state_.update_rate(); }
  [[nodiscard]] const Constraints<3>& constraints() const { return this->system_.constraints(); }
};
using Probed = ProbedIn<Quad1>;

FlowOptions flow_options() {
  FlowOptions options;
  options.rho_inf = 0.0;
  options.newton.rtol = 1e-10;
  options.tau_dt = 1e6;  // the tangent leaves d tau out: make tau a constant of the metric
  return options;
}

Mesh<Quad1> channel_mesh(Communicator comm) {
  return distribute(box<Quad1>({0.0, 0.0}, {2.0, 1.0}, {20, 10}), comm);
}

// Newton converges quadratically only with the right tangent; a solve with the exact one leaves a residual of
// the order of the square of the step.
TEST(FsiProblem, NewtonConvergesQuadratically) {
  const auto mesh = channel_mesh(Communicator());
  Probed problem(mesh, flow_options(), fsi_options(0.0));
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(problem.step(0.01).converged);
  std::vector<double> residuals;
  problem.watch([&](const NewtonReport& r) { residuals.push_back(r.residual.momentum); });
  ASSERT_TRUE(problem.step(0.01).converged);
  ASSERT_GE(residuals.size(), 3u);
  EXPECT_LT(residuals.back(), 1e-10);
  EXPECT_LE(residuals.size(), 5u);
}

// At the end of a step the nodes of the solid move with the fluid, and their displacement is the integral of
// it.
TEST(FsiProblem, SolidNodesMoveWithTheFluid) {
  const auto mesh = channel_mesh(Communicator());
  for (const char* treatment : {"frozen", "updated", "exact"}) {
    Probed problem(mesh, flow_options(), fsi_options(0.0, treatment));
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(problem.step(0.01).converged);
      const std::vector<double> v(problem.state().velocity().begin(), problem.state().velocity().end());
      const auto v_f = problem.interpolation().velocities(v.data(), 3);
      double largest = 0.0;
      for (int a = 0; a < problem.solids().n_nodes(); ++a)
        for (int i = 0; i < 2; ++i) {
          EXPECT_NEAR(problem.solids().velocity()[2 * a + i], v_f[a][i], 1e-12);
          largest = std::max(largest, std::abs(v_f[a][i]));
        }
      EXPECT_GT(largest, 1e-4);  // it does move
    }
    EXPECT_NEAR(problem.solids().displacement(0)[0], 0.0, 1e-14);  // clamped by the wall's no-slip condition
    if (std::string(treatment) == "frozen") continue;
    for (int a = 0; a < problem.solids().n_nodes(); ++a)  // C is where the nodes are
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(problem.interpolation().positions()[a][i], problem.solids().positions()[a][i], 1e-12);
  }
}

TEST(FsiProblem, DoesNotDependOnTheRanks) {
  const auto alone = channel_mesh(Communicator(MPI_COMM_SELF)), shared = channel_mesh(Communicator());
  for (const char* treatment : {"frozen", "exact"}) {
    const FsiOptions fsi = fsi_options(0.0, treatment);
    Probed one(alone, flow_options(), fsi), all(shared, flow_options(), fsi);
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(one.step(0.01).converged);
      ASSERT_TRUE(all.step(0.01).converged);
    }
    for (std::size_t k = 0; k < one.solids().displacement().size(); ++k)
      EXPECT_NEAR(all.solids().displacement()[k], one.solids().displacement()[k], 1e-9);
  }
}

// A step that cannot converge leaves everything as it was.
TEST(FsiProblem, AFailedStepChangesNothing) {
  const auto mesh = channel_mesh(Communicator());
  FlowOptions options = flow_options();
  Probed problem(mesh, options, fsi_options(0.0));
  ASSERT_TRUE(problem.step(0.01).converged);
  const std::vector<double> u(problem.solids().displacement().begin(), problem.solids().displacement().end());
  const double t = problem.time();
  const NewtonReport report = problem.step(1e7);
  if (!report.converged) {
    EXPECT_FALSE(report.failure.empty());
    EXPECT_EQ(problem.time(), t);
    EXPECT_EQ(u, std::vector<double>(problem.solids().displacement().begin(),
                                     problem.solids().displacement().end()));
  }
  ASSERT_TRUE(problem.step(0.01).converged);
}

TEST(FsiProblem, ABodyOutsideIsRefused) {
  const auto mesh = channel_mesh(Communicator());
  auto bodies = leaflet();
  std::vector<Body> outside;
  outside.emplace_back("leaflet", box<Quad1>({1.9, 0.0}, {2.1, 0.6}, {2, 12}),
                       NeoHookean(Lame::from_young(2e3, 0.4)),
                       Body::Parameters{.rho_s = 1.0, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});
  using Problem = FsiProblem<Quad1, Body>;
  EXPECT_THROW(
      Problem(mesh, channel(), 1.0, Newtonian{0.1}, std::move(outside), flow_options(), fsi_options(0.0)),
      Error);
}

Body bar(const std::string& name, const Vec<double, 2>& lower, const Vec<double, 2>& upper) {
  return {name, box<Quad1>(lower, upper, {2, 12}), NeoHookean(Lame::from_young(2e3, 0.4)),
          Body::Parameters{.rho_s = 1.5, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}}};
}

// Two leaflets opposite each other in a symmetric flow move as mirror images; each has its own law and
// numbers.
// A node that left would be held outside for good: the step is cut instead.
TEST(FsiProblem, AStepThatTakesABodyOutIsRefused) {
  const auto mesh = channel_mesh(Communicator());
  std::vector<Body> bodies;
  bodies.emplace_back("drop", box<Quad1>({1.9, 0.4}, {1.98, 0.6}, {1, 3}),
                      NeoHookean(Lame::from_young(2e3, 0.4)), leaflet()[0].parameters);
  Probed problem(mesh, flow_options(), fsi_options(0.0), std::move(bodies));
  problem.start(0.0, [](const auto&) { return Vec<double, 2>{1.0, 0.0}; });
  const StepReport refused = problem.step(0.05);
  EXPECT_FALSE(refused.converged);
  EXPECT_NE(refused.failure.find("4 solid nodes are predicted to leave"), std::string::npos)
      << refused.failure;
  EXPECT_EQ(problem.solids().displacement(0)[0], 0.0);
}

TEST(FsiProblem, TwoBodiesMoveAsMirrorImages) {
  const auto mesh = channel_mesh(Communicator());
  std::vector<Body> pair;
  pair.push_back(bar("lower", {0.92, 0.0}, {0.98, 0.37}));
  pair.push_back(bar("upper", {0.92, 0.63}, {0.98, 1.0}));
  Probed problem(mesh, flow_options(), fsi_options(0.0), pair);
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(problem.step(0.01).converged);
  const auto& solids = problem.solids();
  double largest = 0.0;
  for (int a = 0; a < pair[0].n_nodes(); ++a) {
    const auto& X = pair[0].mesh().points[a];
    int mirrored = 0;
    while (std::abs(pair[1].mesh().points[mirrored][0] - X[0]) > 1e-9 ||
           std::abs(pair[1].mesh().points[mirrored][1] - (1.0 - X[1])) > 1e-9)
      ++mirrored;
    const auto u = solids.displacement(a), v = solids.displacement(solids.first_node(1) + mirrored);
    EXPECT_NEAR(u[0], v[0], 1e-7);
    EXPECT_NEAR(u[1], -v[1], 1e-7);
    largest = std::max(largest, std::abs(u[0]));
  }
  EXPECT_GT(largest, 1e-4);
}

TEST(FsiProblem, BodiesThatOverlapAreRefused) {
  const auto mesh = channel_mesh(Communicator());
  const auto refused = [&](Body one, Body other) {
    try {
      Probed(mesh, flow_options(), fsi_options(0.0), {std::move(one), std::move(other)});
      return std::string();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::configuration);
      return std::string(e.what());
    }
  };
  const std::string message =
      refused(bar("one", {0.9, 0.0}, {1.0, 0.6}), bar("other", {0.97, 0.0}, {1.07, 0.6}));
  EXPECT_NE(message.find("'other'"), std::string::npos) << message;
  EXPECT_NE(message.find("overlap at ("), std::string::npos) << message;
  EXPECT_NE(refused(bar("one", {0.9, 0.0}, {1.0, 0.6}), bar("same", {0.9, 0.0}, {1.0, 0.6})), "");
  EXPECT_EQ(refused(bar("one", {0.9, 0.0}, {1.0, 0.6}), bar("touches", {1.0, 0.0}, {1.1, 0.6})), "");
  EXPECT_EQ(refused(bar("one", {0.9, 0.0}, {1.0, 0.6}), bar("apart", {1.2, 0.0}, {1.3, 0.6})), "");
}

// At rest the fluid carries the mass it gives way to (eq. 27): the excess weight that the support feels, less
// the whole weight. A load on the surface of the body reaches the support as well.
TEST(FsiProblem, ForceOnABodyAtRestIsItsBuoyancy) {
  const auto mesh = channel_mesh(Communicator());
  std::vector<Body> body;
  body.push_back(bar("leaflet", {0.9, 0.0}, {1.0, 0.6}));
  body[0].parameters.gravity = {0.02, -0.3};
  body[0].add_load("right", {-0.005, 0.0});
  auto still = channel();
  still.no_slip("left");
  FlowOptions options = flow_options();
  options.newton.rtol = 1e-7;
  Probed problem(mesh, options, fsi_options(0.0), body, still);
  for (int k = 0; k < 60; ++k) {
    const NewtonReport report = problem.step(k < 20 ? 0.05 : 0.5);
    ASSERT_TRUE(report.converged) << k << " " << report.failure;
  }
  const double area = 0.06;
  const auto F = problem.force_with_bodies("bottom");
  EXPECT_NEAR(F[0], -1.0 * 0.02 * area - 0.005 * 0.6, 2e-6);
  EXPECT_NEAR(F[1], 1.0 * 0.3 * area, 2e-6);
}

/// Largest difference between the tangent of the coupled system and central differences of its residual along
/// some direction, over the largest entry. Only d tau_M / dv is left out; with a small step it does not show
/// beside the solid's stiffness.
template <class Element>
double tangent_error(ProbedIn<Element>& problem) {
  const auto& mesh = problem.mesh();
  problem.assemble_tangent();
  std::vector<double> direction(problem.unknowns().size(), 0.0);
  const auto x = mesh.node_coordinates();
  for (std::size_t node = 0; node < x.size(); ++node)
    for (int i = 0; i < 3; ++i) direction[node * 3 + i] = std::sin(7.0 * x[node][0] + 5.0 * x[node][1] + i);
  problem.constraints().project(mesh.n_nodes(), direction);
  const auto product = problem.tangent_times(direction);
  const auto residual_at = [&](double factor) {
    for (std::size_t k = 0; k < direction.size(); ++k) problem.unknowns()[k] += factor * direction[k];
    problem.moved();
    problem.assemble_residual();
    const std::vector<double> R = problem.R_;
    for (std::size_t k = 0; k < direction.size(); ++k) problem.unknowns()[k] -= factor * direction[k];
    problem.moved();
    return R;
  };
  const double eps = 1e-6;
  const auto plus = residual_at(eps), minus = residual_at(-eps);
  double error = 0.0, size = 0.0;
  for (int k = 0; k < mesh.n_owned_nodes() * 3; ++k) {
    error = std::max(error, std::abs((plus[k] - minus[k]) / (2.0 * eps) - product[k]));
    size = std::max(size, std::abs(product[k]));
  }
  return mesh.comm.max(error) / mesh.comm.max(size);
}

// The tangent of the coupled system against central differences of its residual.
TEST(FsiProblem, TangentIsTheDerivativeOfTheResidual) {
  const auto mesh = channel_mesh(Communicator());
  struct Choice {
    double rho_inf, rho_inf_solid;
    const char* treatment;
  };
  for (const auto& [rho_inf, rho_inf_solid, treatment] :
       {Choice{0.0, 0.0, "frozen"}, {0.0, 0.5, "frozen"}, {0.0, 0.0, "exact"}, {0.5, 0.5, "exact"}}) {
    FlowOptions flow = flow_options();
    flow.rho_inf = rho_inf;
    Probed problem(mesh, flow, fsi_options(rho_inf_solid, treatment));
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(problem.step(0.01).converged);
    // Loads of any size: the state need not balance them.
    problem.bodies()[0].parameters.gravity = {3.0, -1.0};
    problem.bodies()[0].add_load("right", {1.0, 2.0}, 400.0);
    EXPECT_LT(tangent_error(problem), 2e-4) << treatment << ", rho_inf of the solid " << rho_inf_solid;
  }
}

TEST(FsiProblem, TangentIsTheDerivativeOfTheResidualInCellsOfOrder2) {
  const auto mesh = distribute(box<Quad2>({0.0, 0.0}, {2.0, 1.0}, {10, 5}), Communicator());
  FsiOptions options = fsi_options(0.0, "exact");
  options.s.s_max = 1e3;  // interpolated like a velocity it would fall below zero, and tau_M be no number
  ProbedIn<Quad2> problem(mesh, flow_options(), options);
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(problem.step(0.01).converged);
  EXPECT_LT(tangent_error(problem), 4e-4);  // d tau_M / dv; without the derivative of C 1.3e-3
}

/// Displacement of the tip of a leaflet much thinner than a cell.
template <class Element>
double deflection(std::array<int, 2> n) {
  std::vector<Body> thin;
  thin.emplace_back("leaflet", box<Quad1>({0.913, 0.0}, {0.933, 0.57}, {2, 48}),
                    NeoHookean(Lame::from_young(2e5, 0.3)),
                    Body::Parameters{.rho_s = 1.0, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});
  const int tip = nearest_node(thin[0], {0.923, 0.57});
  const auto mesh = distribute(box<Element>({0.0, 0.0}, {2.0, 1.0}, n), Communicator());
  FlowOptions flow = flow_options();
  flow.newton.rtol = 1e-6, flow.tau_dt = 0.0;
  ProbedIn<Element> problem(mesh, flow, fsi_options(0.0), thin);
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(problem.step(0.02).converged);
  return problem.solids().displacement(tip)[0];
}

// With as many unknowns a thin leaflet bends as it should in cells of order 2, and not in cells of order 1,
// where it can only shear.
TEST(FsiProblem, ThinLeafletsBendInCellsOfOrder2) {
  const double fine = deflection<Quad2>({40, 20}), second = deflection<Quad2>({10, 5}),
               first = deflection<Quad1>({20, 10});
  EXPECT_NEAR(second, fine, 0.08 * fine);
  EXPECT_LT(first, 0.8 * fine);
}

// A channel whose lower side is a symmetry plane, with a leaflet that stands on it, free to slide along it;
// all turned by Q.
struct Sliding {
  Mat<double, 2> Q;
  Mesh<Quad1> mesh;
  Probed problem;

  Sliding(const Mat<double, 2>& turn, const std::string& treatment)
      : Q(turn),
        mesh(distribute(turned(box<Quad1>({0.0, 0.0}, {2.0, 1.0}, {20, 10})), Communicator())),
        problem(mesh, flow_options(), fsi_options(0.0, treatment), bodies(), boundary()) {}

  [[nodiscard]] GlobalMesh<Quad1> turned(GlobalMesh<Quad1> global) const {
    for (auto& x : global.points) x = Q * x;
    return global;
  }
  [[nodiscard]] std::vector<Body> bodies() const {
    std::vector<Body> list;
    list.emplace_back("leaflet", turned(box<Quad1>({0.913, 0.0}, {1.013, 0.57}, {2, 12})),
                      NeoHookean(Lame::from_young(2e3, 0.4)),
                      Body::Parameters{.rho_s = 1.5, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});
    return list;
  }
  [[nodiscard]] FlowBoundary<2> boundary() const {
    FlowBoundary<2> b;
    b.velocity("left", [Q = Q](const auto& x, double t) {
      const double y = (transpose(Q) * x)[1];
      return Q * Vec<double, 2>{std::min(1.0, 20.0 * t) * (1.0 - y * y), 0.0};
    });
    b.traction_free("right"), b.no_slip("top"), b.slip("bottom");
    return b;
  }
  /// Displacement of a node, turned back.
  [[nodiscard]] Vec<double, 2> displacement(int a) const {
    const auto& u = problem.solids().displacement();
    return transpose(Q) * Vec<double, 2>{u[2 * a], u[2 * a + 1]};
  }
};

const Mat<double, 2> by_60_degrees{{0.5, -std::sqrt(0.75), std::sqrt(0.75), 0.5}};

// On an inclined symmetry plane a body slides, never leaves it, and moves as on one normal to an axis.
TEST(FsiProblem, ABodyStaysOnAnInclinedSymmetryPlane) {
  for (const char* treatment : {"frozen", "exact"}) {
    Sliding straight(Mat<double, 2>::identity(), treatment), inclined(by_60_degrees, treatment);
    for (int k = 0; k < 10; ++k) {
      ASSERT_TRUE(straight.problem.step(0.01).converged);
      ASSERT_TRUE(inclined.problem.step(0.01).converged);
    }
    for (int a = 0; a < straight.problem.solids().n_nodes(); ++a) {
      const bool on_plane = std::abs(straight.problem.solids().positions()[a][1]) < 1e-12;
      if (on_plane) {
        EXPECT_GT(inclined.displacement(a)[0], 1e-2);
      }
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(inclined.displacement(a)[i], straight.displacement(a)[i],
                    on_plane && i == 1 ? 1e-15 : 1e-9);
    }
    EXPECT_TRUE(inclined.problem.interpolation().lost().empty());
    const auto in = straight.problem.supply(), turned = inclined.problem.supply();
    const auto F = transpose(by_60_degrees) * turned.momentum;
    EXPECT_NEAR(turned.energy, in.energy, 1e-7);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(F[i], in.momentum[i], 1e-7);
  }
}

// d tau_M / dv shows more in this faster flow: 4e-4 on the axis and inclined.
TEST(FsiProblem, TheTangentIsConsistentOnAnInclinedPlane) {
  Sliding scene(by_60_degrees, "exact");
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(scene.problem.step(0.01).converged);
  scene.problem.bodies()[0].parameters.gravity = {3.0, -1.0};
  scene.problem.bodies()[0].add_load("right", {1.0, 2.0}, 400.0);
  EXPECT_LT(tangent_error(scene.problem), 1e-3);
}

// Prescribed unknowns are out of the system: their columns are empty, those of other ranks' nodes included.
TEST(FsiProblem, ColumnsOfPrescribedUnknownsAreEmpty) {
  const auto mesh = channel_mesh(Communicator());
  Probed problem(mesh, flow_options(), fsi_options(0.0));
  ASSERT_TRUE(problem.step(0.01).converged);
  std::vector<double> x(problem.unknowns().size(), 1.0);
  problem.constraints().project(mesh.n_nodes(), x);
  for (double& value : x) value = 1.0 - value;
  auto y = problem.tangent_times(x);
  problem.constraints().project(mesh.n_owned_nodes(), y);
  for (int k = 0; k < mesh.n_owned_nodes() * 3; ++k) EXPECT_NEAR(y[k], 0.0, 1e-12) << "node " << k / 3;
}

// The midpoint rule (rho_inf = 1) neither makes nor takes momentum or energy: what is missing from the
// balances is the VMS terms' part, which is small, and dissipates.
TEST(FsiProblem, BalancesOfMomentumAndEnergyClose) {
  const auto mesh = channel_mesh(Communicator());
  FlowOptions flow = flow_options();
  flow.rho_inf = 1.0;
  Probed problem(mesh, flow, fsi_options(1.0));
  Balances balances(problem);
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(problem.step(0.01).converged);
    const auto row = balances.observe(0.01);
    const double power_in = row[0], loss = row[4], outflow = row[5];
    const auto force = problem.supply().momentum;
    EXPECT_GT(loss, 0.0);
    EXPECT_LT(loss, 0.05 * power_in);
    EXPECT_NEAR(outflow, 0.0, 1e-10);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(row[6 + i], 0.0, 1e-3 * std::abs(force[0]));
  }
}

// A node that ends far from where it was predicted: the step is refused, and nothing has changed.
TEST(FsiProblem, AStepThatIsTooLargeIsRefused) {
  const auto mesh = channel_mesh(Communicator());
  FsiOptions fsi = fsi_options(0.0);
  fsi.max_change = 1e-3;
  Probed problem(mesh, flow_options(), fsi);
  const StepReport report = problem.step(0.1);
  EXPECT_FALSE(report.converged);
  EXPECT_GT(report.change, 1.0);
  EXPECT_NE(report.failure.find("fluid spacings from where it was predicted"), std::string::npos)
      << report.failure;
  EXPECT_EQ(problem.time(), 0.0);
  const StepReport small = problem.step(1e-3);
  EXPECT_TRUE(small.converged);
  EXPECT_GT(small.change, 0.0);
}

/// Two beams, one above the other, 3.2 spacings of the fluid apart, that loads bend together in a closed box.
Probed bent_together(const Mesh<Quad1>& mesh, double contact_range) {
  std::vector<Body> beams;
  for (const double y : {0.36, 0.58}) {
    beams.emplace_back(
        "beam", box<Quad1>({0.0, y}, {0.6, y + 0.06}, {16, 2}), NeoHookean(Lame::from_young(2e3, 0.4)),
        Body::Parameters{.rho_s = 2.0, .rho_f = 1.0, .mu_f = 0.01, .mu_s = 0.0, .gravity = {}});
    beams.back().parameters.gravity[1] = y < 0.5 ? 40.0 : -40.0;  // a pressure of 40 * 0.06 * (2 - 1) = 2.4
  }
  FlowBoundary<2> boundary;
  for (const std::string& side : mesh.boundary_names) boundary.no_slip(side);
  FsiOptions fsi = fsi_options(0.0);
  fsi.contact_range = contact_range, fsi.contact_pressure = 24.0;
  return {mesh, flow_options(), fsi, std::move(beams), boundary, 0.01};
}

// Contact holds the beams further apart than the fluid between them does, with an exact tangent; the answer
// does not depend on the ranks.
TEST(FsiProblem, ContactHoldsBodiesApart) {
  const auto global = box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {20, 20});
  const auto alone = distribute(global, Communicator(MPI_COMM_SELF)),
             shared = distribute(global, Communicator());
  Probed with = bent_together(shared, 3.0), same = bent_together(alone, 3.0),
         without = bent_together(shared, 0.0);
  // The upper beam also feels a plane below it; the lower one begins within its range.
  for (Probed* problem : {&with, &same}) problem->add_contact_plane({{0.0, 0.42}, {0.0, 1.0}, false});
  for (int k = 0; k < 10; ++k)
    for (Probed* problem : {&with, &same, &without}) {
      const StepReport report = problem->step(0.03);
      ASSERT_TRUE(report.converged) << k << " " << report.failure;
    }
  for (std::size_t k = 0; k < same.solids().displacement().size(); ++k)
    EXPECT_NEAR(with.solids().displacement()[k], same.solids().displacement()[k], 1e-9);
  const auto gap = [](const Probed& problem) {
    return nearness(problem.solids().bodies(), problem.solids().positions()).distance;
  };
  const auto contact = with.solids().contact()->totals(with.solids().positions());
  EXPECT_GT(gap(with), 0.11);
  EXPECT_LT(gap(without), 0.093);
  EXPECT_GT(contact.energy, 0.0);
  EXPECT_GT(with.solids().contact()->singles().size(), 0u);
  EXPECT_NEAR(contact.gap, gap(with), 1e-12);
  EXPECT_LT(tangent_error(with), 2e-4);
}

/// Two leaflets that leave a gap of 1.8 cells between them, in a channel driven by pressure: all of it, or
/// its upper half.
struct Narrow {
  Mesh<Quad1> mesh;
  Probed problem;

  Narrow(Communicator comm, double seal, bool whole)
      : mesh(distribute(box<Quad1>({0.0, whole ? -0.5 : 0.0}, {2.0, 0.5}, {20, whole ? 10 : 5}), comm)),
        problem(mesh, flow(), options(seal), bodies(whole), boundary(whole)) {
    if (seal > 0.0 && !whole) problem.add_seal_mirror({{0.0, 0.0}, {0.0, 1.0}, true});
  }
  [[nodiscard]] static FlowOptions flow() {
    FlowOptions options = flow_options();
    options.rho_inf = 1.0;  // so that the balance of momentum closes
    return options;
  }
  [[nodiscard]] static FsiOptions options(double seal) {
    FsiOptions fsi = fsi_options(1.0);
    fsi.seal = seal, fsi.seal_range = 5.0;
    return fsi;
  }
  [[nodiscard]] static std::vector<Body> bodies(bool whole) {
    std::vector<Body> list;
    const auto add = [&](double low, double high) {
      list.emplace_back(
          "leaflet", box<Quad1>({0.95, low}, {1.05, high}, {2, 8}), NeoHookean(Lame::from_young(2e6, 0.4)),
          Body::Parameters{.rho_s = 1.0, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});
    };
    add(0.13, 0.5);
    if (whole) add(-0.5, -0.13);
    return list;
  }
  [[nodiscard]] static FlowBoundary<2> boundary(bool whole) {
    FlowBoundary<2> b;
    b.pressure("left", [](double t) { return 50.0 * std::min(1.0, 5.0 * t); });
    b.traction_free("right"), b.no_slip("top");
    whole ? b.no_slip("bottom") : b.slip("bottom");
    return b;
  }
  [[nodiscard]] double leak() const {
    return boundary_flux<Cartesian>(mesh, mesh.boundary("right"), problem.solution());
  }
};

// Friction in the gap holds the fluid back, whether what is beyond it is a body or an image, with an exact
// tangent and balances that close; it does not depend on the ranks.
TEST(FsiProblem, SealHoldsBackTheFluidInAGap) {
  constexpr double seal = 2e3;
  Narrow whole(Communicator(), seal, true), half(Communicator(), seal, false),
      same(Communicator(MPI_COMM_SELF), seal, false), open(Communicator(), 0.0, false);
  Balances<Probed> of_whole(whole.problem), of_half(half.problem);
  for (int k = 0; k < 3; ++k) {
    for (Narrow* scene : {&whole, &half, &same, &open}) {
      const StepReport report = scene->problem.step(0.05);
      ASSERT_TRUE(report.converged) << k << " " << report.failure;
    }
    for (Balances<Probed>* balances : {&of_whole, &of_half}) {
      const auto row = balances->observe(0.05);
      EXPECT_NEAR(row[6], 0.0, 1e-4 * 50.0) << k;
      EXPECT_GT(row[4], -1e-3 * row[0]) << k;  // nothing is gained
    }
  }
  for (std::size_t k = 0; k < same.problem.solids().displacement().size(); ++k)
    EXPECT_NEAR(half.problem.solids().displacement()[k], same.problem.solids().displacement()[k], 1e-9);
  // Up to k_p: a gap point on the line of symmetry lies in one of the two cells beside it.
  EXPECT_NEAR(whole.leak(), 2.0 * half.leak(), 0.05 * whole.leak());
  EXPECT_NEAR(whole.problem.solids().seal_power(), 2.0 * half.problem.solids().seal_power(),
              0.05 * whole.problem.solids().seal_power());
  EXPECT_GT(half.problem.solids().seal_power(), 0.0);
  EXPECT_LT(half.leak(), 0.05 * open.leak());
  EXPECT_LT(tangent_error(half.problem), 2e-4);
  EXPECT_LT(tangent_error(whole.problem), 2e-4);
}

/// A stiff leaflet that closes a channel at a slant, driven by pressure.
struct Shut {
  Mesh<Quad1> mesh;
  Probed problem;

  Shut(Communicator comm, int n_high, double tie, int rings)
      : mesh(distribute(box<Quad1>({0.0, 0.0}, {2.0, 1.0}, {20, 10}), comm)),
        problem(mesh, Narrow::flow(), options(tie, rings), body(n_high), Narrow::boundary(true)) {}
  [[nodiscard]] static FsiOptions options(double tie, int rings) {
    FsiOptions fsi = fsi_options(1.0);
    fsi.s.s_max = 1000.0;
    fsi.tie = tie, fsi.tie_spacing = 0.7, fsi.k_p_rings = rings;
    return fsi;
  }
  [[nodiscard]] static std::vector<Body> body(int n_high) {
    auto slanted = box<Quad1>({0.72, 0.0}, {0.8, 1.0}, {2, n_high});
    for (auto& x : slanted.points) x[0] += 0.43 * x[1];
    std::vector<Body> bodies;
    bodies.emplace_back(
        "leaflet", std::move(slanted), NeoHookean(Lame::from_young(2e6, 0.4)),
        Body::Parameters{.rho_s = 1.0, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});
    return bodies;
  }
  [[nodiscard]] double leak() const {
    return boundary_flux<Cartesian>(mesh, mesh.boundary("right"), problem.solution());
  }
};

// Friction between the nodes of a coarse leaflet shuts it, with an exact tangent and balances that close; the
// answer does not depend on the ranks.
TEST(FsiProblem, TieHoldsBackTheFluidInACoarseSolid) {
  constexpr double tie = 1e5;
  Shut tied(Communicator(), 4, tie, 0), same(Communicator(MPI_COMM_SELF), 4, tie, 0),
      coarse(Communicator(), 4, 0.0, 0);
  Balances<Probed> balances(tied.problem);
  for (int k = 0; k < 3; ++k) {
    for (Shut* scene : {&tied, &same, &coarse}) {
      const StepReport report = scene->problem.step(0.05);
      ASSERT_TRUE(report.converged) << k << " " << report.failure;
    }
    const auto row = balances.observe(0.05);
    EXPECT_NEAR(row[6], 0.0, 1e-4 * 50.0) << k;
    EXPECT_GT(row[4], -1e-3 * row[0]) << k;  // nothing is gained
  }
  for (std::size_t k = 0; k < same.problem.solids().displacement().size(); ++k)
    EXPECT_NEAR(tied.problem.solids().displacement()[k], same.problem.solids().displacement()[k], 1e-9);
  EXPECT_GT(tied.problem.solids().tie_power(), 0.0);
  EXPECT_LT(std::abs(tied.leak()), 0.2 * std::abs(coarse.leak())) << coarse.leak();
  EXPECT_LT(tangent_error(tied.problem), 2e-4);
}

// Rings of cells around those that the solid cuts have their k_p.
TEST(FsiProblem, RingsHaveTheScaleOfCutCells) {
  Shut plain(Communicator(), 20, 0.0, 0), ringed(Communicator(), 20, 0.0, 1);
  const auto scaled = [](Shut& scene) {
    scene.problem.begin_step(0.01);
    return scene.mesh.comm.sum(std::ranges::count(scene.problem.k_p_, FsiOptions{}.k_p));
  };
  EXPECT_GT(scaled(plain), 0);
  EXPECT_GT(scaled(ringed), 2 * scaled(plain));
}

// The patch of the preconditioner reaches as far as momentum diffuses in a step.
TEST(FsiProblem, PatchGrowsWithTheTimeStep) {
  const auto mesh = channel_mesh(Communicator());
  const double mu = 2.5;  // momentum diffuses half a spacing in 0.001, ten in 0.4
  const auto unknowns = [&](int layers, double dt) {
    FsiOptions options = fsi_options(0.0);
    options.patch_layers = layers;
    Probed problem(mesh, flow_options(), options, leaflet(), channel(), mu);
    problem.begin_step(1e-3);
    problem.begin_step(dt);  // no node has changed its cell
    return problem.linear_solver().patch_unknowns();
  };
  EXPECT_EQ(unknowns(-1, 1e-3), unknowns(2, 1e-3));
  EXPECT_EQ(unknowns(-1, 0.4), unknowns(6, 0.4));
  EXPECT_GT(unknowns(6, 0.4), unknowns(2, 0.4));
}

TEST(FsiProblem, SealsThatCannotWorkAreRefused) {
  const auto mesh = channel_mesh(Communicator());
  FsiOptions fsi = fsi_options(0.0, "exact");
  fsi.seal = 1.0;
  EXPECT_THROW(Probed(mesh, flow_options(), fsi), Error);
  fsi.seal = 0.0, fsi.tie = 1.0;
  EXPECT_THROW(Probed(mesh, flow_options(), fsi), Error);
  Probed without(mesh, flow_options(), fsi_options(0.0));
  EXPECT_THROW(without.add_seal_mirror({{0.0, 0.5}, {0.0, 1.0}, true}), Error);
}

TEST(FsiProblem, ContactThatCannotWorkIsRefused) {
  const auto mesh = channel_mesh(Communicator());
  FsiOptions fsi = fsi_options(0.0);
  const auto refused = [&] {
    try {
      Probed(mesh, flow_options(), fsi);
      return std::string();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::configuration);
      return std::string(e.what());
    }
  };
  fsi.contact_range = 1.0;
  EXPECT_NE(refused().find("contact.pressure = 0.0"), std::string::npos) << refused();
  fsi.contact_pressure = 1.0,
  fsi.contact_range = 0.4;  // 0.04; the faces of the leaflet's sides are 0.0475 long
  EXPECT_NE(refused().find("'leaflet' are 0.0475"), std::string::npos) << refused();
  fsi.contact_range = 1.0;
  EXPECT_EQ(refused(), "");
  Probed without(mesh, flow_options(), fsi_options(0.0));
  EXPECT_THROW(without.add_contact_plane({{0.0, 0.5}, {0.0, 1.0}}), Error);
}

}  // namespace
}  // namespace ifsi
