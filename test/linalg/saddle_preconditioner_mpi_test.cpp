// The block preconditioner against its block equations, and the iteration counts it is there for.
#include <gtest/gtest.h>

#include <limits>

#include "dense.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/linalg/amg.hpp"
#include "ifsi/linalg/extract.hpp"
#include "ifsi/linalg/gmres.hpp"
#include "ifsi/linalg/ilu.hpp"
#include "ifsi/linalg/saddle_preconditioner.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
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

/// N^-1 as the preconditioner should build it: N with its diagonal doubled where velocity is free on a
/// boundary.
Amg pressure_solver(const StokesModel<2>& model) {
  BlockCsr<1> S = model.laplacian;
  for (int i = 0; i < S.n_rows(); ++i)
    if (model.grid.node[i][0] == model.grid.n - 1 && !model.is_fixed(i))
      *S.at(S.find(i, i)) += *model.laplacian.at(S.find(i, i));
  Amg amg({.strong_threshold = 0.25});
  amg.setup(S);
  return amg;
}

TEST(SaddlePreconditioner, SolvesItsBlockEquations) {
  StokesModel<2> model({.cells = 8, .viscosity = 0.03, .wind = 1});
  const Layout& layout = model.grid.layout;
  SaddlePreconditioner<3> P({.velocity = "ilu"});
  P.update(model.K, schur_parts(model));
  const int n = layout.n_owned(), n_local = layout.n_local();
  const std::vector<double> r = test::scatter(layout, 3, test::some_vector(3 * layout.n_global()));
  std::vector<double> z(r.size());
  P.apply(r.data(), z.data());

  std::vector<double> r_p(n), z_p(n), Gz(r.size()), pressure(r.size(), 0.0);
  std::vector<float> local(n_local);
  for (int i = 0; i < n; ++i) r_p[i] = r[3 * i + 2];
  pressure_solver(model).apply(r_p.data(), z_p.data());
  BlockCsr<1> mass_and_pspg = extract_diagonal_part<1>(model.K, 2);
  for (int i = 0; i < n; ++i) {
    const int diagonal = model.K.find(i, i);
    const double tau_c = *mass_and_pspg.at(diagonal) / *model.laplacian.at(diagonal);
    local[i] = static_cast<float>((1 - tau_c) * r_p[i]);
  }
  for (std::size_t k = 0; k < model.mass.values.size(); ++k) mass_and_pspg.values[k] += model.mass.values[k];
  BlockIlu<1> local_part;
  local_part.update(mass_and_pspg);
  local_part.apply(local.data(), local.data());
  for (int i = 0; i < n; ++i) pressure[3 * i + 2] = z_p[i] += local[i];
  model.K.apply(pressure.data(), Gz.data());
  std::vector<float> r_v(2 * n_local), z_v(2 * n_local);
  for (int i = 0; i < 2 * n; ++i) r_v[i] = static_cast<float>(r[i / 2 * 3 + i % 2] - Gz[i / 2 * 3 + i % 2]);
  BlockIlu<2> ilu;
  ilu.update(model.K);
  ilu.apply(r_v.data(), z_v.data());

  const auto largest = [](const auto& x) { return std::abs(*std::max_element(x.begin(), x.end())); };
  for (int i = 0; i < n; ++i) {
    EXPECT_NEAR(z[3 * i + 2], z_p[i], 1e-12 * largest(z_p));
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(z[3 * i + c], z_v[2 * i + c], 1e-5 * largest(z_v));
  }
}

template <int dim>
int iterations(const StokesOptions& options, const std::string& velocity) {
  constexpr int B = dim + 1;
  StokesModel<dim> model(options);
  SaddlePreconditioner<B> P({.velocity = velocity, .enclosed = options.enclosed});
  SchurParts parts = schur_parts(model);
  parts.steady = options.rho_c < 1e-6;
  if (options.wind != 0) parts.convection = model.convection;
  P.update(model.K, parts);
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
  for (int cells : {16, 40})
    EXPECT_LE(iterations<2>({.cells = cells, .rho_c = 1.5 * cells, .viscosity = .01, .wind = 1}, "ilu"), 25)
        << cells;
  for (int cells : {6, 10})
    EXPECT_LE(iterations<3>({.cells = cells, .rho_c = 1.5 * cells, .viscosity = .01, .wind = 1}, "ilu"), 25)
        << cells;
}

