// C K_s C^T against dense products, and its exact linearisation against differences.
#include <gtest/gtest.h>

#include "ifsi/coupling/coupling_matrix.hpp"
#include "scattered.hpp"

namespace {
using namespace ifsi;

/// Solid nodes all over the mesh in cells of three and of four, so that cells reach far beyond the ghost
/// layer.
template <class Element>
struct Solid : testing::Test, sample::Scattered<Element> {
  static constexpr int dim = Element::dim, B = dim + 1;
  using Point = Vec<double, dim>;
  using Block = Mat<double, dim>;

  sample::Random random{8};
  std::vector<Point> x = sample::positions(this->global, random, 3);
  int n_points = static_cast<int>(x.size());
  SolidCells cells = some_cells();
  std::vector<std::vector<Block>> K = element_matrices();
  std::vector<Block> P = blocks(n_points);  ///< one per solid node
  CouplingMatrix<Element> matrix{this->C, cells};

  SolidCells some_cells() {
    std::vector<std::array<int, 3>> triangles;
    for (int p = 0; p + 2 < n_points / 2; p += 2) triangles.push_back({p, p + 1, p + 2});
    std::vector<std::array<int, 4>> quads;
    for (int q = 0; q < 20; ++q)
      quads.push_back({random.below(n_points / 2), q, n_points / 2 - 1 - q, n_points / 2 - 40 + q});
    SolidCells list;
    list.append(triangles);
    list.append(quads, n_points - n_points / 2);
    return list;
  }
  std::vector<Block> blocks(int n) {
    std::vector<Block> all(n);
    for (Block& b : all)
      for (double& entry : b.data) entry = random.between(-1, 1);
    return all;
  }
  std::vector<std::vector<Block>> element_matrices() {
    std::vector<std::vector<Block>> all;
    for (int c = 0; c < cells.size(); ++c)
      all.push_back(blocks(static_cast<int>(cells[c].size() * cells[c].size())));
    return all;
  }

  /// Blocks between global nodes of the whole mesh, numbered by input point.
  using Dense = std::vector<Block>;
  Dense zeros() const { return Dense(this->global.n_points() * this->global.n_points(), Block::zero()); }
  Block& at(Dense& A, long row, long col) const {
    return A[this->input_of_whole(row) * this->global.n_points() + this->input_of_whole(col)];
  }

  /// C K (P) C^T from rows found on this rank alone.
  Dense dense_product(bool with_P) {
    Dense A = zeros();
    for (int c = 0; c < cells.size(); ++c) {
      const int n = static_cast<int>(cells[c].size());
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
          const auto &left = this->C_whole.row(cells[c][a]), &right = this->C_whole.row(cells[c][b]);
          if (!left.found() || !right.found()) continue;
          const Block K_ab = with_P ? K[c][a * n + b] * P[cells[c][b]] : K[c][a * n + b];
          for (int i = 0; i < Element::n_nodes; ++i)
            for (int j = 0; j < Element::n_nodes; ++j)
              at(A, left.node[i], right.node[j]) += left.N[i] * right.N[j] * K_ab;
        }
    }
    return A;
  }

  void assemble(bool with_P) {
    matrix.set_zero();
    for (size_t i = 0; i < matrix.relevant_cells().size(); ++i) {
      const Block* K_e = K[matrix.relevant_cells()[i]].data();
      with_P ? matrix.add(static_cast<int>(i), K_e, P) : matrix.add(static_cast<int>(i), K_e);
    }
  }

  /// Owned rows, entry by entry; what the pattern lacks must be zero, the pressure too.
  void expect_equal(const Dense& expected, double tolerance) {
    const std::vector<int> input = this->input_of_nodes();
    const BlockCsr<B>& A = matrix.matrix();
    ASSERT_EQ(A.n_rows(), this->mesh.n_owned_nodes());
    for (int row = 0; row < A.n_rows(); ++row) {
      std::vector<Block> line(this->global.n_points(), Block::zero());
      for (int k = A.row_ptr()[row]; k < A.row_ptr()[row + 1]; ++k) {
        if (k > A.row_ptr()[row]) {
          EXPECT_LT(A.cols()[k - 1], A.cols()[k]);
        }
        Block& block = line[input[A.layout().global(A.cols()[k])]];
        for (int i = 0; i < B; ++i)
          for (int j = 0; j < B; ++j)
            if (i < dim && j < dim)
              block(i, j) = A.at(k)[i * B + j];
            else
              EXPECT_EQ(A.at(k)[i * B + j], 0.0);
      }
      const Block* expected_line = &expected[this->mesh.input_point[row] * this->global.n_points()];
      for (int col = 0; col < this->global.n_points(); ++col)
        for (int e = 0; e < dim * dim; ++e)
          EXPECT_NEAR(line[col].data[e], expected_line[col].data[e], tolerance);
    }
  }
};
using SolidElements = testing::Types<Quad1, Tri2, Tet1, Hex1>;
TYPED_TEST_SUITE(Solid, SolidElements);

TYPED_TEST(Solid, MatrixIsTheDenseProduct) {
  this->locate(this->x);
  EXPECT_TRUE(this->matrix.update());
  this->assemble(false);
  this->expect_equal(this->dense_product(false), 1e-14);
}

TYPED_TEST(Solid, TheRightSideMayHaveAMatrixPerNode) {
  this->locate(this->x);
  this->matrix.update();
  this->assemble(true);
  this->expect_equal(this->dense_product(true), 1e-14);
}

