// Incomplete LU and Gauss-Seidel against their definitions on dense copies.
#include "ifsi/linalg/ilu.hpp"

#include <gtest/gtest.h>

#include "dense.hpp"
#include "ifsi/core/error.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The dense velocity block of a flow matrix.
template <int dim>
MatrixXd velocity_block(const test::StokesModel<dim>& model) {
  const MatrixXd K = test::dense(model.K);
  const long n = K.rows() / (dim + 1);
  MatrixXd A(n * dim, n * dim);
  for (long i = 0; i < n; ++i)
    for (long j = 0; j < n; ++j)
      A.block(i * dim, j * dim, dim, dim) = K.block(i * (dim + 1), j * (dim + 1), dim, dim);
  return A;
}

/// A matrix whose components couple, which the model's own velocity block does not.
template <int dim>
test::StokesModel<dim> coupled_model(test::StokesOptions options) {
  test::StokesModel<dim> model(options);
  for (int k = 0; k < model.K.pattern().n_blocks(); ++k) {
    double* block = model.K.at(k);
    const double size = std::abs(block[0]);
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c < dim; ++c)
        if (r != c) block[r * (dim + 1) + c] = size * 0.2 * std::sin(1.0 + k + r - 2 * c);
  }
  return model;
}

template <class Preconditioner>
VectorXd apply(const Preconditioner& P, const VectorXd& b) {
  const Eigen::VectorXf in = b.cast<float>();
  Eigen::VectorXf out = Eigen::VectorXf::Zero(in.size());
  P.apply(in.data(), out.data());
  return out.cast<double>();
}

/// The dense matrix x -> P^-1 x, inverted: what the preconditioner takes A for.
template <class Preconditioner>
MatrixXd implied_matrix(const Preconditioner& P, long n) {
  MatrixXd inverse(n, n);
  for (long j = 0; j < n; ++j) inverse.col(j) = apply(P, VectorXd::Unit(n, j));
  return test::inverse(inverse);
}

template <int dim>
void product_agrees_with_matrix_on_its_pattern() {
  const auto model = coupled_model<dim>({.cells = 3, .wind = 2});
  const MatrixXd A = velocity_block(model);
  BlockIlu<dim> ilu;
  ilu.update(model.K);
  const MatrixXd LU = implied_matrix(ilu, A.rows());
  double inside = 0, outside = 0;
  for (long i = 0; i < A.rows(); ++i)
    for (long j = 0; j < A.cols(); ++j) {
      const bool in_pattern = model.K.find(static_cast<int>(i / dim), static_cast<int>(j / dim)) >= 0;
      double& worst = in_pattern ? inside : outside;
      worst = std::max(worst, std::abs(LU(i, j) - A(i, j)));
    }
  EXPECT_LT(inside, 2e-5 * A.cwiseAbs().maxCoeff());
  EXPECT_GT(outside, 1e-4 * A.cwiseAbs().maxCoeff());  // incomplete: it must differ somewhere
}

TEST(BlockIlu, ProductOfTheFactorsAgreesWithTheMatrixOnItsPattern) {
  product_agrees_with_matrix_on_its_pattern<2>();
  product_agrees_with_matrix_on_its_pattern<3>();
}

TEST(BlockIlu, MayWorkInPlace) {
  const auto model = coupled_model<2>({.cells = 4});
  BlockIlu<2> ilu;
  ilu.update(model.K);
  const Eigen::VectorXf b = test::some_vector(model.K.n_rows() * 2).cast<float>();
  Eigen::VectorXf x(b.size()), in_place = b;
  ilu.apply(b.data(), x.data());
  ilu.apply(in_place.data(), in_place.data());
  EXPECT_EQ(x, in_place);
}

TEST(BlockIlu, TellsWhereAPivotIsSingular) {
  test::StokesModel<2> model({.cells = 3});
  double* block = model.K.at(model.K.find(5, 5));
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2; ++c) block[r * 3 + c] = 0;
  for (int k = model.K.row_ptr()[5]; k < model.K.row_ptr()[6]; ++k) std::fill_n(model.K.at(k), 9, 0.0);
  BlockIlu<2> ilu;
  try {
    ilu.update(model.K);
    FAIL() << "expected an Error";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("node 5"), std::string::npos);
  }
}

TEST(BlockGaussSeidel, IsOneForwardAndOneBackwardSweep) {
  const auto model = coupled_model<2>({.cells = 4, .wind = 2});
  const MatrixXd A = velocity_block(model);
  MatrixXd D = MatrixXd::Zero(A.rows(), A.cols()), L = D, U = D;
  for (long i = 0; i < A.rows(); ++i)
    for (long j = 0; j < A.cols(); ++j) (i / 2 == j / 2 ? D : i > j ? L : U)(i, j) = A(i, j);
  const VectorXd b = test::some_vector(A.rows());
  const VectorXd forward = test::multiply(test::inverse(D + L), b);
  const VectorXd expected = test::multiply(test::inverse(D + U), b - test::multiply(L, forward));
  BlockGaussSeidel<2> sweep;
  sweep.update(model.K);
  EXPECT_LT((apply(sweep, b) - expected).norm(), 1e-5 * expected.norm());
}
}  // namespace
