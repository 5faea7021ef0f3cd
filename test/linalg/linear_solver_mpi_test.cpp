#include <gtest/gtest.h>

#include "ifsi/linalg/linear_solver.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
using test::StokesModel;

constexpr BlockNorms tight{1e-11, 1e-11};

/// Largest difference between x and a known solution.
template <int dim>
double error(const StokesModel<dim>& model, const std::vector<double>& x) {
  const std::vector<double> exact = model.exact();
  double e = 0;
  for (std::size_t i = 0; i < model.mass.size() * (dim + 1); ++i) e = std::max(e, std::abs(x[i] - exact[i]));
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
  const SolverReport report = solver.solve(model.K, b, x, tight);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 3);
  EXPECT_LT(error(model, x), 1e-9);
}

TEST(LinearSolver, EnclosedFlowHasAPressureOfZeroMean) {
  StokesModel<2> model({.cells = 10, .enclosed = true});
  LinearSolver<3> solver({.enclosed = true});
  const std::vector<double> b = right_hand_side(model);
  std::vector<double> x(b.size(), 0.0);
  EXPECT_TRUE(solver.solve(model.K, b, x, tight).converged);
  EXPECT_LT(error(model, x), 1e-8);
}

TEST(LinearSolver, StaleFactorsServeUntilTheyNoLongerPay) {
  LinearSolver<3> solver({});
  int solves = 0;
  for (double wind = 0; wind < 40; wind += 1, ++solves) {
    StokesModel<2> model({.cells = 12, .rho_c = 1, .viscosity = .1, .wind = wind});
    const std::vector<double> b = right_hand_side(model);
    std::vector<double> x(b.size(), 0.0);
    ASSERT_TRUE(solver.solve(model.K, b, x, tight).converged) << "wind " << wind;
    ASSERT_LT(error(model, x), 1e-4) << "wind " << wind;
  }
  EXPECT_GT(solver.total_setups(), 1);
  EXPECT_LT(solver.total_setups(), solves / 2);
}
}  // namespace
