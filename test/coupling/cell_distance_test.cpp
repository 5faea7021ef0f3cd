// Distances to cells and boxes around them against dense samples of the cell.
#include "ifsi/coupling/cell_distance.hpp"

#include <gtest/gtest.h>

#include "ifsi/coupling/bounding_box.hpp"
#include "sample_meshes.hpp"

namespace {
using namespace ifsi;

template <class Element>
struct CellShape : testing::Test {};
using Elements = testing::Types<Tri1, Tri2, Quad1, Quad2, Tet1, Tet2, Hex1, Hex2, Wedge1>;
TYPED_TEST_SUITE(CellShape, Elements);

/// Calls visit with the positions of a fine grid on the reference cell, its boundary included.
template <class Element, class Visit>
void for_each_sample(int n, Visit&& visit) {
  int total = 1;
  for (int d = 0; d < Element::dim; ++d) total *= n + 1;
  for (int k = 0; k < total; ++k) {
    Vec<double, Element::dim> xi;
    for (int d = 0, rest = k; d < Element::dim; ++d, rest /= n + 1) xi[d] = -1 + 2.0 * (rest % (n + 1)) / n;
    if (Element::contains(xi, 1e-12)) visit(xi);
  }
}

/// Nodes of a cell turned and bent out of shape: curved edges when the element has them.
template <class Element>
std::array<Vec<double, Element::dim>, Element::n_nodes> crooked_cell(int seed) {
  sample::Random random(seed);
  std::array<Vec<double, Element::dim>, Element::n_nodes> X;
  for (int a = 0; a < Element::n_nodes; ++a)
    X[a] = Element::nodes[a] + random.vector<Element::dim>(-0.1, 0.1);
  return X;
}

TYPED_TEST(CellShape, DistanceIsThatOfTheNearestPointOfTheCell) {
  using Element = TypeParam;
  constexpr int dim = Element::dim, n = dim == 2 ? 200 : 40;
  sample::Random random(11);
  for (int seed = 0; seed < 4; ++seed) {
    const auto X = crooked_cell<Element>(seed);
    for (int trial = 0; trial < 8; ++trial) {
      using Cube = std::conditional_t<dim == 2, Quad1, Hex1>;
      const Vec<double, dim> position = (trial % 2 ? 2.0 : 4.0) * sample::on_face<Cube>(random);
      double sampled = 1e300;
      for_each_sample<Element>(n, [&](const auto& xi) {
        const auto gap = map<Element>(xi, X) - position;
        sampled = std::min(sampled, std::sqrt(dot(gap, gap)));
      });
      const double distance = distance_to_faces<Element>(X, position);
      EXPECT_LE(distance, sampled + 1e-9);
      EXPECT_GE(distance, sampled - 4.0 / n);
    }
  }
}

TYPED_TEST(CellShape, DistanceToAStraightCellIsExact) {
  using Element = TypeParam;
  std::array<Vec<double, Element::dim>, Element::n_nodes> X = Element::nodes;
  for (auto& x : X) x[0] *= 3.0;  // long cells too
  auto vertex = X[0];
  vertex[0] -= 3.0, vertex[1] -= 4.0;
  EXPECT_NEAR(distance_to_faces<Element>(X, vertex), 5.0, 1e-12);
  auto below = 0.5 * (X[0] + X[1]);
  below[1] -= 0.25;
  EXPECT_NEAR(distance_to_faces<Element>(X, below), 0.25, 1e-12);
}

TYPED_TEST(CellShape, BoxHoldsTheWholeCellAndNotMuchMore) {
  using Element = TypeParam;
  for (int seed = 0; seed < 20; ++seed) {
    const auto X = crooked_cell<Element>(seed);
    const auto cell = cell_box<Element>(X, 0.0);
    Box<Element::dim> hull;
    for_each_sample<Element>(24, [&](const auto& xi) {
      const auto x = map<Element>(xi, X);
      hull.extend(x);
      EXPECT_TRUE(cell.contains(x));
    });
    EXPECT_LT(cell.radius(), (Element::order == 1 ? 1.0 + 1e-12 : 2.0) * hull.radius());
  }
}

TEST(Box, KnowsWhatItHolds) {
  Box<2> box;
  EXPECT_FALSE(box.contains({0, 0}));
  box.extend({0, 1});
  box.extend({2, -1});
  EXPECT_TRUE(box.contains({2, 1}));
  EXPECT_FALSE(box.contains({2, 1.0000001}));
  EXPECT_FALSE(box.contains({std::nan(""), 0}));
  Box<2> joined;
  joined.extend(box);
  joined.extend(Box<2>());
  EXPECT_EQ(joined.lower, box.lower);
  EXPECT_EQ(joined.upper, box.upper);
}
}  // namespace
