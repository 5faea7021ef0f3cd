// A membrane in a duct: the same on any number of ranks, with its tangent, its constraint and its restart.
#include <gtest/gtest.h>

#include "duct.hpp"
#include "ifsi/assembly/membrane_body.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/fsi_problem.hpp"
#include "io/scratch_folder.hpp"

namespace ifsi {
namespace {

using Membrane = MembraneBody<Quad2, TensionFibres<PlaneStress<NeoHookean>>>;
using MembraneProblem = FsiProblem<Hex1, Membrane>;

/// A flag 0.4 wide and 0.6 high that stands on the floor of the duct at this x, bulged a little.
SurfaceMesh<Quad2> flag_mesh(double x_floor) {
  constexpr int n_a = 4, n_b = 6;
  const auto flat = box<Quad2>({0.0, 0.0}, {1.0, 1.0}, {n_a / 2, n_b / 2});
  SurfaceMesh<Quad2> mesh;
  mesh.cells = flat.cells;
  int node_at[n_a + 1][n_b + 1];
  for (int p = 0; p < flat.n_points(); ++p) {
    const auto& x = flat.points[p];
    node_at[std::lround(n_a * x[0])][std::lround(n_b * x[1])] = p;
    mesh.points.push_back({x_floor + 0.06 * std::sin(3.0 * x[0]) * x[1], 0.6 * x[1], 0.3 + 0.4 * x[0]});
  }
  for (int i = 1; i < n_a; ++i)
    for (int j = 1; j < n_b; ++j)
      mesh.crosses.push_back(
          {node_at[i][j], node_at[i - 1][j], node_at[i + 1][j], node_at[i][j - 1], node_at[i][j + 1]});
  return mesh;
}

/// Two of them, so that one does not begin with the first node.
std::vector<Membrane> flags(double bending) {
  const TensionFibres law(PlaneStress(NeoHookean(Lame::from_young(300.0, 0.4))), 200.0, {0.0, 0.0, 1.0}, 2.0,
                          100.0);
  const SolidParameters<3> solid{.rho_s = 1.5, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}};
  return {Membrane("first flag", flag_mesh(0.7), law, solid, 0.03, bending),
          Membrane("second flag", flag_mesh(1.3), law, solid, 0.03, bending)};
}

struct FlagsInDuct : MembraneProblem {
  FlagsInDuct(const Mesh<Hex1>& mesh, const FsiOptions& fsi, double bending = 0.5)
      : MembraneProblem(mesh, test::duct(), 1.0, Newtonian{0.1}, flags(bending), options(), fsi) {}
  static FlowOptions options() {
    FlowOptions flow;
    flow.rho_inf = 0.0, flow.newton.rtol = 1e-10;
    flow.tau_dt = 1e6;  // the tangent leaves d tau out: make tau a constant of the metric
    return flow;
  }
  void march(int steps) {
    for (int k = 0; k < steps; ++k) {
      const StepReport report = step(0.03);
      ASSERT_TRUE(report.converged) << k << " " << report.failure;
    }
  }
  [[nodiscard]] std::vector<double> all() const {
    std::vector<double> x(solids().displacement().begin(), solids().displacement().end());
    x.insert(x.end(), solids().velocity().begin(), solids().velocity().end());
    return x;
  }
};

Mesh<Hex1> duct_mesh(Communicator comm) {
  return distribute(box<Hex1>({0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}, {6, 5, 4}), comm);
}

TEST(MembraneInSpace, DoesNotDependOnTheRanks) {
  const auto alone = duct_mesh(Communicator(MPI_COMM_SELF)), shared = duct_mesh(Communicator());
  FlagsInDuct one(alone, {}), all(shared, {});
  one.march(3), all.march(3);
  EXPECT_LT(all.constraint_violation(), 1e-10);
  double largest = 0.0;
  for (std::size_t k = 0; k < one.all().size(); ++k) {
    EXPECT_NEAR(all.all()[k], one.all()[k], 1e-9);
    largest = std::max(largest, std::abs(one.all()[k]));
  }
  EXPECT_GT(largest, 0.1);
  const auto of_one = one.solids().totals(), of_all = all.solids().totals();
  EXPECT_GT(of_one.elastic_energy, 1e-6);
  EXPECT_NEAR(of_all.elastic_energy, of_one.elastic_energy, 1e-9);
  EXPECT_NEAR(of_all.kinetic_energy, of_one.kinetic_energy, 1e-9);
}

// The slopes of bending leave out a curvature (see SheetBending): they cost one iteration.
TEST(MembraneInSpace, NewtonConvergesAlmostQuadratically) {
  const auto mesh = duct_mesh(Communicator());
  for (const char* treatment : {"frozen", "exact"})
    for (double bending : {0.0, 0.5}) {
      FsiOptions fsi;
      fsi.treatment = treatment;
      FlagsInDuct problem(mesh, fsi, bending);
      problem.march(3);
      std::vector<double> residuals;
      problem.watch([&](const NewtonReport& r) { residuals.push_back(r.residual.momentum); });
      problem.march(1);
      EXPECT_LE(residuals.size(), bending > 0.0 ? 5u : 4u) << treatment;
      EXPECT_GT(residuals.front(), 1e-2) << treatment;
      EXPECT_LT(residuals.back(), 1e-10) << treatment;
      EXPECT_LT(problem.constraint_violation(), 1e-10) << treatment;
    }
}

TEST(MembraneInSpace, ContinuesFromACheckpoint) {
  const auto mesh = duct_mesh(Communicator());
  const test::ScratchFolder folder;
  FlagsInDuct straight(mesh, {}), restarted(mesh, {});
  straight.march(2);
  CheckpointWriter writer(mesh.comm);
  straight.save(writer);
  const std::string file = writer.save(folder.path(), 2);
  restarted.restore(Checkpoint(mesh.comm, file));
  EXPECT_EQ(restarted.all(), straight.all());
  straight.march(1), restarted.march(1);
  EXPECT_EQ(restarted.time(), straight.time());
  for (std::size_t k = 0; k < straight.all().size(); ++k)
    EXPECT_NEAR(restarted.all()[k], straight.all()[k], 1e-10);
}

// Its friction would act through the thickness, which has no nodes.
TEST(MembraneInSpace, CannotBeTied) {
  const auto mesh = duct_mesh(Communicator());
  FsiOptions fsi;
  fsi.tie = 1.0;
  try {
    FlagsInDuct problem(mesh, fsi);
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::configuration);
    EXPECT_NE(std::string(e.what()).find("no membranes"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace ifsi
