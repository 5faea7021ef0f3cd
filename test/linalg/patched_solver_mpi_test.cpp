// A fluid with a stiff line (in space: a sheet) of nodes: the patch around it makes iteration counts
// independent of its stiffness, an old set-up of the fluid is kept as far as it serves, and renewed where it
// does not.
#include <gtest/gtest.h>

#include "ifsi/linalg/patched_solver.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
using test::StokesModel;

constexpr SolveTarget tight_target{{1e-9, 1e-9}, {}};

/// What a solid at x_0 = `at` does: springs of `stiffness` between its nodes, and PSPG in the rows around it
/// scaled, as s and k_p do.
template <int dim>
struct Scene {
  static constexpr int B = dim + 1;
  StokesModel<dim> fluid;
  BlockCsr<B> K_s;
  int at;

  Scene(const test::StokesOptions& options, int place, double stiffness, double scale = 1.0)
      : fluid(options), K_s(fluid.K.shared_pattern()), at(place) {
    for (int i = 0; i < K_s.n_rows(); ++i)
      for (int k = K_s.row_ptr()[i]; k < K_s.row_ptr()[i + 1]; ++k) {
        const int j = K_s.cols()[k];
        if (near(i)) fluid.K.at(k)[B * B - 1] *= scale;
        if (!on_solid(i) || !on_solid(j) || fluid.is_fixed(i) || fluid.is_fixed(j)) continue;
        for (int c = 0; c < dim; ++c) K_s.at(k)[c * B + c] = stiffness * fluid.laplacian.values[k];
      }
  }
  [[nodiscard]] bool on_solid(int i) const { return fluid.grid.node[i][0] == at; }
  [[nodiscard]] bool near(int i) const { return std::abs(fluid.grid.node[i][0] - at) <= 1; }
  [[nodiscard]] std::vector<char> patch() const {
    std::vector<char> in_patch;
    for (int i = 0; i < fluid.grid.layout.n_local(); ++i) in_patch.push_back(near(i));
    return in_patch;
  }
  [[nodiscard]] SchurParts schur_parts() const {
    const double h = 1.0 / fluid.options.cells;
    SchurParts parts{fluid.mass, fluid.laplacian};
    if (fluid.options.wind != 0) parts.convection = fluid.convection;
    parts.viscous_number = fluid.options.viscosity / (fluid.options.rho_c * h * h);
    return parts;
  }

  /// Declares the patch and solves for a known solution.
  SolverReport solve(PatchedSolver<B>& solver) {
    solver.set_patch(fluid.K, K_s, patch());
    std::vector<double> exact = fluid.exact(), b(exact.size()), from_solid(exact.size()),
                        x(exact.size(), 0.0);
    fluid.K.apply(exact.data(), b.data());
    K_s.apply(exact.data(), from_solid.data());
    for (std::size_t i = 0; i < b.size(); ++i) b[i] += from_solid[i];
    const SolverReport report = solver.solve(fluid.K, K_s, b, x, tight_target);
    EXPECT_TRUE(report.converged) << report.message;
    double error = 0.0;
    for (int i = 0; i < K_s.n_rows() * B; ++i) error = std::max(error, std::abs(x[i] - exact[i]));
    EXPECT_LT(fluid.grid.comm.max(error), 1e-2);
    return report;
  }
};

template <int dim>
void expect_few_iterations_at_any_stiffness(const std::string& base, int at_most) {
  for (double stiffness : {0.0, 1.0, 1e6}) {
    Scene<dim> scene({.cells = dim == 2 ? 12 : 5, .rho_c = 10, .viscosity = 0.1, .wind = 1}, 3, stiffness);
    PatchedSolver<dim + 1> solver({.base = base}, [&] { return scene.schur_parts(); });
    EXPECT_LE(scene.solve(solver).iterations, at_most) << base << " " << stiffness;
  }
}

