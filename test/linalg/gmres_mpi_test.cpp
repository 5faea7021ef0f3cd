// FGMRES against dense solutions; its stop test against residuals computed from the definition.
#include <gtest/gtest.h>

#include <limits>

#include "dense.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/linalg/gmres.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;

constexpr int B = 3;

/// A flow system with its dense copy and a right-hand side of given block sizes.
struct System {
  test::StokesModel<2> model{{.cells = 4, .wind = 2}};
  Eigen::MatrixXd K = test::dense(model.K);
  Eigen::VectorXd rhs;
  std::vector<double> b, x;

  explicit System(double momentum = 1, double mass = 1) : rhs(test::some_vector(K.rows())) {
    for (int i = 0; i < rhs.size(); ++i) rhs[i] *= i % B == B - 1 ? mass : momentum;
    b = test::scatter(layout(), B, rhs);
    x.assign(b.size(), 0.0);
  }
  const Layout& layout() const { return model.grid.layout; }
  Eigen::VectorXd solution() const { return test::gather(layout(), B, x.data()); }
  BlockNorms residual() const {
    const Eigen::VectorXd r = rhs - test::multiply(K, solution());
    return norms(r);
  }
  static BlockNorms norms(const Eigen::VectorXd& r) {
    double sums[2] = {0, 0};
    for (int i = 0; i < r.size(); ++i) sums[i % B == B - 1] += r[i] * r[i];
    return {std::sqrt(sums[0]), std::sqrt(sums[1])};
  }
  SolverReport solve(const GmresOptions& options, const LinearMap& P) {
    return fgmres(layout(), B, linear_map(model.K), P, b.data(), x.data(), options);
  }
  LinearMap identity() const {
    return [n = b.size()](double* r, double* z) { std::copy_n(r, n, z); };
  }
};

GmresOptions tight_options() {
  GmresOptions o;
  o.target = {{1e-10, 1e-10}, {}};
  o.max_iterations = 400;
  o.restart = 400;
  o.mass_component = B - 1;
  return o;
}

TEST(Fgmres, FindsTheDenseSolution) {
  System s;
  EXPECT_TRUE(s.solve(tight_options(), s.identity()).converged);
  const Eigen::VectorXd exact = test::solve(s.K, s.rhs);
  EXPECT_LT((s.solution() - exact).norm(), 1e-6 * exact.norm());
}

TEST(Fgmres, ReportsTheTrueResidualsOfBothBlocks) {
  System s;
  GmresOptions o = tight_options();
  o.target = {{1e-3, 1e-3}, {}};
  const SolverReport report = s.solve(o, s.identity());
  const BlockNorms r = s.residual();
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(report.message.empty());
  EXPECT_NEAR(report.residual.momentum, r.momentum, 1e-10);
  EXPECT_NEAR(report.residual.mass, r.mass, 1e-10);
  EXPECT_LE(r.momentum, 1e-3 * s.norms(s.rhs).momentum);
  EXPECT_LE(r.mass, 1e-3 * s.norms(s.rhs).mass);
}

TEST(Fgmres, SolvesASmallMassBlockBesideALargeMomentumBlock) {
  System s(1, 1e-2);
  GmresOptions o = tight_options();
  o.target = {{1e-2, 1e-2}, {}};
  EXPECT_TRUE(s.solve(o, s.identity()).converged);
  EXPECT_LE(s.residual().mass, 1e-2 * s.norms(s.rhs).mass * (1 + 1e-9));
}

TEST(Fgmres, StopsEarlierWhereAnAbsoluteTargetAllowsIt) {
  System strict, loose;
  GmresOptions o = tight_options();
  o.target = {{1e-8, 1e-8}, {}};
  const int n_strict = strict.solve(o, strict.identity()).iterations;
  o.target.absolute = {1e-1, 1e-1};
  const SolverReport report = loose.solve(o, loose.identity());
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.iterations, n_strict);
  EXPECT_LE(loose.residual().momentum, 1e-1);
}

// Neither one later, nor too early, so that a restart has to make up for it with another product.
TEST(Fgmres, StopsAtTheFirstIterationThatMeetsBothTargets) {
  for (double relative = 0.3; relative > 1e-4; relative *= 0.7) {
    System s, shorter;
    GmresOptions o = tight_options();
    o.target = {{relative, 0.5 * relative}, {}};
    int products = 0;
    const LinearMap A = [&](double* x, double* y) { s.model.K.apply(x, y), ++products; };
    const SolverReport report = fgmres(s.layout(), B, A, s.identity(), s.b.data(), s.x.data(), o);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(products, report.iterations + 1);
    o.max_iterations = report.iterations - 1;
    EXPECT_FALSE(shorter.solve(o, shorter.identity()).converged) << relative;
  }
}

