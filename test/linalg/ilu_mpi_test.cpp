// Incomplete LU against its definition on dense copies of each rank's part of the matrix.
#include <gtest/gtest.h>

#include "dense.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/linalg/extract.hpp"
#include "ifsi/linalg/ilu.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A matrix whose components couple, which the model's own velocity block does not.
template <int dim>
test::StokesModel<dim> coupled_model(test::StokesOptions options) {
  test::StokesModel<dim> model(options);
  for (int i = 0; i < model.K.n_rows(); ++i)
    for (int k = model.K.row_ptr()[i]; k < model.K.row_ptr()[i + 1]; ++k) {
      const auto j = static_cast<double>(model.grid.layout.global(model.K.cols()[k]));
      double* block = model.K.at(k);
      const double size = std::abs(block[0]);
      for (int r = 0; r < dim; ++r)
        for (int c = 0; c < dim; ++c)
          if (r != c) block[r * (dim + 1) + c] = size * 0.2 * std::sin(1.0 + i + 3 * j + r - 2 * c);
    }
  return model;
}

/// The rows and columns that a rank's nodes have in the whole matrix, ghosts included, taken from a copy of
/// all of it; D of the unknowns of each node.
template <int D, int B>
MatrixXd local_part(const BlockCsr<B>& K) {
  const MatrixXd all = test::dense(K);
  const Layout& nodes = K.layout();
  MatrixXd A(nodes.n_local() * D, nodes.n_local() * D);
  for (int i = 0; i < nodes.n_local(); ++i)
    for (int j = 0; j < nodes.n_local(); ++j)
      A.block(i * D, j * D, D, D) = all.block(nodes.global(i) * B, nodes.global(j) * B, D, D);
  return A;
}

/// One where two nodes share a cell.
template <int B>
MatrixXd local_pattern(const BlockCsr<B>& K) {
  BlockCsr<1> ones(K.shared_pattern());
  std::fill(ones.values.begin(), ones.values.end(), 1.0);
  return local_part<1>(ones);
}

/// Unit lower and upper block factors that agree with A on the pattern and vanish outside, column by column.
struct Factors {
  MatrixXd L, U;
};
Factors incomplete_factors(MatrixXd A, const MatrixXd& pattern, int D) {
  const long n = pattern.rows();
  const auto block = [D](MatrixXd& M, long i, long j) { return M.block(i * D, j * D, D, D); };
  Factors f{MatrixXd::Identity(A.rows(), A.cols()), MatrixXd::Zero(A.rows(), A.cols())};
  for (long k = 0; k < n; ++k) {
    const MatrixXd pivot = test::inverse(block(A, k, k));
    for (long j = k; j < n; ++j)
      if (pattern(k, j) != 0) block(f.U, k, j) = block(A, k, j);
    for (long i = k + 1; i < n; ++i) {
      if (pattern(i, k) == 0) continue;
      block(f.L, i, k) = test::product(block(A, i, k), pivot);
      for (long j = k + 1; j < n; ++j)
        if (pattern(i, j) != 0) block(A, i, j) -= test::product(block(f.L, i, k), block(A, k, j));
    }
  }
  return f;
}

/// A right-hand side on the rank's nodes, its ghosts in need of a refresh.
VectorXd without_ghosts(const Layout& layout, int D, const VectorXd& all) {
  const std::vector<double> local = test::scatter(layout, D, all);
  return Eigen::Map<const VectorXd>(local.data(), static_cast<long>(local.size()));
}

/// What the preconditioner makes of the vector `all`, and what `expected` does to its local part, differ at
/// owned nodes by no more than single precision.
template <int D, class Preconditioner, class Expected>
void agrees(const Preconditioner& P, const Layout& layout, const Expected& expected) {
  const VectorXd all = test::some_vector(layout.n_global() * D);
  VectorXd b(layout.n_local() * D);
  for (int i = 0; i < layout.n_local(); ++i) b.segment(i * D, D) = all.segment(layout.global(i) * D, D);
  Eigen::VectorXf in = without_ghosts(layout, D, all).cast<float>(), out = Eigen::VectorXf::Zero(in.size());
  P.apply(in.data(), out.data());
  const long n = static_cast<long>(layout.n_owned()) * D;
  const VectorXd x = expected(b).head(n);
  EXPECT_LT((out.cast<double>().head(n) - x).norm(), 1e-5 * x.norm());
}

