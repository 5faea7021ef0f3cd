// Pattern and product against brute force and a dense matrix.
#include <gtest/gtest.h>

#include "dense.hpp"
#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/extract.hpp"
#include "stokes_model.hpp"

namespace {
using namespace ifsi;

TEST(Pattern, CouplesExactlyTheNodesThatShareACell) {
  const test::Grid<2> grid(5);
  const auto pattern = build_pattern(grid.layout, grid.cells);
  ASSERT_EQ(pattern->n_rows(), grid.layout.n_owned());
  for (int i = 0; i < pattern->n_rows(); ++i)
    for (int j = 0; j < grid.layout.n_local(); ++j) {
      const bool neighbours = std::abs(grid.node[i][0] - grid.node[j][0]) <= 1 &&
                              std::abs(grid.node[i][1] - grid.node[j][1]) <= 1;
      const int k = pattern->find(i, j);
      EXPECT_EQ(k >= 0, neighbours);
      if (k >= 0) {
        EXPECT_EQ(pattern->cols[k], j);
      }
    }
}

TEST(Pattern, CellMapPointsAtTheRightBlocks) {
  const test::Grid<3> grid(3);
  const auto pattern = build_pattern(grid.layout, grid.cells);
  const auto map = cell_block_map(*pattern, grid.cells);
  ASSERT_EQ(map.size(), grid.cells.size());
  for (std::size_t c = 0; c < map.size(); ++c)
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b) {
        const int row = grid.cells[c][a], col = grid.cells[c][b], k = map[c][a * 8 + b];
        if (row >= grid.layout.n_owned()) {
          EXPECT_EQ(k, -1);
        } else {
          ASSERT_GE(k, pattern->row_ptr[row]);
          ASSERT_LT(k, pattern->row_ptr[row + 1]);
          EXPECT_EQ(pattern->cols[k], col);
        }
      }
}

template <int B>
void compare_product_with_dense() {
  const test::Grid<2> grid(4);
  BlockCsr<B> K(build_pattern(grid.layout, grid.cells));
  for (int i = 0; i < K.n_rows(); ++i)
    for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k)
      for (int e = 0; e < B * B; ++e)
        K.at(k)[e] = std::cos(3.0 * grid.layout.global(i) + 0.7 * grid.layout.global(K.cols()[k]) + e);
  const Eigen::VectorXd x = test::some_vector(K.layout().n_global() * B);
  std::vector<double> x_local = test::scatter(K.layout(), B, x), y(x_local.size());
  K.apply(x_local.data(), y.data());
  const Eigen::VectorXd expected = test::multiply(test::dense(K), x);
  EXPECT_LT((test::gather(K.layout(), B, y.data()) - expected).norm(), 1e-13 * expected.norm());
}

TEST(BlockCsr, ProductIsThatOfTheDenseMatrix) {
  compare_product_with_dense<1>();
  compare_product_with_dense<2>();
  compare_product_with_dense<3>();
  compare_product_with_dense<4>();
}

TEST(BlockCsr, ValuesStartOnACacheLine) {
  const test::StokesModel<2> model({.cells = 3});
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(model.K.values.data()) % 64, 0u);
}

TEST(BlockCsr, DiagonalPartsAreThoseOfTheDenseMatrix) {
  const test::StokesModel<2> model({.cells = 3, .wind = 2});
  const Eigen::MatrixXd K = test::dense(model.K);
  const Eigen::MatrixXd A = test::dense(extract_diagonal_part<2>(model.K, 0));
  const Eigen::MatrixXd L = test::dense(extract_diagonal_part<1>(model.K, 2));
  for (int i = 0; i < L.rows(); ++i)
    for (int j = 0; j < L.cols(); ++j) {
      EXPECT_EQ(L(i, j), K(3 * i + 2, 3 * j + 2));
      EXPECT_EQ(A.block(2 * i, 2 * j, 2, 2), K.block(3 * i, 3 * j, 2, 2));
    }
}
}  // namespace
