// The block preconditioner against its block equations, and the iteration counts it is there for.
#include <gtest/gtest.h>

#include "dense.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/linalg/gmres.hpp"
#include "ifsi/linalg/saddle_preconditioner.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::StokesModel;
using test::StokesOptions;

template <int dim>
SchurParts schur_parts(const StokesModel<dim>& model) {
  SchurParts parts;
  parts.mass = model.mass;
  parts.laplacian = model.laplacian;
  const double h = 1.0 / model.options.cells;
  parts.viscous_number = model.options.viscosity / (model.options.rho_c * h * h);
  return parts;
}

/// A, G, D, L of a dense K.
struct Blocks {
  MatrixXd A, G, D, L;
  Blocks(const MatrixXd& K, int dim) {
    const long n = K.rows() / (dim + 1);
    A.resize(n * dim, n * dim), G.resize(n * dim, n), D.resize(n, n * dim), L.resize(n, n);
    for (long i = 0; i < n; ++i)
      for (long j = 0; j < n; ++j) {
        const MatrixXd block = K.block(i * (dim + 1), j * (dim + 1), dim + 1, dim + 1);
        A.block(i * dim, j * dim, dim, dim) = block.topLeftCorner(dim, dim);
        G.block(i * dim, j, dim, 1) = block.topRightCorner(dim, 1);
        D.block(i, j * dim, 1, dim) = block.bottomLeftCorner(1, dim);
        L(i, j) = block(dim, dim);
      }
  }
};

// On 3 x 3 nodes multigrid is one level, solved exactly: the block equations hold to single precision.
TEST(SaddlePreconditioner, SolvesItsBlockEquations) {
  StokesModel<2> model({.cells = 2, .wind = 1});
  SaddlePreconditioner<3> P({.velocity = "amg"});
  P.update(model.K, schur_parts(model));
  const long n = model.grid.layout.n_global();
  const Blocks K(test::dense(model.K), 2);
  MatrixXd S = K.L + test::dense(model.laplacian);
  for (long i = 0; i < n; ++i)  // velocity is free at x = 1, but for the corners
    if ((K.G.middleRows(2 * i, 2).rowwise().sum()).norm() > 1e-10)
      S(i, i) += test::dense(model.laplacian)(i, i);
  const std::vector<double> M = model.grid.comm.all_gather(model.mass);

  const VectorXd r = test::some_vector(3 * n);
  VectorXd r_v(2 * n), r_p(n);
  for (long i = 0; i < n; ++i) r_v.segment(2 * i, 2) = r.segment(3 * i, 2), r_p[i] = r[3 * i + 2];
  VectorXd z_p = S.partialPivLu().solve(r_p);
  for (long i = 0; i < n; ++i) z_p[i] += r_p[i] / M[i];
  const VectorXd z_v = K.A.partialPivLu().solve(r_v - K.G * z_p);

  const std::vector<double> in = test::scatter(model.grid.layout, 3, r);
  std::vector<double> out(in.size());
  P.apply(in.data(), out.data());
  const VectorXd z = test::gather(model.grid.layout, 3, out.data());
  for (long i = 0; i < n; ++i) {
    EXPECT_NEAR(z[3 * i + 2], z_p[i], 1e-5 * z_p.norm()) << "pressure " << i;
    for (int c = 0; c < 2; ++c)
      EXPECT_NEAR(z[3 * i + c], z_v[2 * i + c], 1e-5 * z_v.norm()) << "velocity " << i;
  }
}

template <int dim>
int iterations(const StokesOptions& options, const std::string& velocity) {
  constexpr int B = dim + 1;
  StokesModel<dim> model(options);
  SaddlePreconditioner<B> P({.velocity = velocity, .enclosed = options.enclosed});
  P.update(model.K, schur_parts(model));
  std::vector<double> x = model.exact(), b(x.size());
  model.K.apply(x.data(), b.data());
  std::fill(x.begin(), x.end(), 0.0);
  GmresOptions gmres;
  gmres.mass_component = dim;
  gmres.max_iterations = 100;
  const SolverReport report =
      fgmres(model.grid.layout, B, linear_map(model.K), linear_map(P), b.data(), x.data(), gmres);
  EXPECT_TRUE(report.converged) << report.message;
  return report.iterations;
}

TEST(SaddlePreconditioner, MassDominatedFlowTakesFewIterationsWithIlu) {
  for (int cells : {16, 32, 64})
    EXPECT_LE(iterations<2>({.cells = cells, .rho_c = 1.5 * cells, .viscosity = .01, .wind = 1}, "ilu"), 25)
        << cells;
  for (int cells : {6, 12})
    EXPECT_LE(iterations<3>({.cells = cells, .rho_c = 1.5 * cells, .viscosity = .01, .wind = 1}, "ilu"), 25)
        << cells;
}

TEST(SaddlePreconditioner, ViscousFlowTakesFewIterationsWithAmg) {
  for (int cells : {16, 32, 64})
    EXPECT_LE(iterations<2>({.cells = cells, .rho_c = .2 * cells, .viscosity = 1}, "amg"), 25) << cells;
  EXPECT_LE(iterations<3>({.cells = 10, .rho_c = 2, .viscosity = 1}, "amg"), 25);
}

TEST(SaddlePreconditioner, GaussSeidelServesSmallTimeSteps) {
  EXPECT_LE(iterations<2>({.cells = 32, .rho_c = 1e3, .viscosity = .01, .wind = 1}, "gauss_seidel"), 25);
}

template <int B>
std::string choice(double viscosity) {
  StokesModel<B - 1> model({.cells = 4, .viscosity = viscosity});
  SaddlePreconditioner<B> P;
  P.update(model.K, schur_parts(model));
  return P.description();
}

TEST(SaddlePreconditioner, ChoosesTheVelocitySolverByTheViscousNumber) {
  EXPECT_NE(choice<3>(1e-3).find("ILU"), std::string::npos);
  EXPECT_EQ(choice<3>(1e3).find("ILU"), std::string::npos);
  EXPECT_NE(choice<4>(1e-3).find("ILU"), std::string::npos);
}

TEST(SaddlePreconditioner, RefusesWhatDoesNotFit) {
  EXPECT_THROW(SaddlePreconditioner<3>({.velocity = "magic"}), Error);
  StokesModel<2> model({.cells = 4}), other({.cells = 5});
  SaddlePreconditioner<3> P;
  EXPECT_THROW(P.update(model.K, schur_parts(other)), Error);
}
}  // namespace
