#include <gtest/gtest.h>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/linear_solver.hpp"
#include "ifsi/linalg/method_choice.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
using test::StokesModel;

constexpr BlockNorms tight_norms{1e-11, 1e-11};

/// Largest difference between x and a known solution.
template <int dim>
double error(const StokesModel<dim>& model, const std::vector<double>& x) {
  const std::vector<double> exact = model.exact();
  double e = 0;
  for (std::size_t i = 0; i < model.K.n_rows() * std::size_t{dim + 1}; ++i)
    e = std::max(e, std::abs(x[i] - exact[i]));
  return model.grid.comm.max(e);
}

template <int dim>
std::vector<double> right_hand_side(const StokesModel<dim>& model) {
  std::vector<double> x = model.exact(), b(x.size());
  model.K.apply(x.data(), b.data());
  return b;
}

TEST(LinearSolver, DirectFindsTheSolution) {
  StokesModel<2> model({.cells = 10, .wind = 3});
  LinearSolver<3> solver({});
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x(b.size(), 0.0);
  const SolverReport report = solver.solve(model.K, b, x, tight_norms);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 3);
  EXPECT_LT(error(model, x), 1e-9);
}

TEST(LinearSolver, EnclosedFlowHasAPressureOfZeroMean) {
  StokesModel<2> model({.cells = 10, .enclosed = true});
  LinearSolver<3> solver({.enclosed = true});
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x(b.size(), 0.0);
  EXPECT_TRUE(solver.solve(model.K, b, x, tight_norms).converged);
  EXPECT_LT(error(model, x), 1e-8);
}

TEST(LinearSolver, StaleFactorsServeUntilTheyNoLongerPay) {
  LinearSolver<3> solver({});
  int solves = 0;
  for (double wind = 0; wind < 15; wind += 1, ++solves) {
    StokesModel<2> model({.cells = 12, .rho_c = 1, .viscosity = .1, .wind = wind});
    const std::vector<double> b = right_hand_side(model);
    std::vector<double> x(b.size(), 0.0);
    ASSERT_TRUE(solver.solve(model.K, b, x, tight_norms).converged) << "wind " << wind;
    ASSERT_LT(error(model, x), 1e-4) << "wind " << wind;
  }
  EXPECT_GT(solver.total_setups(), 1);
  EXPECT_LT(solver.total_setups(), solves / 2);
}

template <int dim>
SchurProvider schur_of(const StokesModel<dim>& model) {
  return [&] {
    const double h = 1.0 / model.options.cells;
    return SchurParts{.mass = model.mass,
                      .laplacian = model.laplacian,
                      .viscous_number = model.options.viscosity / (model.options.rho_c * h * h)};
  };
}

template <int dim>
void solve_with_gmres(bool enclosed) {
  StokesModel<dim> model(
      {.cells = dim == 2 ? 20 : 6, .rho_c = 30, .viscosity = .02, .wind = 1, .enclosed = enclosed});
  LinearSolver<dim + 1> solver({.method = "gmres", .enclosed = enclosed}, schur_of(model));
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x(b.size(), 0.0);
  const SolverReport report = solver.solve(model.K, b, x, tight_norms);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_LT(error(model, x), 1e-7);
}

// The preconditioner counts twice where there is no time step; taken for a very long step it is applied once.
TEST(LinearSolver, SteadyFlowTakesHalfAsManyIterations) {
  for (bool enclosed : {false, true}) {
    StokesModel<2> model(
        {.cells = 24, .rho_c = 1e-9, .viscosity = 1, .wind = enclosed ? 0.0 : 50.0, .enclosed = enclosed});
    const auto iterations = [&](bool steady) {
      const auto parts = [&] {
        SchurParts p = schur_of(model)();
        p.steady = steady;
        if (model.options.wind != 0.0) p.convection = model.convection;
        return p;
      };
      LinearSolver<3> solver({.method = "gmres", .enclosed = enclosed}, parts);
      const std::vector<double> b = right_hand_side(model);
      std::vector<double> x(b.size(), 0.0);
      const SolverReport report = solver.solve(model.K, b, x, tight_norms);
      EXPECT_TRUE(report.converged) << report.message;
      EXPECT_LT(error(model, x), 1e-6);
      return report.iterations;
    };
    EXPECT_LE(iterations(true), 0.7 * iterations(false)) << enclosed;
  }
}

TEST(LinearSolver, GmresFindsTheSolution) {
  solve_with_gmres<2>(false);
  solve_with_gmres<2>(true);
  solve_with_gmres<3>(false);
  solve_with_gmres<3>(true);
}

TEST(LinearSolver, GhostsOfTheSolutionAreUpToDate) {
  StokesModel<2> model({.cells = 10});
  LinearSolver<3> solver({});
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x(b.size(), 0.0);
  solver.solve(model.K, b, x, tight_norms);
  std::vector<double> refreshed = x;
  model.grid.layout.update_ghosts(refreshed.data(), 3);
  EXPECT_EQ(x, refreshed);
}