// 25 with ILU(0) applied once.
TEST(SaddlePreconditioner, DiffusionOverACellAndMoreTakesFewIterationsWithIluTwice) {
  EXPECT_LE(iterations<2>({.cells = 40, .rho_c = 1, .viscosity = .01}, "ilu"), 20);
}

TEST(SaddlePreconditioner, ViscousFlowTakesFewIterationsWithAmg) {
  for (int cells : {16, 40})
    EXPECT_LE(iterations<2>({.cells = cells, .rho_c = .2 * cells, .viscosity = 1}, "amg"), 25) << cells;
  EXPECT_LE(iterations<3>({.cells = 8, .rho_c = 2, .viscosity = 1}, "amg"), 25);
}

TEST(SaddlePreconditioner, SteadyStokesFlowTakesFewIterationsWithTheMassMatrixAlone) {
  for (int cells : {16, 32})
    for (bool enclosed : {false, true})
      EXPECT_LE(iterations<2>({.cells = cells, .rho_c = 1e-9, .viscosity = 1, .enclosed = enclosed}, "amg"),
                30)
          << cells;
}

// 41 and 60 with the boundary terms that N has where it stands alone.
TEST(SaddlePreconditioner, SteadyTransportKnowsWhereTheFluidFlowsIn) {
  for (int cells : {16, 32})
    EXPECT_LE(iterations<2>({.cells = cells, .rho_c = 1e-9, .viscosity = 1, .wind = 50}, "amg"), 30) << cells;
}

TEST(SaddlePreconditioner, TransportOverManyCellsPerStepHasALaplacianOfItsOwn) {
  // 38 with one Laplacian for both.
  EXPECT_LE(iterations<2>({.cells = 32, .rho_c = 2, .viscosity = .01, .wind = 1}, "ilu"), 30);
}

TEST(SaddlePreconditioner, GaussSeidelServesSmallTimeSteps) {
  EXPECT_LE(iterations<2>({.cells = 32, .rho_c = 1e3, .viscosity = .01, .wind = 1}, "gauss_seidel"), 25);
}

// 36 with ILU(0) four times. Ranks see no further than their ghosts, which diffusion does here.
TEST(SaddlePreconditioner, DiffusionOverManyCellsTakesFewIterationsWithGaussSeidel) {
  const bool one_rank = Communicator().size() == 1;
  EXPECT_LE(iterations<2>({.cells = 40, .rho_c = .05, .viscosity = .01}, "gauss_seidel"), one_rank ? 20 : 40);
}

// Asked for where diffusion has no bounds: the number of passes has.
TEST(SaddlePreconditioner, SteadyFlowMayBeGivenToGaussSeidel) {
  const StokesModel<2> model({.cells = 4});
  SaddlePreconditioner<3> P({.velocity = "gauss_seidel"});
  SchurParts parts = schur_parts(model);
  parts.viscous_number = std::numeric_limits<double>::infinity();
  P.update(model.K, parts);
  EXPECT_NE(P.description().find("passes: 59 "), std::string::npos) << P.description();
}

