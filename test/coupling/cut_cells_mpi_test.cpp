// Cut cells and the field s around them, alike on all ranks; the ratio of solid to fluid mesh size.
#include <gtest/gtest.h>

#include <set>

#include "ifsi/coupling/cut_cells.hpp"
#include "ifsi/coupling/mesh_ratio.hpp"
#include "scattered.hpp"

namespace {
using namespace ifsi;

template <class Element>
struct Cut : testing::Test, sample::Scattered<Element> {
  using Point = Vec<double, Element::dim>;
  Cut()
      : sample::Scattered<Element>(
            sample::bent<Element>(sample::counts<Element::dim>(9 - 2 * Element::dim))) {}
  CutCells<Element> cut{this->mesh};
  sample::Random random{6};
  /// A few nodes near a corner of the box, one of them outside.
  std::vector<Point> x = [this] {
    std::vector<Point> nodes;
    for (int k = 0; k < 5; ++k) nodes.push_back(random.vector<Element::dim>(0.05, 0.3));
    nodes.push_back(random.vector<Element::dim>(-2, -1));
    return nodes;
  }();

  /// Layers by the definition, on the whole mesh, per input point.
  std::vector<int> layers_by_definition(int last) const {
    std::vector<int> layer(this->global.n_points(), std::numeric_limits<int>::max());
    for (int p = 0; p < this->C_whole.n_points(); ++p)
      if (this->C_whole.row(p).found())
        for (int point : this->global.cells[this->C_whole.row(p).cell]) layer[point] = 0;
    for (int k = 0; k < last; ++k)
      for (const auto& cell : this->global.cells) {
        bool touches = false;
        for (int point : cell) touches = touches || layer[point] == k;
        if (touches)
          for (int point : cell) layer[point] = std::min(layer[point], k + 1);
      }
    return layer;
  }
};
using CutElements = testing::Types<Tri1, Quad2, Hex1, Tet1>;
TYPED_TEST_SUITE(Cut, CutElements);

TYPED_TEST(Cut, CellsThatHoldANodeAreFlaggedOnEveryRankThatHasThem) {
  for (double shift : {0.0, 0.2, 0.5}) {  // the flags follow
    for (auto& y : this->x) y[0] += shift;
    this->locate(this->x);
    this->cut.update(this->C);
    std::set<long> expected;
    for (int p = 0; p < this->C_whole.n_points(); ++p) expected.insert(this->C_whole.row(p).cell);
    std::vector<int> flagged;
    for (int c = 0; c < this->mesh.n_cells(); ++c) {
      EXPECT_EQ(this->cut[c], expected.count(this->mesh.input_cell[c]) == 1);
      if (this->cut[c]) flagged.push_back(c);
    }
    EXPECT_EQ(this->cut.cells(), flagged);
  }
}

TYPED_TEST(Cut, LayersAreThoseOfTheWholeMesh) {
  this->locate(this->x);
  this->cut.update(this->C);
  for (int last = 0; last < 5; ++last) {
    const auto layer = this->cut.layers(last), expected = this->layers_by_definition(last);
    for (int i = 0; i < this->mesh.n_nodes(); ++i) EXPECT_EQ(layer[i], expected[this->mesh.input_point[i]]);
  }
}

TYPED_TEST(Cut, RingsOfCellsFollowTheLayers) {
  this->locate(this->x);
  this->cut.update(this->C);
  EXPECT_EQ(this->cut.with_rings(0), this->cut.cells());
  const auto layer = this->layers_by_definition(9);
  for (int rings = 1; rings < 4; ++rings) {
    std::vector<int> expected;
    for (int c = 0; c < this->mesh.n_cells(); ++c) {
      bool touches = false;
      for (int node : this->mesh.cells[c]) touches = touches || layer[this->mesh.input_point[node]] < rings;
      if (touches) expected.push_back(c);
    }
    EXPECT_EQ(this->cut.with_rings(rings), expected);
  }
}

TYPED_TEST(Cut, TheFieldFollowsTheLayers) {
  this->locate(this->x);
  this->cut.update(this->C);
  const StabilisationScale scale{100.0, 1, 2};
  const auto s = this->cut.stabilisation(scale);
  const auto layer = this->layers_by_definition(9);
  for (int i = 0; i < this->mesh.n_nodes(); ++i) {
    const int k = layer[this->mesh.input_point[i]];
    EXPECT_DOUBLE_EQ(s[i], k <= 1 ? 100.0 : k == 2 ? 10.0 : 1.0);
  }
}

TEST(StabilisationScale, FallsFromTheSolidToOne) {
  const StabilisationScale scale{1e4, 2, 4};
  EXPECT_DOUBLE_EQ(scale.at_layer(0), 1e4);
  EXPECT_DOUBLE_EQ(scale.at_layer(2), 1e4);
  EXPECT_DOUBLE_EQ(scale.at_layer(4), 1e2);  // half-way in the logarithm
  EXPECT_DOUBLE_EQ(scale.at_layer(6), 1.0);
  EXPECT_DOUBLE_EQ(scale.at_layer(std::numeric_limits<int>::max()), 1.0);
  for (int k = 2; k < 6; ++k) EXPECT_GT(scale.at_layer(k), scale.at_layer(k + 1));
  EXPECT_DOUBLE_EQ((StabilisationScale{50.0, 0, 1}.at_layer(0)), 50.0);
  EXPECT_DOUBLE_EQ((StabilisationScale{50.0, 0, 1}.at_layer(1)), 1.0);
  EXPECT_DOUBLE_EQ((StabilisationScale{}.at_layer(0)), 1.0);
}

TEST(CutCells, WithoutASolidThereAreNoneAndSIsOne) {
  sample::Scattered<Quad1> s;
  s.locate({});
  CutCells<Quad1> cut(s.mesh);
  cut.update(s.C);
  EXPECT_TRUE(cut.cells().empty());
  for (double value : cut.stabilisation({1000.0, 1, 1})) EXPECT_EQ(value, 1.0);
}

/// One solid cell of the given size in a straight mesh with cells of size 1/n.
template <class SolidElement, class FluidElement>
double ratio_of(double h_s, std::array<int, FluidElement::dim> n) {
  constexpr int dim = FluidElement::dim;
  const auto mesh = distribute(sample::straight<FluidElement>(n), Communicator());
  Interpolation<FluidElement> C(mesh);
  std::vector<Vec<double, dim>> x(3, Vec<double, dim>::zero());  // nodes of another body, first
  std::array<int, SolidElement::n_nodes> cell;
  for (int a = 0; a < SolidElement::n_nodes; ++a) {
    cell[a] = a;
    auto& y = x.emplace_back();
    for (int i = 0; i < dim; ++i)
      y[i] =
          0.31 + h_s * (i < SolidElement::dim ? SolidElement::nodes[a][i] - SolidElement::nodes[0][i] : 0.0);
  }
  C.locate(x);
  return mesh_ratio<SolidElement>(C, {cell}, 3).ratio;
}

TEST(MeshRatio, IsTheEdgeOfTheSolidOverTheCellsOfTheFluid) {
  EXPECT_NEAR((ratio_of<Quad1, Quad1>(0.03, {10, 10})), 0.6, 1e-12);  // reference edges are 2 long
  EXPECT_NEAR((ratio_of<Quad1, Quad1>(0.03, {10, 20})), 1.2, 1e-12);  // the direction counts
  EXPECT_NEAR((ratio_of<Quad2, Quad1>(0.03, {10, 10})), 0.3, 1e-12);  // neighbouring nodes: half an edge
  EXPECT_NEAR((ratio_of<Quad2, Quad2>(0.03, {10, 10})), 0.6, 1e-12);
  EXPECT_NEAR((ratio_of<Tri1, Quad1>(0.1, {10, 10})), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR((ratio_of<Line1, Quad1>(0.03, {10, 20})), 0.6, 1e-12);  // a thin body along x
  EXPECT_NEAR((ratio_of<Hex1, Hex1>(0.04, {5, 5, 10})), 0.8, 1e-12);
  EXPECT_NEAR((ratio_of<Wedge1, Hex1>(0.04, {5, 5, 5})), 0.4, 1e-12);
  EXPECT_NEAR((ratio_of<Tet1, Hex1>(0.1, {5, 5, 5})), 0.5 * std::sqrt(2.0), 1e-12);
}

TEST(MeshRatio, ATriangleOfTheFluidMeshHasRatioOneToItself) {
  // Equilateral fluid triangles; the solid's edges are theirs, turned by any angle.
  GlobalMesh<Tri1> global;
  const double h = 0.5 * std::sqrt(3.0);
  global.points = {{-1, 0}, {1, 0}, {0, 2 * h}, {2, 2 * h}};
  global.cells = {{0, 1, 2}, {1, 3, 2}};
  const auto mesh = distribute(global, Communicator(MPI_COMM_SELF));
  Interpolation<Tri1> C(mesh);
  for (double angle : {0.0, 0.7, 1.3}) {
    C.locate(std::vector<Vec<double, 2>>{{0, 0.3}, {0.8 * std::cos(angle), 0.3 + 0.8 * std::sin(angle)}});
    EXPECT_NEAR(mesh_ratio<Line1>(C, {{0, 1}}).ratio, 0.4, 1e-12);
  }
}

TEST(MeshRatio, SaysWhereItIsLargest) {
  sample::Scattered<Quad1> s(sample::straight<Quad1>({10, 10}));
  const std::vector<Vec<double, 2>> x{{0.1, 0.1}, {0.15, 0.1}, {0.3, 0.1}, {-5, 0.1}, {0.3, 0.5}};
  s.locate(x);
  const auto worst = mesh_ratio<Line1>(s.C, {{0, 1}, {1, 2}, {3, 3}, {2, 1}});
  EXPECT_NEAR(worst.ratio, 1.5, 1e-12);
  EXPECT_EQ(worst.cell, 1);
  EXPECT_NEAR(worst.position[0], 0.225, 1e-15);
  EXPECT_NEAR((mesh_ratio<Line1>(s.C, {{3, 2}}).ratio), 53.0, 1e-10);  // seen from the end that is inside
  EXPECT_EQ((mesh_ratio<Line1>(s.C, {{3, 3}}).cell), -1);
}
}  // namespace
