// PointLocator against a look into every cell, with awkward positions swept.
#include "ifsi/coupling/point_locator.hpp"

#include <gtest/gtest.h>

#include "sample_meshes.hpp"

namespace {
using namespace ifsi;

/// The lowest of all cells that hold x within the tolerance, -1 if none does.
template <class Element>
int brute_force(const GlobalMesh<Element>& mesh, const Vec<double, Element::dim>& x) {
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto inverse = inverse_map<Element>(mesh.cell_coordinates(c), x);
    if (inverse.converged && Element::contains(inverse.xi, PointLocator<Element>::tolerance)) return c;
  }
  return -1;
}

template <class Element>
struct Located : testing::Test {
  static constexpr int dim = Element::dim;
  GlobalMesh<Element> global = sample::bent<Element>(sample::counts<dim>(dim == 2 ? 6 : 2));
  Mesh<Element> mesh = distribute(global, Communicator(MPI_COMM_SELF));
  PointLocator<Element> locator{mesh};
  sample::Random random{1};

  /// Every so many cells are looked at.
  int every = 1 + global.n_cells() / 9;

  /// Input number of the cell that is found, after checking that x is there.
  int cell_of(const Vec<double, dim>& x, int near = -1) {
    const auto at = locator.find(x, near);
    if (!at.found()) return -1;
    EXPECT_TRUE(Element::contains(at.xi, locator.tolerance));
    const auto gap = map<Element>(at.xi, mesh.cell_coordinates(at.cell)) - x;
    EXPECT_LT(std::sqrt(dot(gap, gap)), 1e-14);
    return mesh.input_cell[at.cell];
  }
};
using Elements = testing::Types<Tri1, Tri2, Quad1, Quad2, Tet1, Tet2, Hex1, Hex2, Wedge1>;
TYPED_TEST_SUITE(Located, Elements);

TYPED_TEST(Located, PositionsInsideCells) {
  using Element = TypeParam;
  for (int trial = 0; trial < 300; ++trial) {
    const int c = this->random.below(this->global.n_cells());
    const auto xi = 0.99 * (sample::inside<Element>(this->random) - Element::center) + Element::center;
    EXPECT_EQ(this->cell_of(map<Element>(xi, this->global.cell_coordinates(c))), c);
  }
}

TYPED_TEST(Located, OnVerticesEdgesAndFacesTheLowestCellIsTaken) {
  using Element = TypeParam;
  for (int c = 0; c < this->global.n_cells(); c += this->every)
    for (const auto& xi : sample::awkward<Element>(this->random)) {
      const auto x = map<Element>(xi, this->global.cell_coordinates(c));
      const int cell = this->cell_of(x);
      EXPECT_GE(cell, 0);
      EXPECT_LE(cell, c);
      EXPECT_EQ(cell, brute_force(this->global, x));
    }
}

TYPED_TEST(Located, ALittleOffVerticesEdgesAndFaces) {
  using Element = TypeParam;
  for (int c = 1; c < this->global.n_cells(); c += this->every)
    for (const auto& xi : sample::awkward<Element>(this->random))
      for (double off : {1e-15, 1e-12, 1e-9, 1e-6}) {
        const auto x = map<Element>(xi, this->global.cell_coordinates(c)) +
                       off * this->random.template vector<Element::dim>(-1, 1);
        const int cell = this->cell_of(x), expected = brute_force(this->global, x);
        EXPECT_EQ(cell, expected) << "off by " << off;
        if (off <= 1e-12) {
          EXPECT_GE(cell, 0);  // also beyond the boundary of the mesh
        }
      }
}

TYPED_TEST(Located, TheAnswerDoesNotDependOnWhereTheSearchBegins) {
  using Element = TypeParam;
  for (int c = 0; c < this->global.n_cells(); c += this->every)
    for (const auto& xi : sample::awkward<Element>(this->random)) {
      const auto x = map<Element>(xi, this->global.cell_coordinates(c));
      const auto at = this->locator.find(x);
      for (int near = 0; near < this->mesh.n_cells(); near += 1 + this->random.below(12)) {
        const auto again = this->locator.find(x, near);
        EXPECT_EQ(again.cell, at.cell);
        EXPECT_EQ(again.xi, at.xi);
      }
    }
}