TEST(LinearSolver, StartsFromTheGivenGuess) {
  StokesModel<2> model({.cells = 10});
  LinearSolver<3> solver({});
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x = model.exact();
  EXPECT_EQ(solver.solve(model.K, b, x, SolveTarget{{1e-6, 1e-6}, {1e-6, 1e-6}}).iterations, 0);
}

TEST(LinearSolver, FallsBackToLuWhereTheBlockPreconditionerFails) {
  StokesModel<3> model({.cells = 9, .rho_c = 100, .viscosity = 1});
  const SchurProvider misleading = [&] {
    SchurParts parts = schur_of(model)();
    for (double& value : parts.laplacian.values) value *= 1e-6;
    for (double& value : parts.mass.values) value *= 1e-9;
    return parts;
  };
  LinearSolver<4> solver({.max_iterations = 4}, misleading);
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x(b.size(), 0.0);
  EXPECT_TRUE(solver.solve(model.K, b, x, tight_norms).converged);
  EXPECT_NE(solver.description().find("did not converge"), std::string::npos) << solver.description();
}

// No time for either: LU would be no cure.
TEST(LinearSolver, WhatNobodySolvesDoesNotCallForLu) {
  StokesModel<3> model({.cells = 9, .rho_c = 100, .viscosity = 1});
  int block_setups = 0;
  LinearSolver<4> solver({.max_iterations = 0}, [&] { return ++block_setups, schur_of(model)(); });
  const std::vector<double> b = right_hand_side(model);
  for (int k = 1; k <= 2; ++k) {
    std::vector<double> x(b.size(), 0.0);
    EXPECT_FALSE(solver.solve(model.K, b, x, tight_norms).converged);
    EXPECT_EQ(block_setups, k);
  }
}

TEST(LinearSolver, SaysWhatItChoseAndWhy) {
  StokesModel<2> model({.cells = 4});
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x(b.size(), 0.0);
  LinearSolver<3> automatic({}, schur_of(model)), asked({.method = "gmres"}, schur_of(model));
  automatic.solve(model.K, b, x);
  asked.solve(model.K, b, x);
  EXPECT_NE(automatic.description().find("direct"), std::string::npos);
  EXPECT_NE(automatic.description().find("75 unknowns"), std::string::npos);
  EXPECT_NE(asked.description().find("GMRES"), std::string::npos);
  EXPECT_NE(asked.description().find("as asked for"), std::string::npos);
}

// In the plane one rank keeps LU longer where the velocity is expensive; several share what GMRES does.
TEST(LinearSolver, ChoosesByDimensionSizeRanksAndViscousNumber) {
  const auto direct = [](const SystemTraits& system) { return choose_method(system).direct; };
  EXPECT_TRUE(direct({.dim = 2, .unknowns = 4'000, .ranks = 2}));
  EXPECT_FALSE(direct({.dim = 2, .unknowns = 20'000}));
  EXPECT_TRUE(direct({.dim = 2, .unknowns = 20'000, .needs_amg = true}));
  EXPECT_FALSE(direct({.dim = 2, .unknowns = 20'000, .ranks = 2, .needs_amg = true}));
  EXPECT_FALSE(direct({.dim = 2, .unknowns = 200'000, .needs_amg = true}));
  EXPECT_TRUE(direct({.dim = 2, .unknowns = 20'000, .diffusive = true}));
  EXPECT_FALSE(direct({.dim = 2, .unknowns = 50'000, .diffusive = true}));
  EXPECT_TRUE(direct({.dim = 2, .unknowns = 200'000, .ranks = 2, .immersed = true}));
  EXPECT_TRUE(direct({.dim = 3, .unknowns = 2'000}));
  EXPECT_FALSE(direct({.dim = 3, .unknowns = 4'000, .needs_amg = true}));
}

// Another time step makes another viscous number, and the next set-up another choice.
TEST(LinearSolver, ChoosesAnewAtASetUp) {
  const StokesModel<2>*now = nullptr, fast({.cells = 45, .rho_c = 1e4}), slow({.cells = 45, .rho_c = 1});
  LinearSolver<3> solver({}, [&] { return schur_of(*now)(); });
  for (const auto* model : {&fast, &slow}) {
    now = model;
    const std::vector<double> b = right_hand_side(*model);
    std::vector<double> x(b.size(), 0.0);
    solver.invalidate();
    EXPECT_TRUE(solver.solve(model->K, b, x).converged);
    const bool alone = model->grid.comm.size() == 1;
    EXPECT_EQ(solver.description().find("direct") == 0, model == &slow && alone) << solver.description();
  }
}

TEST(LinearSolver, RefusesUnknownMethodsAndMissingParts) {
  EXPECT_THROW(LinearSolver<3>({.method = "magic"}), Error);
  EXPECT_THROW(LinearSolver<3>({.method = "gmres"}), Error);
}
}  // namespace
