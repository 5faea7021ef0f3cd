// UMFPACK and (where it was found) MUMPS behind DirectSolver against a dense LU.
#include <gtest/gtest.h>

#include "dense.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/linalg/direct.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;

template <int B>
Eigen::VectorXd solve(const DirectSolver& solver, const BlockCsr<B>& K, const Eigen::VectorXd& b) {
  const std::vector<double> rhs = test::scatter(K.layout(), B, b);
  std::vector<double> x(rhs.size());
  solver.apply(rhs.data(), x.data());
  return test::gather(K.layout(), B, x.data());
}

constexpr auto on_root = DirectSolver::Work::on_root, shared = DirectSolver::Work::shared;

template <int dim>
void compare_with_dense(DirectSolver::Work work) {
  test::StokesModel<dim> model({.cells = 4, .wind = 3});
  DirectSolver solver(work);
  EXPECT_FALSE(solver.ready());
  solver.factor(model.K);
  EXPECT_TRUE(solver.ready());
  const Eigen::VectorXd b = test::some_vector(model.grid.layout.n_global() * (dim + 1));
  const Eigen::VectorXd expected = test::solve(test::dense(model.K), b);
  EXPECT_LT((solve(solver, model.K, b) - expected).norm(), 1e-9 * expected.norm());
}

TEST(DirectSolver, SolvesAsTheDenseMatrixDoes) {
  for (auto work : {on_root, shared}) {
    compare_with_dense<2>(work);
    compare_with_dense<3>(work);
  }
}

TEST(DirectSolver, RefactorsNewValuesOnTheSamePattern) {
  for (auto work : {on_root, shared}) {
    test::StokesModel<2> model({.cells = 5});
    DirectSolver solver(work);
    solver.factor(model.K);
    for (double& value : model.K.values) value *= 2;
    solver.factor(model.K);
    const Eigen::VectorXd b = test::some_vector(model.grid.layout.n_global() * 3);
    const Eigen::VectorXd expected = test::solve(test::dense(model.K), b);
    EXPECT_LT((solve(solver, model.K, b) - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(DirectSolver, TakesAnotherPatternLater) {
  for (auto work : {on_root, shared}) {
    DirectSolver solver(work);
    for (int cells : {4, 6}) {
      test::StokesModel<2> model({.cells = cells});
      solver.factor(model.K);
      const Eigen::VectorXd b = test::some_vector(model.grid.layout.n_global() * 3);
      const Eigen::VectorXd expected = test::solve(test::dense(model.K), b);
      EXPECT_LT((solve(solver, model.K, b) - expected).norm(), 1e-9 * expected.norm());
    }
  }
}

TEST(DirectSolver, APinnedPressureMakesEnclosedFlowRegular) {
  test::StokesModel<2> model({.cells = 4, .enclosed = true});
  const Eigen::MatrixXd K = test::dense(model.K);
  std::vector<double> x_exact = model.exact();
  const Eigen::VectorXd b = test::multiply(K, test::gather(model.grid.layout, 3, x_exact.data()));
  DirectSolver solver;
  solver.factor(model.K, 2);
  const Eigen::VectorXd x = solve(solver, model.K, b);
  EXPECT_NEAR(x[2], 0, 1e-14);
  EXPECT_LT((K * x - b).norm(), 1e-10 * b.norm());
}

TEST(DirectSolver, SaysThatAMatrixIsSingular) {
  test::StokesModel<2> model({.cells = 4});
  model.K.set_zero();
  DirectSolver solver;
  try {
    solver.factor(model.K);
    FAIL() << "expected an Error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::linear_solver);
    EXPECT_NE(std::string(e.what()).find("singular"), std::string::npos);
  }
  EXPECT_FALSE(solver.ready());
}

TEST(DirectSolver, SaysWhoWorks) {
  EXPECT_EQ(DirectSolver().method(), "UMFPACK, on one rank");
  EXPECT_NE(DirectSolver(shared).method().find("rank"), std::string::npos);
}

TEST(DirectSolver, KnowsItsCost) {
  for (auto work : {on_root, shared}) {
    test::StokesModel<2> model({.cells = 8});
    DirectSolver solver(work);
    solver.factor(model.K);
    EXPECT_GT(solver.cost().lu_entries, model.grid.layout.n_global() * 3 * 27);
    EXPECT_GT(solver.cost().flops, solver.cost().lu_entries);
    EXPECT_GT(solver.setup_cost(), 8);
  }
}
}  // namespace
