// Gauss-Seidel with Chebyshev weights against its definition on dense copies of each rank's part of the
// matrix.
#include <gtest/gtest.h>

#include "dense.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/linalg/gauss_seidel.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A matrix with wind whose numbers, divided by the diagonal blocks, have eight bits: what is stored is
/// exact.
template <int dim>
test::StokesModel<dim> rounded_model(int cells) {
  test::StokesModel<dim> model({.cells = cells, .wind = 2});
  constexpr int B = dim + 1;
  for (int i = 0; i < model.K.n_rows(); ++i) {
    const double diagonal = *model.K.at(model.K.find(i, i));
    for (int k = model.K.row_ptr()[i]; k < model.K.row_ptr()[i + 1]; ++k)
      for (int r = 0; r < dim; ++r)
        for (int c = 0; c < dim; ++c) {
          double& entry = model.K.at(k)[r * B + c];
          const double coupled = r == c ? entry / diagonal : 0.02 * std::sin(1.0 + i + 3 * k + r - 2 * c);
          const bool own = model.K.cols()[k] == i;
          entry = own ? 2.0 * (r == c) : 2.0 * static_cast<float>(Bfloat16(static_cast<float>(coupled)));
        }
  }
  return model;
}

template <int D, int B>
MatrixXd part_of_rank(const BlockCsr<B>& K) {
  const MatrixXd all = test::dense(K);
  const Layout& nodes = K.layout();
  MatrixXd A(nodes.n_local() * D, nodes.n_local() * D);
  for (int i = 0; i < nodes.n_local(); ++i)
    for (int j = 0; j < nodes.n_local(); ++j)
      A.block(i * D, j * D, D, D) = all.block(nodes.global(i) * B, nodes.global(j) * B, D, D);
  return A;
}

/// x <- x + w (D + U)^-1 D (D + L)^-1 (b - A x) for each weight, from zero; the diagonal blocks are diagonal.
VectorXd weighted_passes(const MatrixXd& A, const VectorXd& b, const std::vector<float>& weights) {
  const MatrixXd lower = A.triangularView<Eigen::Lower>(), upper = A.triangularView<Eigen::Upper>();
  VectorXd x = VectorXd::Zero(b.size());
  for (float weight : weights) {
    const VectorXd forward = test::solve(lower, VectorXd(b - test::multiply(A, x)));
    x += weight * test::solve(upper, VectorXd(A.diagonal().cwiseProduct(forward)));
  }
  return x;
}

template <int dim>
void follows_its_definition_of_sweeps(const std::vector<float>& weights) {
  const auto model = rounded_model<dim>(5);
  const Layout& layout = model.grid.layout;
  GaussSeidel<dim> sweeps(weights);
  sweeps.update(model.K);
  const VectorXd all = test::some_vector(layout.n_global() * dim);
  VectorXd b(layout.n_local() * dim);
  for (int i = 0; i < layout.n_local(); ++i)
    b.segment(i * dim, dim) = all.segment(layout.global(i) * dim, dim);
  const VectorXd expected = weighted_passes(part_of_rank<dim>(model.K), b, weights);
  const std::vector<double> without_ghosts = test::scatter(layout, dim, all);
  std::vector<float> in(without_ghosts.begin(), without_ghosts.end()), out(in.size());
  sweeps.apply(in.data(), out.data());
  for (int e = 0; e < layout.n_owned() * dim; ++e)
    EXPECT_NEAR(out[e], expected[e], 1e-5 * expected.cwiseAbs().maxCoeff()) << e;
}

// Fails when a pass forgets what lies above the diagonal, or when ghosts do not come from their owners.
TEST(GaussSeidel, PassesAreForwardAndBackwardSweepsOfTheResidual) {
  follows_its_definition_of_sweeps<2>({1.0f});
  follows_its_definition_of_sweeps<2>({1.3f, 0.8f, 1.1f});
  follows_its_definition_of_sweeps<3>({1.3f, 0.8f, 1.1f});
}

TEST(GaussSeidel, WeightsLeaveNoErrorAboveTheOneAskedFor) {
  for (double lowest : {0.9, 0.3, 0.05, 0.003}) {
    const std::vector<float> weights = chebyshev_weights(lowest, 0.05);
    double largest = 0;
    for (double lambda = lowest; lambda <= 1; lambda += 1e-4) {
      double error = 1;
      for (float weight : weights) error *= 1 - weight * lambda;
      largest = std::max(largest, std::abs(error));
    }
    EXPECT_LE(largest, 0.05 * 1.001) << lowest;
    EXPECT_GT(largest, 0.05 / 50) << lowest << ": more passes than it takes";
  }
}

// In ascending or descending order of the weights the products reach 1e6 here and drown single precision.
TEST(GaussSeidel, NoPartOfThePassesAmplifiesRoundingErrors) {
  const std::vector<float> weights = chebyshev_weights(0.003, 0.05);
  EXPECT_GT(weights.size(), 20u);
  double largest = 0;
  for (double lambda = 0.003; lambda <= 1; lambda += 1e-3)
    for (std::size_t begin = 0; begin < weights.size(); ++begin) {
      double product = 1;
      for (std::size_t k = begin; k < weights.size(); ++k) product *= 1 - weights[k] * lambda;
      largest = std::max(largest, std::abs(product));
    }
  EXPECT_LT(largest, 1e3);
}

TEST(GaussSeidel, TellsWhereADiagonalBlockIsSingular) {
  test::tells_where_a_block_is_singular<GaussSeidel<2>>();
}

TEST(Bfloat16, RoundsToEightBitsAndKeepsNaN) {
  const auto rounded = [](float x) { return static_cast<float>(Bfloat16(x)); };
  EXPECT_EQ(rounded(-1.5f), -1.5f);
  EXPECT_EQ(rounded(1.0f + 0x1p-8f), 1.0f);            // halfway: to even
  EXPECT_EQ(rounded(1.0f + 0x3p-8f), 1.0f + 0x1p-6f);  // halfway: to even
  EXPECT_EQ(rounded(1.0f + 0x1.1p-8f), 1.0f + 0x1p-7f);
  EXPECT_TRUE(std::isnan(rounded(std::nanf(""))));
}
}  // namespace
