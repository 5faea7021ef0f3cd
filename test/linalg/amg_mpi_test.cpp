// BoomerAMG as a preconditioner: it solves, in few iterations whatever the mesh, on any number of ranks.
#include <gtest/gtest.h>

#include "dense.hpp"
#include "ifsi/linalg/amg.hpp"
#include "ifsi/linalg/extract.hpp"
#include "ifsi/linalg/gmres.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;

struct Solve {
  SolverReport report;
  std::vector<double> x;
};

template <int D>
Solve solve(const BlockCsr<D>& A, const Amg& amg, const Eigen::VectorXd& b) {
  const std::vector<double> rhs = test::scatter(A.layout(), D, b);
  Solve s{{}, std::vector<double>(rhs.size(), 0.0)};
  GmresOptions options;
  options.target = {{1e-8, 1e-8}, {}};
  s.report = fgmres(A.layout(), D, linear_map(A), linear_map(amg), rhs.data(), s.x.data(), options);
  return s;
}

/// A Laplacian made regular by a spring at one node.
template <int dim>
BlockCsr<1> poisson(int cells) {
  BlockCsr<1> A = test::StokesModel<dim>({.cells = cells, .rho_c = 1}).laplacian;
  if (A.layout().communicator().is_root()) *A.at(A.find(0, 0)) *= 2;
  return A;
}

TEST(Amg, SolvesAsTheDenseMatrixDoes) {
  const BlockCsr<1> A = poisson<2>(9);
  Amg amg;
  EXPECT_FALSE(amg.ready());
  amg.setup(A);
  EXPECT_TRUE(amg.ready());
  const Eigen::VectorXd b = test::some_vector(A.layout().n_global());
  const Solve s = solve(A, amg, b);
  EXPECT_TRUE(s.report.converged);
  const Eigen::VectorXd expected = test::solve(test::dense(A), b);
  EXPECT_LT((test::gather(A.layout(), 1, s.x.data()) - expected).norm(), 1e-5 * expected.norm());
}

template <int dim>
int iterations(int cells, const AmgOptions& options) {
  const BlockCsr<1> A = poisson<dim>(cells);
  Amg amg(options);
  amg.setup(A);
  return solve(A, amg, test::some_vector(A.layout().n_global())).report.iterations;
}

TEST(Amg, IterationsHardlyGrowWithTheMesh) {
  const int coarse = iterations<2>(20, {.strong_threshold = 0.25}),
            fine = iterations<2>(60, {.strong_threshold = 0.25});
  EXPECT_LE(fine, 20);
  EXPECT_LE(fine, coarse + 4);
  EXPECT_LE(iterations<3>(10, {}), 20);
}

TEST(Amg, AWCycleMakesUpForPoorInterpolation) {
  EXPECT_LT(iterations<2>(60, {.w_cycle = true, .max_per_row = 1}), iterations<2>(60, {.max_per_row = 1}));
}

TEST(Amg, SeveralUnknownsPerNodeAreSeveralFunctions) {
  const test::StokesModel<2> model({.cells = 24, .rho_c = 1e-3});
  const BlockCsr<2> A = extract_diagonal_part<2>(model.K, 0);
  Amg amg;
  amg.setup(A);
  const Solve s = solve(A, amg, test::some_vector(A.layout().n_global() * 2));
  EXPECT_TRUE(s.report.converged);
  EXPECT_LE(s.report.iterations, 25);
}

TEST(Amg, ApplyingIsLinear) {
  const BlockCsr<1> A = poisson<2>(20);
  Amg amg;
  amg.setup(A);
  const long n = A.layout().n_global();
  const auto apply = [&](const Eigen::VectorXd& b) {
    const std::vector<double> in = test::scatter(A.layout(), 1, b);
    std::vector<double> out(in.size(), 1e3);  // what is there before must not matter
    amg.apply(in.data(), out.data());
    return test::gather(A.layout(), 1, out.data());
  };
  const Eigen::VectorXd a = test::some_vector(n, 1), b = test::some_vector(n, 2), sum = a - 3 * b;
  EXPECT_LT((apply(sum) - apply(a) + 3 * apply(b)).norm(), 1e-10 * apply(sum).norm());
}

TEST(Amg, CanBeSetUpAgain) {
  Amg amg;
  for (int cells : {8, 12}) {
    const BlockCsr<1> A = poisson<2>(cells);
    amg.setup(A);
    EXPECT_TRUE(solve(A, amg, test::some_vector(A.layout().n_global())).report.converged);
  }
  EXPECT_NE(amg.description().find("levels"), std::string::npos);
}
}  // namespace
