// C^lambda: the identities it must satisfy to round-off, and the same rows on any number of ranks.
#include <gtest/gtest.h>

#include "ifsi/coupling/interpolation.hpp"
#include "scattered.hpp"

namespace {
using namespace ifsi;

template <class Element>
struct Coupled : testing::Test, sample::Scattered<Element> {
  using Base = sample::Scattered<Element>;
  static constexpr int dim = Element::dim, stride = dim + 1;
  using Point = Vec<double, dim>;
  sample::Random random{4};
  std::vector<Point> x = sample::positions(this->global, random, 7);

  void expect_rows_equal_those_of_one_rank() {
    const std::vector<int> input = this->input_of_nodes();
    for (int p = 0; p < this->C.n_points(); ++p) {
      const auto &row = this->C.row(p), &expected = this->C_whole.row(p);
      EXPECT_EQ(row.point, p);
      EXPECT_EQ(row.cell, expected.cell);
      EXPECT_EQ(row.N, expected.N);
      EXPECT_EQ(row.grad_N, expected.grad_N);
      if (!row.found()) continue;
      for (int b = 0; b < Element::n_nodes; ++b)
        EXPECT_EQ(input[row.node[b]], this->input_of_whole(expected.node[b]));
    }
    EXPECT_EQ(this->C.lost(), this->C_whole.lost());
  }
};
using CoupledElements = testing::Types<Tri2, Quad1, Tet1, Hex1>;
TYPED_TEST_SUITE(Coupled, CoupledElements);

TYPED_TEST(Coupled, RowsDoNotDependOnThePartition) {
  this->locate(this->x);
  EXPECT_EQ(this->C.lost().size(), 7u);
  this->expect_rows_equal_those_of_one_rank();
}

TYPED_TEST(Coupled, RowsSumToOneAndTheirGradientsToZero) {
  this->locate(this->x);
  for (int p = 0; p < this->C.n_points(); ++p) {
    const auto& row = this->C.row(p);
    double sum = 0;
    auto sum_grad = Vec<double, TypeParam::dim>::zero();
    for (int b = 0; b < TypeParam::n_nodes; ++b) sum += row.N[b], sum_grad += row.grad_N[b];
    EXPECT_NEAR(sum, row.found() ? 1.0 : 0.0, 1e-14);
    EXPECT_LT(std::sqrt(dot(sum_grad, sum_grad)), 1e-11);
  }
}

TYPED_TEST(Coupled, ALinearFieldAndItsGradientAreExact) {
  constexpr int dim = TypeParam::dim;
  this->locate(this->x);
  Mat<double, dim> L;
  for (double& entry : L.data) entry = this->random.between(-2, 2);
  const auto field = [&](const Vec<double, dim>& y) {
    Vec<double, dim> v = L * y;
    v[0] += 3;
    return v;
  };
  const auto v = this->nodal(this->mesh, this->stride, field);
  const auto v_s = this->C.velocities(v.data(), this->stride);
  const auto grad_v = this->C.velocity_gradients(v.data(), this->stride);
  for (int p = 0; p < this->C.n_points(); ++p) {
    const bool found = this->C.row(p).found();
    const Vec<double, dim> expected = found ? field(this->x[p]) : Vec<double, dim>::zero();
    for (int i = 0; i < dim; ++i) EXPECT_NEAR(v_s[p][i], expected[i], 2e-14);
    for (int k = 0; k < dim * dim; ++k) EXPECT_NEAR(grad_v[p].data[k], found ? L.data[k] : 0, 1e-12);
  }
}

TYPED_TEST(Coupled, SpreadForcesKeepTheirSumAndTheirPower) {
  constexpr int dim = TypeParam::dim, stride = dim + 1;
  this->locate(this->x);
  std::vector<Vec<double, dim>> f;
  for (size_t p = 0; p < this->x.size(); ++p) f.push_back(this->random.template vector<dim>(-1, 1));
  const auto v = this->nodal(this->mesh, stride, [](const Vec<double, dim>& y) {
    Vec<double, dim> u;
    for (int i = 0; i < dim; ++i) u[i] = std::sin(5 * y[i] + 2 * y[0]);
    return u;
  });
  std::vector<double> r(this->mesh.n_owned_nodes() * stride, 0.0);
  this->C.spread(f, r.data(), stride);

  double power = 0, pressure_rows = 0;
  auto sum = Vec<double, dim>::zero(), expected = sum;
  for (int i = 0; i < this->mesh.n_owned_nodes(); ++i) {
    for (int d = 0; d < dim; ++d) sum[d] += r[i * stride + d], power += r[i * stride + d] * v[i * stride + d];
    pressure_rows += std::abs(r[i * stride + dim]);
  }
  const auto v_s = this->C.velocities(v.data(), stride);
  double expected_power = 0;
  for (int p = 0; p < this->C.n_points(); ++p)
    if (this->C.row(p).found()) expected += f[p], expected_power += dot(f[p], v_s[p]);
  for (int d = 0; d < dim; ++d) EXPECT_NEAR(this->mesh.comm.sum(sum[d]), expected[d], 1e-13);
  EXPECT_NEAR(this->mesh.comm.sum(power), expected_power, 1e-12);
  EXPECT_EQ(this->mesh.comm.sum(pressure_rows), 0.0);
}

TYPED_TEST(Coupled, VelocitiesAndSpreadForcesDoNotDependOnThePartition) {
  constexpr int dim = TypeParam::dim, stride = dim;
  this->locate(this->x);
  const auto field = [](Vec<double, dim> y) {
    for (int i = 0; i < dim; ++i) y[i] = std::cos(7 * y[i]);
    return y;
  };
  const auto v = this->nodal(this->mesh, stride, field), v_whole = this->nodal(this->whole, stride, field);
  const auto v_s = this->C.velocities(v.data(), stride);
  EXPECT_EQ(v_s, this->C_whole.velocities(v_whole.data(), stride));

  std::vector<double> r(this->mesh.n_owned_nodes() * stride), r_whole(this->whole.n_nodes() * stride);
  this->C.spread(v_s, r.data(), stride);
  this->C_whole.spread(v_s, r_whole.data(), stride);
  std::vector<int> whole_node(this->global.n_points());
  for (int i = 0; i < this->whole.n_nodes(); ++i) whole_node[this->whole.input_point[i]] = i;
  for (int i = 0; i < this->mesh.n_owned_nodes(); ++i)
    for (int d = 0; d < dim; ++d)
      EXPECT_EQ(r[i * stride + d], r_whole[whole_node[this->mesh.input_point[i]] * stride + d]);
}

TYPED_TEST(Coupled, AMovingCloudHasTheRowsOfAFreshSearch) {
  constexpr int dim = TypeParam::dim;
  this->locate(this->x);
  for (int step = 0; step < 12; ++step) {
    // Some go to a vertex of the cell they are in; the others turn about the middle, by a small part of a
    // cell at first and by several cells at last, and may leave the mesh and return.
    const double angle = 1e-4 * std::pow(3.0, step), c = std::cos(angle), s = std::sin(angle);
    for (size_t p = 0; p < this->x.size(); p += 1 + p % 2) {
      auto& y = this->x[p];
      y = {{0.5 + c * (y[0] - 0.5) - s * (y[1] - 0.5), 0.5 + s * (y[0] - 0.5) + c * (y[1] - 0.5)}};
      if (dim == 3) y[dim - 1] = 0.1 + 0.8 * this->random();
      if (p % 5 < 2 && this->C.row(p).found())
        y = this->global.cell_coordinates(this->C.row(p).cell)[this->random.below(TypeParam::n_vertices)];
    }
    const auto report = this->C.locate(this->x);
    Interpolation<TypeParam> fresh(this->whole);
    fresh.locate(this->x);
    this->C_whole.locate(this->x);
    this->expect_rows_equal_those_of_one_rank();
    EXPECT_EQ(report.n_lost, static_cast<int>(fresh.lost().size()));
    for (int p = 0; p < fresh.n_points(); ++p) {
      EXPECT_EQ(this->C.row(p).cell, fresh.row(p).cell);
      EXPECT_EQ(this->C.row(p).N, fresh.row(p).N);
    }
  }
}

TYPED_TEST(Coupled, EachRowHasOneHolderAndOwnersKnowTheirPoints) {
  this->locate(this->x);
  const auto& nodes = this->mesh.nodes;
  std::vector<int> touching, holders;
  for (int p = 0; p < this->C.n_points(); ++p) {
    const auto& row = this->C.row(p);
    EXPECT_EQ(row.found(), row.holder >= 0);
    holders.push_back(row.holder);
    bool touches = false;
    for (long node : row.node)
      touches = touches || (row.found() && nodes.owner(node) == this->mesh.comm.rank());
    if (touches) touching.push_back(p);
  }
  EXPECT_EQ(this->C.owned_points(), touching);
  const std::vector<int> of_all = this->mesh.comm.all_gather(holders);
  for (size_t k = 0; k < of_all.size(); ++k) EXPECT_EQ(of_all[k], holders[k % holders.size()]);
}

TYPED_TEST(Coupled, ReportsWhatMovedAndWhatIsLost) {
  const int n = static_cast<int>(this->x.size());
  auto report = this->C.locate(this->x);
  EXPECT_EQ(report.n_moved, n);
  EXPECT_EQ(report.n_changed_cell, n - 7);
  EXPECT_EQ(report.n_lost, 7);
  const long revision = this->C.revision();

  report = this->C.locate(this->x);
  EXPECT_EQ(report.n_moved, 0);
  EXPECT_EQ(this->C.revision(), revision);

  const double N = this->C.row(0).N[0];
  this->x[0][0] += 1e-7;
  report = this->C.locate(this->x);
  EXPECT_EQ(report.n_moved, 1);
  EXPECT_EQ(report.n_changed_cell, 0);
  EXPECT_NE(this->C.row(0).N[0], N);
  EXPECT_EQ(this->C.revision(), revision);

  this->x[1][0] = -0.25;
  report = this->C.locate(this->x);
  EXPECT_EQ(report.n_changed_cell, 1);
  EXPECT_EQ(report.n_lost, 8);
  EXPECT_NE(this->C.revision(), revision);
  const auto lost = this->C.lost_points();
  EXPECT_EQ(lost.size(), 8u);
  EXPECT_EQ(lost[0].point, 1);
  EXPECT_EQ(lost[0].position, this->x[1]);
  EXPECT_NEAR(lost[0].distance, 0.25, 1e-12);
}

TYPED_TEST(Coupled, AnotherNumberOfNodesStartsAnew) {
  this->locate(this->x);
  const long revision = this->C.revision();
  this->x.erase(this->x.begin() + 3, this->x.end() - 4);
  this->locate(this->x);
  EXPECT_EQ(this->C.n_points(), 7);
  EXPECT_NE(this->C.revision(), revision);
  this->expect_rows_equal_those_of_one_rank();
  this->locate({});
  EXPECT_TRUE(this->C.velocities(nullptr, 3).empty());
}

TYPED_TEST(Coupled, RefusesPositionsThatAreNotFiniteAndForgetsThem) {
  this->locate(this->x);
  const auto good = this->x;
  this->x[2][0] += 0.1;
  this->x[5][1] = std::nan("");
  try {
    this->C.locate(this->x);
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::invalid_state);
    EXPECT_NE(std::string(e.what()).find("solid node 5"), std::string::npos) << e.what();
  }
  this->x[5] = good[5];
  EXPECT_EQ(this->C.locate(this->x).n_moved, 1);
}
}  // namespace
