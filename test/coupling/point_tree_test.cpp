// PointTree against a look at every point.
#include "ifsi/coupling/point_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "sample_meshes.hpp"

namespace {
using namespace ifsi;

template <int dim>
void compare_with_brute_force() {
  sample::Random random(3);
  std::vector<Vec<double, dim>> points;
  for (int i = 0; i < 500; ++i) points.push_back(random.vector<dim>(-1, 2));
  points.push_back(points[17]);  // twice the same
  const PointTree<dim> tree(points);
  for (int trial = 0; trial < 200; ++trial) {
    const auto x = random.vector<dim>(-2, 3);
    const double radius = random.between(0.01, 2);
    const auto distance2 = [&](int i) { return dot(points[i] - x, points[i] - x); };
    std::vector<int> all(points.size()), expected;
    std::iota(all.begin(), all.end(), 0);
    std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                 [&](int i) { return distance2(i) < radius * radius; });
    std::vector<int> found = tree.within(x, radius);
    for (size_t i = 1; i < found.size(); ++i) EXPECT_LE(distance2(found[i - 1]), distance2(found[i]));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    const int nearest =
        *std::min_element(all.begin(), all.end(), [&](int i, int j) { return distance2(i) < distance2(j); });
    EXPECT_EQ(distance2(tree.nearest(x)), distance2(nearest));
  }
}

TEST(PointTree, FindsTheSamePointsAsBruteForceInThePlane) { compare_with_brute_force<2>(); }
TEST(PointTree, FindsTheSamePointsAsBruteForceInSpace) { compare_with_brute_force<3>(); }

TEST(PointTree, OfNoPointsFindsNothing) {
  const PointTree<2> tree({});
  EXPECT_TRUE(tree.within({0, 0}, 1e9).empty());
  EXPECT_EQ(tree.nearest({0, 0}), -1);
}
}  // namespace