TYPED_TEST(Located, TrackingFindsInteriorsOfNeighboursAndNothingElse) {
  using Element = TypeParam;
  const auto shared_vertex = [&](int c, int d) {
    for (int a = 0; a < Element::n_vertices; ++a)
      for (int b = 0; b < Element::n_vertices; ++b)
        if (this->mesh.cells[c][a] == this->mesh.cells[d][b]) return true;
    return false;
  };
  int n_near = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int c = this->random.below(this->mesh.n_cells()), d = this->random.below(this->mesh.n_cells());
    const auto X = this->mesh.cell_coordinates(c);
    const auto xi = 0.9 * (sample::inside<Element>(this->random) - Element::center) + Element::center;
    EXPECT_EQ(this->locator.track(map<Element>(xi, X), d).cell, shared_vertex(c, d) ? c : -1);
    EXPECT_FALSE(this->locator.track(X[0], c).found());
    n_near += shared_vertex(c, d);
  }
  EXPECT_GT(n_near, 10);
}

TYPED_TEST(Located, PositionsOutsideAreNotFoundAndTheirDistanceIsKnown) {
  using Element = TypeParam;
  constexpr int dim = Element::dim;
  const auto mesh =
      distribute(sample::straight<Element>(sample::counts<dim>(3)), Communicator(MPI_COMM_SELF));
  const PointLocator<Element> locator(mesh);
  for (int trial = 0; trial < 100; ++trial) {
    auto x = this->random.template vector<dim>(0, 1);
    double expected = 0;
    for (int i = 0; i < dim; ++i) {
      const double off = this->random.between(-2, 2) * (trial % 10 == 0 ? 1e-7 : 1);
      if (this->random() < 0.5 && (i > 0 || expected > 0)) continue;
      x[i] = off > 0 ? 1 + off : off;
      expected += off * off;
    }
    EXPECT_FALSE(locator.find(x).found());
    EXPECT_NEAR(locator.distance(x), std::sqrt(expected), 1e-12);
  }
}

TEST(PointLocator, CellsOfVeryDifferentSizeAndShape) {
  // 14 octaves of cell size along x, cells up to 2e4 times longer than wide.
  Axis x{0}, y{0, 0.25, 0.5, 1};
  for (double h = 1e-5; x.back() < 1; h *= 2) x.push_back(x.back() + h);
  const auto global = box<Quad1>({x, y});
  const auto mesh = distribute(global, Communicator(MPI_COMM_SELF));
  const PointLocator<Quad1> locator(mesh);
  sample::Random random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    const int c = random.below(global.n_cells());
    const auto xi = trial % 2 ? 0.999 * sample::inside<Quad1>(random) : sample::on_face<Quad1>(random);
    const auto position = map<Quad1>(xi, global.cell_coordinates(c));
    const auto at = locator.find(position);
    ASSERT_TRUE(at.found());
    EXPECT_EQ(mesh.input_cell[at.cell], brute_force(global, position));
  }
}

TEST(PointLocator, FarFromTheOrigin) {
  auto global = sample::straight<Quad1>({7, 9});
  for (auto& x : global.points) x += Vec<double, 2>{3e4, -2e4};
  const auto mesh = distribute(global, Communicator(MPI_COMM_SELF));
  const PointLocator<Quad1> locator(mesh);
  sample::Random random(5);
  for (int c = 0; c < global.n_cells(); ++c)
    for (const auto& xi : sample::awkward<Quad1>(random)) {
      const auto at = locator.find(map<Quad1>(xi, global.cell_coordinates(c)));
      ASSERT_TRUE(at.found());
      EXPECT_LE(mesh.input_cell[at.cell], c);
    }
}

TEST(PointLocator, InAPeriodicMeshPositionsStayWhereTheyAre) {
  const auto global = box<Quad1>({0, 0}, {1, 1}, {4, 4}, {{true, true}, Diagonals::uniform});
  const auto mesh = distribute(global, Communicator(MPI_COMM_SELF));
  const PointLocator<Quad1> locator(mesh);
  sample::Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const auto x = random.vector<2>(0, 1);
    EXPECT_EQ(mesh.input_cell[locator.find(x).cell], brute_force(global, x));
  }
  EXPECT_FALSE(locator.find({1.01, 0.5}).found());
}
}  // namespace