template <int dim>
void follows_its_definition() {
  const auto model = coupled_model<dim>({.cells = 5, .wind = 2});
  const MatrixXd A = local_part<dim>(model.K), pattern = local_pattern(model.K);
  const Factors f = incomplete_factors(A, pattern, dim);
  const MatrixXd difference = test::product(f.L, f.U) - A;
  double inside = 0, outside = 0;
  for (long i = 0; i < A.rows(); ++i)
    for (long j = 0; j < A.cols(); ++j) {
      double& worst = pattern(i / dim, j / dim) != 0 ? inside : outside;
      worst = std::max(worst, std::abs(difference(i, j)));
    }
  EXPECT_LT(inside, 1e-12 * A.cwiseAbs().maxCoeff());
  EXPECT_GT(outside, 1e-4 * A.cwiseAbs().maxCoeff());  // incomplete: it must differ somewhere
  BlockIlu<dim> ilu;
  ilu.update(model.K);
  agrees<dim>(ilu, model.grid.layout,
              [&](const VectorXd& b) { return test::solve(f.U, test::solve(f.L, b)); });
}

// Fails when the ghosts' rows or the residual at the ghosts do not come from their owners.
TEST(BlockIlu, ProductOfTheFactorsAgreesWithTheMatrixOnItsPatternGhostsIncluded) {
  follows_its_definition<2>();
  follows_its_definition<3>();
}

TEST(BlockIlu, MayWorkInPlace) {
  const auto model = coupled_model<2>({.cells = 4});
  BlockIlu<2> ilu;
  ilu.update(model.K);
  const Layout& layout = model.grid.layout;
  Eigen::VectorXf b = without_ghosts(layout, 2, test::some_vector(layout.n_global() * 2)).cast<float>();
  Eigen::VectorXf x(b.size()), in_place = b;
  ilu.apply(b.data(), x.data());
  ilu.apply(in_place.data(), in_place.data());
  EXPECT_EQ(x, in_place);
}

TEST(BlockIlu, TakesAnotherPattern) {
  BlockIlu<2> ilu;
  for (int cells : {6, 4}) {
    const auto model = coupled_model<2>({.cells = cells});
    ilu.update(model.K);
    const Factors f = incomplete_factors(local_part<2>(model.K), local_pattern(model.K), 2);
    agrees<2>(ilu, model.grid.layout,
              [&](const VectorXd& b) { return test::solve(f.U, test::solve(f.L, b)); });
  }
}

TEST(BlockIlu, TellsWhereAPivotIsSingular) { test::tells_where_a_block_is_singular<BlockIlu<2>>(); }

// Fails when the residual at a seam lacks the ghosts' part of the results so far.
TEST(RefinedIlu, TreatsWhatIluHasLeftOver) {
  const auto model = coupled_model<2>({.cells = 6, .wind = 2});
  const BlockCsr<2> A = extract_diagonal_part<2>(model.K, 0);
  const Layout& layout = model.grid.layout;
  const int n = layout.n_owned() * 2;
  BlockIlu<2> ilu;
  ilu.update(model.K);
  for (int passes : {2, 4}) {
    RefinedIlu<2> refined(passes, 0.7f);
    refined.update(model.K);
    const Eigen::VectorXf b =
        without_ghosts(layout, 2, test::some_vector(layout.n_global() * 2)).cast<float>();
    VectorXd sum = VectorXd::Zero(b.size()), product = sum;
    for (int pass = 1; pass <= passes; ++pass) {
      A.apply(sum.data(), product.data());
      Eigen::VectorXf rest = b, correction(b.size());
      rest.head(n) -= product.head(n).cast<float>();
      ilu.apply(rest.data(), correction.data());
      sum += (pass < passes ? 0.7 : 1.0) * correction.cast<double>();
    }
    Eigen::VectorXf lost = b, x(b.size());
    refined.apply(lost.data(), x.data());
    EXPECT_LT((x.cast<double>() - sum).head(n).norm(), 1e-5 * sum.head(n).norm()) << passes;
  }
}
}  // namespace