TYPED_TEST(Solid, FollowsTheSolidAndKeepsItsPatternWhileItCan) {
  this->locate(this->x);
  this->matrix.update();
  for (auto& y : this->x) y[0] += y[0] < 0.5 ? 1e-9 : -1e-9;  // within the cells, or across a face: both
  const long revision = this->C.revision();
  this->locate(this->x);
  EXPECT_EQ(this->matrix.update(), this->C.revision() != revision);
  EXPECT_FALSE(this->matrix.update());
  this->assemble(false);
  this->expect_equal(this->dense_product(false), 1e-14);
  for (auto& y : this->x) y[1] = 0.7 * y[1] + 0.2;
  this->locate(this->x);
  EXPECT_TRUE(this->matrix.update());
  this->assemble(false);
  this->expect_equal(this->dense_product(false), 1e-14);
}

TYPED_TEST(Solid, OnlyCellsThatTouchOwnedNodesAreRelevant) {
  this->locate(this->x);
  this->matrix.update();
  std::vector<int> expected, rows;
  for (int c = 0; c < this->cells.size(); ++c) {
    bool touches = false;
    for (int p : this->cells[c])
      for (long node : this->C.row(p).node)
        touches =
            touches || (this->C.row(p).found() && this->mesh.nodes.owner(node) == this->mesh.comm.rank());
    if (touches) expected.push_back(c);
  }
  EXPECT_EQ(this->matrix.relevant_cells(), expected);
  for (int row = 0; row < this->matrix.matrix().n_rows(); ++row)
    if (this->matrix.matrix().row_ptr()[row] < this->matrix.matrix().row_ptr()[row + 1]) rows.push_back(row);
  EXPECT_EQ(this->matrix.rows(), rows);
}

TYPED_TEST(Solid, ProductWithAVector) {
  constexpr int B = TypeParam::dim + 1;
  this->locate(this->x);
  this->matrix.update();
  this->assemble(false);
  const int n = this->mesh.n_owned_nodes() * B;
  std::vector<double> x(n), y(n, 0.5), expected(n);
  for (int i = 0; i < n; ++i) x[i] = std::sin(3.0 * (this->mesh.nodes.first_global() * B + i));
  this->matrix.add_product(x.data(), y.data());
  std::vector<double> with_ghosts(this->matrix.matrix().layout().n_local() * B);
  std::copy(x.begin(), x.end(), with_ghosts.begin());
  this->matrix.matrix().apply(with_ghosts.data(), expected.data());
  for (int i = 0; i < n; ++i) EXPECT_NEAR(y[i], 0.5 + expected[i], 1e-13);
}

/// d(C R)/dv with du_A = P_A (C^T dv)_A, by central differences in the position of the nodes, which the shape
/// functions follow as long as no node leaves its cell.
TYPED_TEST(Solid, SpreadingIsLinearisedExactly) {
  constexpr int dim = TypeParam::dim, B = dim + 1;
  for (auto& y : this->x) {  // into the middle of the cells
    const auto X = this->global.cell_coordinates(this->random.below(this->global.n_cells()));
    y = map<TypeParam>(0.8 * TypeParam::center + 0.2 * sample::inside<TypeParam>(this->random), X);
  }
  this->x[3][0] = -1;  // and one lost
  this->locate(this->x);
  this->matrix.update();
  this->matrix.set_zero();
  std::vector<Vec<double, dim>> R(this->n_points, Vec<double, dim>::zero());
  for (int c = 0; c < this->cells.size(); ++c)
    for (int p : this->cells[c]) R[p] = this->random.template vector<dim>(-1, 1);
  this->matrix.add_spreading(R, this->P);

  const auto dv = this->nodal(this->mesh, B, [](Vec<double, dim> y) {
    for (int i = 0; i < dim; ++i) y[i] = std::cos(4 * y[i] + 3 * y[0]);
    return y;
  });
  auto du = this->C.velocities(dv.data(), B);
  for (int p = 0; p < this->n_points; ++p) du[p] = this->P[p] * du[p];
  const int n = this->mesh.n_owned_nodes() * B;
  std::vector<double> product(n), r(n), moved(n);
  this->matrix.add_product(dv.data(), product.data());

  const double eps = 1e-6;
  for (double side : {1.0, -1.0}) {
    auto y = this->x;
    for (int p = 0; p < this->n_points; ++p) y[p] += side * eps * du[p];
    EXPECT_EQ(this->C.locate(y).n_changed_cell, 0);
    std::fill(moved.begin(), moved.end(), 0.0);
    this->C.spread(R, moved.data(), B);
    for (int i = 0; i < n; ++i) r[i] += side * moved[i] / (2 * eps);
  }
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    EXPECT_NEAR(product[i], r[i], 1e-7);
    largest = std::max(largest, std::abs(r[i]));
  }
  EXPECT_GT(this->mesh.comm.max(largest), 1.0);
}

TEST(SolidCells, KeepBodiesAndKindsApart) {
  SolidCells cells;
  EXPECT_EQ(cells.size(), 0);
  cells.append(std::vector<std::array<int, 3>>{{0, 1, 2}, {2, 1, 3}});
  cells.append(std::vector<std::array<int, 2>>{{0, 1}}, 4);
  ASSERT_EQ(cells.size(), 3);
  EXPECT_EQ(std::vector<int>(cells[1].begin(), cells[1].end()), (std::vector<int>{2, 1, 3}));
  EXPECT_EQ(std::vector<int>(cells[2].begin(), cells[2].end()), (std::vector<int>{4, 5}));
}

TEST(CouplingMatrix, OfNoSolidIsEmpty) {
  sample::Scattered<Quad1> s;
  s.locate({});
  CouplingMatrix<Quad1> matrix(s.C, SolidCells());
  matrix.update();
  EXPECT_TRUE(matrix.relevant_cells().empty());
  std::vector<double> x(s.mesh.n_owned_nodes() * 3, 1.0), y = x;
  matrix.add_product(x.data(), y.data());
  EXPECT_EQ(x, y);
}
}  // namespace
