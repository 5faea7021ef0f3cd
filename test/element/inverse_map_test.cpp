/// \file
/// The inverse map on random distorted and curved cells, at awkward places, and where it has to say no.

#include "ifsi/element/inverse_map.hpp"

#include "element/samples.hpp"

namespace ifsi {
namespace {

using test::norm, test::random_cell, test::random_point;

/// Not inlined: that would only cost compile time.
template <class E>
[[gnu::noinline]] InverseMap<E::dim> find(const test::CellNodes<E>& X, const Vec<double, E::dim>& x) {
  return inverse_map<E>(X, x);
}

/// Node movement near the limit at which random cells are still valid.
template <class E>
constexpr double mapped_distortion = E::order == 1
                                         ? (E::shape == Shape::hex || E::shape == Shape::wedge ? 0.35 : 0.5)
                                     : E::shape == Shape::line || E::shape == Shape::triangle ? 0.12
                                     : E::shape == Shape::tet                                 ? 0.08
                                     : E::shape == Shape::hex                                 ? 0.15
                                                                                              : 0.25;

template <class E>
class InverseMapTest : public ::testing::Test {
 public:
  static constexpr int n_cells = E::n_nodes > 20 ? 8 : 40;
  std::mt19937 random{3};
};
TYPED_TEST_SUITE(InverseMapTest, test::Cells, test::ElementName);

TYPED_TEST(InverseMapTest, FindsEveryPointOfDistortedCells) {
  using E = TypeParam;
  for (int cell = 0; cell < this->n_cells; ++cell) {
    const auto X = random_cell<E>(this->random, mapped_distortion<E>);
    for (int sample = 0; sample < 50; ++sample) {
      const auto xi = random_point<E>(this->random);
      const auto found = find<E>(X, map<E>(xi, X));
      ASSERT_TRUE(found.converged) << "cell " << cell << " sample " << sample;
      ASSERT_LE(norm(found.xi - xi), 1e-11);
      ASSERT_LE(found.distance, 1e-13);
    }
  }
}

TYPED_TEST(InverseMapTest, FindsNodesAndPointsJustOffThem) {
  using E = TypeParam;
  const auto X = random_cell<E>(this->random, mapped_distortion<E>);
  for (const auto& node : E::nodes)
    for (double off : {0.0, 1e-12, -1e-12, 1e-6, -1e-6}) {
      const auto xi = node + off * (node - E::center);
      const auto found = find<E>(X, map<E>(xi, X));
      ASSERT_TRUE(found.converged);
      EXPECT_LE(norm(found.xi - xi), 1e-13);
    }
}

TYPED_TEST(InverseMapTest, PointsOutsideGetCoordinatesOutside) {
  using E = TypeParam;
  for (int cell = 0; cell < this->n_cells; ++cell) {
    const auto X = random_cell<E>(this->random, 0.4 * mapped_distortion<E>);
    for (int sample = 0; sample < 20; ++sample) {
      const auto xi = random_point<E>(this->random, 1e-9, 0.15);
      const auto found = find<E>(X, map<E>(xi, X));
      ASSERT_TRUE(found.converged);
      ASSERT_LE(norm(found.xi - xi), 1e-11);
      ASSERT_FALSE(E::contains(found.xi, 0.0));
    }
  }
}

TYPED_TEST(InverseMapTest, NeverClaimsAPointItDoesNotReach) {
  using E = TypeParam;
  for (int cell = 0; cell < this->n_cells; ++cell) {
    const auto X = random_cell<E>(this->random, mapped_distortion<E>);
    for (int sample = 0; sample < 20; ++sample) {
      Vec<double, E::dim> x;
      for (int i = 0; i < E::dim; ++i) x[i] = test::uniform(this->random, -6.0, 6.0);
      const auto found = find<E>(X, x);
      const double distance = norm(map<E>(found.xi, X) - x);
      EXPECT_NEAR(found.distance, distance, 1e-10 * (1.0 + distance));
      EXPECT_LE(found.converged ? distance : 0.0, 1e-10);
      EXPECT_TRUE(found.converged || !E::linear);
    }
  }
}

TYPED_TEST(InverseMapTest, AnyGuessLeadsToThePoint) {
  using E = TypeParam;
  const auto X = random_cell<E>(this->random, mapped_distortion<E>);
  for (int sample = 0; sample < 50; ++sample) {
    const auto xi = random_point<E>(this->random), guess = random_point<E>(this->random, -1.0, 3.0);
    const auto found = inverse_map<E>(X, map<E>(xi, X), guess);
    ASSERT_TRUE(found.converged);
    ASSERT_LE(norm(found.xi - xi), 1e-11);
  }
}

/// A cell of 1e-5 far from the origin loses digits of the coordinates, no more.
TYPED_TEST(InverseMapTest, WorksFarFromTheOrigin) {
  using E = TypeParam;
  auto X = random_cell<E>(this->random, mapped_distortion<E>);
  for (auto& x : X)
    for (int i = 0; i < E::dim; ++i) x[i] = 10.0 + 1e-5 * x[i];
  for (int sample = 0; sample < 20; ++sample) {
    const auto xi = random_point<E>(this->random);
    const auto found = find<E>(X, map<E>(xi, X));
    ASSERT_TRUE(found.converged);
    ASSERT_LE(norm(found.xi - xi), 1e-8);
  }
}

TYPED_TEST(InverseMapTest, FlatCellsAndNansDoNotConverge) {
  using E = TypeParam;
  auto flat = E::nodes;
  for (auto& x : flat) x[0] = 0.0;
  EXPECT_FALSE(find<E>(flat, E::center).converged);
  auto x = E::center;
  x[0] = std::nan("");
  EXPECT_FALSE(find<E>(E::nodes, x).converged);
}

TYPED_TEST(InverseMapTest, MirroredCellsAreInvertedToo) {
  using E = TypeParam;
  auto mirrored = E::nodes;
  for (auto& x : mirrored) x[0] = -x[0];
  const auto xi = random_point<E>(this->random);
  const auto found = find<E>(mirrored, map<E>(xi, mirrored));
  ASSERT_TRUE(found.converged);
  EXPECT_LE(norm(found.xi - xi), 1e-12);
}

/// A 90 degree sector of an annulus in one biquadratic cell: Newton from the centre overshoots near its
/// corners.
TEST(InverseMapCurved, AnnulusSector) {
  test::CellNodes<Quad2> X;
  for (int a = 0; a < 9; ++a) {
    const double radius = 1.5 + 0.5 * Quad2::nodes[a][1], angle = -0.25 * M_PI * Quad2::nodes[a][0];
    X[a] = {radius * std::sin(-angle), radius * std::cos(angle)};
  }
  std::mt19937 random(4);
  for (int sample = 0; sample < 500; ++sample) {
    const auto xi = random_point<Quad2>(random);
    const auto found = find<Quad2>(X, map<Quad2>(xi, X));
    ASSERT_TRUE(found.converged);
    ASSERT_LE(norm(found.xi - xi), 1e-11);
  }
  EXPECT_FALSE(Quad2::contains(find<Quad2>(X, {0.0, 0.5}).xi, 0.01)) << "the hole is outside";
}

/// Cells so curved that Newton from the centre misses 1 point in 300: the restarts find all of them.
TEST(InverseMapCurved, CellsOnTheVergeOfFolding) {
  std::mt19937 random(8);
  for (int cell = 0; cell < 100; ++cell) {
    const auto X = random_cell<Quad2>(random, 0.6);
    for (int sample = 0; sample < 100; ++sample) {
      const auto found = find<Quad2>(X, map<Quad2>(random_point<Quad2>(random), X));
      ASSERT_TRUE(found.converged && Quad2::contains(found.xi, 1e-9)) << "cell " << cell;
    }
  }
}

/// The kite whose sides meet: far outside, no xi exists, and this is said.
TEST(InverseMapCurved, BeyondTheFoldThereIsNoRoot) {
  const test::CellNodes<Quad1> kite = {{{0, 0}, {1, 0}, {0.4, 0.4}, {0, 1}}};
  const auto found = find<Quad1>(kite, {5.0, 5.0});
  EXPECT_FALSE(found.converged && Quad1::contains(found.xi, 0.1));
  EXPECT_TRUE(std::isfinite(found.distance));
}

}  // namespace
}  // namespace ifsi