TEST(PatchedSolver, StiffnessDoesNotMatter) {
  for (const char* base : {"direct", "gmres"}) {
    expect_few_iterations_at_any_stiffness<2>(base, 30);
    expect_few_iterations_at_any_stiffness<3>(base, 30);
  }
}

// What the solid does to the fluid's rows moves with it. The patch keeps the place of the set-up, so that the
// set-up is still right outside of it; when the patch would grow too much the fluid is set up anew.
TEST(PatchedSolver, ASetUpOutlastsTheMotionOfTheSolid) {
  const test::StokesOptions options{.cells = 12, .rho_c = 10, .viscosity = 0.1, .wind = 1};
  for (double growth : {2.0, 1.5}) {
    Scene<2> before(options, 3, 1e4, 100), after(options, 9, 1e4, 100);
    PatchedSolver<3> solver({.base = "direct", .growth = growth}, [&] { return after.schur_parts(); });
    const int fresh = before.solve(solver).iterations, kept = after.solve(solver).iterations;
    EXPECT_EQ(solver.setups(), growth < 2.0 ? 2 : 1);
    EXPECT_LE(kept, 2 * fresh + 4);
    EXPECT_EQ(solver.patch_unknowns(), (growth < 2.0 ? 1 : 2) * 3 * 13 * 3);
  }
}

// Another fluid behind the solver's back: GMRES gives the old set-up up and the solve is made again with a
// new one.
TEST(PatchedSolver, AFailedSolveIsRepeatedWithANewSetUp) {
  for (const char* base : {"direct", "gmres"}) {
    Scene<2> before({.cells = 16, .rho_c = 1, .viscosity = 10}, 8, 1e4),
        after({.cells = 16, .rho_c = 1000, .viscosity = 1e-3, .wind = 100}, 8, 1e4);
    const Scene<2>* now = &before;
    PatchedSolver<3> solver({.base = base}, [&] { return now->schur_parts(); });
    before.solve(solver);
    ASSERT_EQ(solver.setups(), 1);
    now = &after;
    after.solve(solver);
    EXPECT_EQ(solver.setups(), 2) << base;
  }
}

// NaN from the block preconditioner is a solve that failed: LU takes over. (In space: in the plane `auto`
// takes LU from the start.)
TEST(PatchedSolver, NaNFromThePreconditionerIsAFailedSolve) {
  Scene<3> scene({.cells = 9, .rho_c = 10, .viscosity = 0.1, .wind = 1}, 3, 1e4);
  const auto broken = [&] {
    SchurParts parts = scene.schur_parts();
    parts.convection = parts.mass;
    for (double& entry : parts.convection.values) entry = std::numeric_limits<double>::quiet_NaN();
    return parts;
  };
  PatchedSolver<4> solver({}, broken);
  scene.solve(solver);
  EXPECT_EQ(solver.setups(), 2);
  solver.invalidate(), scene.solve(solver);
  EXPECT_EQ(solver.setups(), 3);  // LU stays
  solver.give_up(), scene.solve(solver);
  EXPECT_EQ(solver.setups(), 5);  // unless the step came to nothing
}

// A solve that LU fails as well (here: no time for either), then or later, does not leave LU as the
// preconditioner of the next.
TEST(PatchedSolver, WhatNobodySolvesDoesNotCallForLu) {
  Scene<3> scene({.cells = 9, .rho_c = 10, .viscosity = 0.1, .wind = 1}, 3, 1e4);
  int block_setups = 0;
  PatchedSolver<4> solver({.max_iterations = 1}, [&] { return ++block_setups, scene.schur_parts(); });
  solver.set_patch(scene.fluid.K, scene.K_s, scene.patch());
  const std::vector<double> b = scene.fluid.exact();
  for (int k = 1; k <= 2; ++k) {
    std::vector<double> x(b.size(), 0.0);
    EXPECT_FALSE(solver.solve(scene.fluid.K, scene.K_s, b, x, tight_target).converged);
    EXPECT_EQ(block_setups, k);
    EXPECT_EQ(solver.setups(), 2 * k);  // the block preconditioner, then LU
  }
}
}  // namespace
