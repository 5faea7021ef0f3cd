// Divisions of an interval, and the Hilbert curve.
#include "ifsi/mesh/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "ifsi/core/error.hpp"
#include "ifsi/mesh/hilbert.hpp"

namespace ifsi {
namespace {

std::vector<double> sizes(const Axis& x) {
  std::vector<double> h;
  for (size_t i = 0; i + 1 < x.size(); ++i) h.push_back(x[i + 1] - x[i]);
  return h;
}

TEST(Axis, UniformEndsExactlyWhereToldTo) {
  const Axis x = uniform_axis(0.1, 0.7, 7);
  ASSERT_EQ(x.size(), 8u);
  EXPECT_EQ(x.front(), 0.1);
  EXPECT_EQ(x.back(), 0.7);
  for (double h : sizes(x)) EXPECT_NEAR(h, 0.6 / 7, 1e-15);
}

TEST(Axis, GeometricHasTheRatio) {
  const auto h = sizes(geometric_axis(-1, 2, 6, 10));
  EXPECT_NEAR(h.back() / h.front(), 10, 1e-10);
  for (size_t i = 1; i < h.size(); ++i) EXPECT_NEAR(h[i] / h[i - 1], std::pow(10, 0.2), 1e-10);
}

TEST(Axis, FirstCellIsAsLongAsToldAndGrowthIsConstant) {
  for (double first : {0.001, 0.05, 0.3}) {
    const auto h = sizes(axis_from_first_cell(1, 2, 8, first));
    EXPECT_NEAR(h[0], first, 1e-12);
    for (size_t i = 2; i < h.size(); ++i) EXPECT_NEAR(h[i] / h[i - 1], h[1] / h[0], 1e-7);
  }
}

TEST(Axis, SymmetricIsSymmetricWithTheRatio) {
  for (int n : {1, 2, 5, 8}) {
    const auto h = sizes(symmetric_axis(0, 1, n, 4));
    for (int i = 0; i < n; ++i) EXPECT_NEAR(h[i], h[n - 1 - i], 1e-14);
    EXPECT_NEAR(h[n / 2] / h[0], n > 2 ? 4 : 1, 1e-10);
  }
}

TEST(Axis, JoinReflectShift) {
  const Axis x = join({0, 1}, shift(reflect({-3, -2, 0}), 1));
  EXPECT_EQ(x, (Axis{0, 1, 3, 4}));
  EXPECT_THROW(join({0, 1}, {1.1, 2}), Error);
}

TEST(Axis, NonsenseIsRefused) {
  EXPECT_THROW(uniform_axis(0, 1, 0), Error);
  EXPECT_THROW(uniform_axis(1, 1, 3), Error);
  EXPECT_THROW(uniform_axis(0, NAN, 3), Error);
  EXPECT_THROW(geometric_axis(0, 1, 3, -2), Error);
  EXPECT_THROW(axis_from_first_cell(0, 1, 3, 2), Error);
  EXPECT_THROW(check_increasing({0, 1, INFINITY}, "x"), Error);
}

/// Successive cells of the curve are neighbours, and every cell is visited once.
template <int dim>
void expect_curve(int bits) {
  std::map<std::uint64_t, Vec<std::uint32_t, dim>> cells;
  const std::uint32_t n = 1u << bits;
  for (std::uint32_t k = 0; k < (1u << bits * dim); ++k) {
    Vec<std::uint32_t, dim> x;
    for (int d = 0; d < dim; ++d) x[d] = k >> bits * d & (n - 1);
    cells[hilbert_index<dim>(x, bits)] = x;
  }
  ASSERT_EQ(cells.size(), 1u << bits * dim);
  EXPECT_EQ(cells.rbegin()->first, cells.size() - 1);
  for (auto it = cells.begin(), next = std::next(it); next != cells.end(); ++it, ++next) {
    int distance = 0;
    for (int d = 0; d < dim; ++d)
      distance += std::abs(static_cast<int>(it->second[d]) - static_cast<int>(next->second[d]));
    EXPECT_EQ(distance, 1);
  }
}

TEST(Hilbert, StepsToANeighbour) {
  expect_curve<1>(4);
  expect_curve<2>(4);
  expect_curve<3>(3);
}

}  // namespace
}  // namespace ifsi