TEST(Fgmres, AWorkspaceMayServeOneSystemAfterAnother) {
  GmresWorkspace space;
  for (int cells : {5, 3, 4}) {
    const test::StokesModel<2> model({.cells = cells, .wind = 2});
    const std::vector<double> b =
        test::scatter(model.grid.layout, B, test::some_vector(model.grid.layout.n_global() * B));
    const LinearMap identity = [&](double* r, double* z) { std::copy_n(r, b.size(), z); };
    std::vector<double> x[2] = {std::vector<double>(b.size(), 0.0), std::vector<double>(b.size(), 0.0)};
    for (GmresWorkspace* given : {&space, static_cast<GmresWorkspace*>(nullptr)})
      fgmres(model.grid.layout, B, linear_map(model.K), identity, b.data(), x[given ? 0 : 1].data(),
             tight_options(), given);
    EXPECT_EQ(x[0], x[1]);
  }
}

TEST(Fgmres, AVanishingMassResidualIsMeasuredByTheMomentum) {
  System s(1, 0);
  GmresOptions o = tight_options();
  o.target = {{1e-2, 1e-2}, {}};
  o.mass_per_momentum = 0.5;
  const SolverReport report = s.solve(o, s.identity());
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(report.target.mass, 1e-2 * 1e-3 * 0.5 * s.norms(s.rhs).momentum, 1e-12);
  EXPECT_LE(s.residual().mass, report.target.mass * (1 + 1e-9));
}

TEST(Fgmres, RestartsReachTheSameSolution) {
  System s;
  GmresOptions o = tight_options();
  o.restart = 15;
  o.max_iterations = 4000;
  const Eigen::MatrixXd K = s.K;
  const LinearMap block_jacobi = [&](double* r, double* z) {
    const Eigen::VectorXd all = test::solve(K, test::gather(s.layout(), B, r));
    // An inexact inverse, so that more than one cycle is needed.
    const Eigen::VectorXd spoilt = all + 0.9 * test::some_vector(all.size()).cwiseProduct(all);
    const std::vector<double> local = test::scatter(s.layout(), B, spoilt);
    std::copy(local.begin(), local.end(), z);
  };
  const SolverReport report = s.solve(o, block_jacobi);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_GT(report.iterations, 15);
  const Eigen::VectorXd exact = test::solve(s.K, s.rhs);
  EXPECT_LT((s.solution() - exact).norm(), 1e-6 * exact.norm());
}

TEST(Fgmres, APreconditionerMayChangeFromStepToStep) {
  System s;
  int calls = 0;
  const Eigen::MatrixXd inverse = test::inverse(s.K);
  const LinearMap changing = [&](double* r, double* z) {
    Eigen::VectorXd all = test::multiply(inverse, test::gather(s.layout(), B, r));
    ++calls;
    all += 0.3 * std::sin(calls) * test::some_vector(all.size(), calls).cwiseProduct(all);
    const std::vector<double> local = test::scatter(s.layout(), B, all);
    std::copy(local.begin(), local.end(), z);
  };
  const SolverReport report = s.solve(tight_options(), changing);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_LT(report.iterations, 40);
  EXPECT_LE(s.residual().mass, 1.01e-10 * s.norms(s.rhs).mass);
}

TEST(Fgmres, AnExactStartNeedsNoIteration) {
  System s;
  s.x = test::scatter(s.layout(), B, test::solve(s.K, s.rhs));
  GmresOptions o = tight_options();
  o.target.absolute = {1e-9, 1e-9};
  EXPECT_EQ(s.solve(o, s.identity()).iterations, 0);
}

TEST(Fgmres, SaysThatItDidNotConverge) {
  System s;
  GmresOptions o = tight_options();
  o.max_iterations = 5;
  const SolverReport report = s.solve(o, s.identity());
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 5);
  EXPECT_NE(report.message.find("5 iterations"), std::string::npos);
}

TEST(Fgmres, ASingularPreconditionerEndsTheSolveInsteadOfLoopingForever) {
  System s;
  const LinearMap zero = [n = s.b.size()](double*, double* z) { std::fill_n(z, n, 0.0); };
  EXPECT_FALSE(s.solve(tight_options(), zero).converged);
}

TEST(Fgmres, RefusesNaN) {
  System s;
  s.b[0] = std::numeric_limits<double>::quiet_NaN();
  try {
    s.solve(tight_options(), s.identity());
    FAIL() << "expected an Error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::linear_solver);
  }
}

// What came before the NaN is kept, and finite.
TEST(Fgmres, NaNFromThePreconditionerIsReported) {
  System s;
  int calls = 0;
  const LinearMap identity = s.identity();
  const LinearMap breaks = [&](double* x, double* y) {
    identity(x, y);
    if (++calls == 3) y[0] = std::numeric_limits<double>::quiet_NaN();
  };
  const SolverReport report = s.solve(tight_options(), breaks);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_NE(report.message.find("NaN"), std::string::npos) << report.message;
  EXPECT_LT(report.residual.momentum, report.initial.momentum);
}
}  // namespace