TEST(SaddlePreconditioner, TakesGaussSeidelInThePlaneWhileTheFlowCrossesFewCells) {
  using Plane = SaddlePreconditioner<3>;
  EXPECT_TRUE(Plane::gauss_seidel_serves({.viscous = 45, .bulk = 180}, 1));
  EXPECT_FALSE(Plane::gauss_seidel_serves({.viscous = 55}, 1));
  EXPECT_TRUE(Plane::gauss_seidel_serves({.viscous = 1.4}, 2));
  EXPECT_FALSE(Plane::gauss_seidel_serves({.viscous = 1.6}, 2));  // ranks
  EXPECT_TRUE(Plane::gauss_seidel_serves({.viscous = 2, .transport = 2.9}, 1));
  EXPECT_FALSE(Plane::gauss_seidel_serves({.viscous = 2, .transport = 3.1}, 1));
  EXPECT_FALSE(Plane::gauss_seidel_serves({.viscous = 0.2, .transport = 1.1}, 1));
  EXPECT_FALSE(Plane::gauss_seidel_serves({.viscous = 1, .bulk = 25}, 1));
  EXPECT_FALSE(SaddlePreconditioner<4>::gauss_seidel_serves({.viscous = 1}, 1));
}

template <int B>
std::string choice(double viscosity, int order = 1) {
  StokesModel<B - 1> model({.cells = 4, .viscosity = viscosity});
  SaddlePreconditioner<B> P;
  SchurParts parts = schur_parts(model);
  parts.order = order;
  P.update(model.K, parts);
  return P.description();
}

TEST(SaddlePreconditioner, ChoosesTheVelocitySolverByTheViscousNumber) {
  EXPECT_NE(choice<3>(1e-3).find("velocity: Gauss-Seidel, passes: 1 "), std::string::npos);
  EXPECT_NE(choice<3>(0.7).find("velocity: Gauss-Seidel, passes: 4 "), std::string::npos);
  EXPECT_NE(choice<3>(1e3).find("by nodes"), std::string::npos);
  EXPECT_NE(choice<4>(1e-3).find("velocity: ILU"), std::string::npos);
  EXPECT_NE(choice<4>(1e3).find("W-cycle"), std::string::npos);
}

TEST(SaddlePreconditioner, TakesAmgEarlierInThePlaneAndWithOrderTwo) {
  EXPECT_FALSE(SaddlePreconditioner<3>::needs_amg({.viscous = 1.4, .transport = 10}, 1));
  EXPECT_TRUE(SaddlePreconditioner<3>::needs_amg({.viscous = 1.6, .transport = 10}, 1));
  EXPECT_TRUE(SaddlePreconditioner<3>::needs_amg({.viscous = 1.6}, 2));
  EXPECT_FALSE(SaddlePreconditioner<4>::needs_amg({.viscous = 2.9}, 1));
  EXPECT_TRUE(SaddlePreconditioner<4>::needs_amg({.viscous = 2.1, .order = 2}, 1));
  EXPECT_TRUE(SaddlePreconditioner<3>::needs_amg({.viscous = 0.01, .bulk = 50.0}, 1));
  EXPECT_FALSE(SaddlePreconditioner<3>::needs_amg({.viscous = 0.01, .bulk = 2.0}, 1));
}

TEST(SaddlePreconditioner, AppliesIluTwiceWhereTheFlowCrossesCells) {
  EXPECT_EQ(SaddlePreconditioner<3>::ilu_passes(0.01, false), 1);
  EXPECT_EQ(SaddlePreconditioner<3>::ilu_passes(0.01, true), 2);
  EXPECT_EQ(SaddlePreconditioner<4>::ilu_passes(1.4, false), 2);
  EXPECT_EQ(SaddlePreconditioner<4>::ilu_passes(1.6, true), 4);
}

TEST(SaddlePreconditioner, CoarsensByNodesForCellsOfOrderOneOnly) {
  EXPECT_NE(choice<3>(1e3, 1).find("by nodes"), std::string::npos);
  EXPECT_EQ(choice<3>(1e3, 2).find("by nodes"), std::string::npos);
}

TEST(SaddlePreconditioner, RefusesWhatDoesNotFit) {
  EXPECT_THROW(SaddlePreconditioner<3>({.velocity = "magic"}), Error);
  StokesModel<2> model({.cells = 4}), other({.cells = 5});
  SaddlePreconditioner<3> P;
  EXPECT_THROW(P.update(model.K, schur_parts(other)), Error);
}
}  // namespace
