/// \file
/// The contract of quadrature rules, held by every rule on every reference cell.

#include "ifsi/quadrature/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "element/samples.hpp"

namespace ifsi {
namespace {

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

/// Integral of x^k over [-1,1].
double line_moment(int k) { return k % 2 == 0 ? 2.0 / (k + 1) : 0.0; }

/// Integral of x^k y^l (z^m) over the unit simplex.
template <int dim>
double simplex_moment(const std::array<int, 3>& power) {
  double numerator = 1.0;
  int sum = 0;
  for (int i = 0; i < dim; ++i) {
    numerator *= factorial(power[i]);
    sum += power[i];
  }
  return numerator / factorial(sum + dim);
}

/// Integral of x^k y^l z^m over the reference cell of E.
template <class E>
double moment(const std::array<int, 3>& power) {
  if (E::shape == Shape::triangle || E::shape == Shape::tet) return simplex_moment<E::dim>(power);
  if (E::shape == Shape::wedge) return simplex_moment<2>(power) * line_moment(power[2]);
  double product = 1.0;
  for (int i = 0; i < E::dim; ++i) product *= line_moment(power[i]);
  return product;
}

/// Whether the rule promises x^k y^l z^m: total degree; along each axis for products of lines.
template <class E, int degree>
bool is_promised(const std::array<int, 3>& power) {
  if (E::shape == Shape::triangle || E::shape == Shape::tet) return power[0] + power[1] + power[2] <= degree;
  if (E::shape == Shape::wedge) return power[0] + power[1] <= degree && power[2] <= degree;
  return std::max({power[0], power[1], power[2]}) <= degree;
}

template <class Q, class E>
double integrate(const std::array<int, 3>& power) {
  double sum = 0.0;
  for (int q = 0; q < Q::n; ++q) {
    double monomial = 1.0;
    for (int i = 0; i < E::dim; ++i) monomial *= std::pow(Q::points[q][i], power[i]);
    sum += Q::weights[q] * monomial;
  }
  return sum;
}

/// Largest error over the promised monomials, which are exact up to round-off.
template <class E, int degree>
void expect_exact() {
  using Q = Quadrature<E, degree>;
  for (int k = 0; k <= degree; ++k)
    for (int l = 0; l <= (E::dim > 1 ? degree : 0); ++l)
      for (int m = 0; m <= (E::dim > 2 ? degree : 0); ++m)
        if (is_promised<E, degree>({k, l, m})) {
          const double exact = moment<E>({k, l, m}), computed = integrate<Q, E>({k, l, m});
          EXPECT_NEAR(computed, exact, 2e-15 * (1.0 + std::abs(exact)))
              << E::name << " degree " << degree << ": " << k << l << m;
        }
}

/// Weights are positive, points inside.
template <class E, int degree>
void expect_positive_and_inside() {
  using Q = Quadrature<E, degree>;
  static_assert(QuadratureRule<Q, E>);
  for (int q = 0; q < Q::n; ++q) {
    EXPECT_GT(Q::weights[q], 0.0);
    EXPECT_LT(E::outside(Q::points[q]), E::dim == 0 ? 1.0 : 0.0) << E::name << " degree " << degree;
  }
}

template <class E>
class QuadratureTest : public ::testing::Test {
 public:
  static constexpr int max_degree = E::shape == Shape::wedge ? 6 : E::shape == Shape::tet ? 9 : 10;
  /// Calls f.operator()<degree>() for the degrees 0 to max_degree.
  template <class F>
  static void for_each_degree(F f) {
    [&]<int... degree>(std::integer_sequence<int, degree...>) { (f.template operator()<degree>(), ...); }
    (std::make_integer_sequence<int, max_degree + 1>{});
  }
};
using Shapes = ::testing::Types<Point1, Line1, Tri1, Quad1, Tet1, Hex1, Wedge1>;
TYPED_TEST_SUITE(QuadratureTest, Shapes, test::ElementName);

TYPED_TEST(QuadratureTest, IsExactUpToItsDegree) {
  this->for_each_degree([]<int degree>() { expect_exact<TypeParam, degree>(); });
}

TYPED_TEST(QuadratureTest, HasPositiveWeightsAndPointsInside) {
  this->for_each_degree([]<int degree>() { expect_positive_and_inside<TypeParam, degree>(); });
}

/// The tests above would pass with rules of needless size; the costs are part of the bargain.
TEST(QuadratureSize, IsTheOneKnown) {
  EXPECT_EQ((Quadrature<Line1, 3>::n), 2);
  EXPECT_EQ((Quadrature<Hex1, 5>::n), 27);
  EXPECT_EQ((Quadrature<Tri1, 4>::n), 6);
  EXPECT_EQ((Quadrature<Tri1, 6>::n), 12);
  EXPECT_EQ((Quadrature<Tet1, 3>::n), 8);
  EXPECT_EQ((Quadrature<Tet1, 6>::n), 24);
  EXPECT_EQ(DefaultQuadrature<Tri1>::n, 3);
  EXPECT_EQ(DefaultQuadrature<Tet1>::n, 4);
  EXPECT_EQ(DefaultQuadrature<Quad1>::n, 4);
  EXPECT_EQ(DefaultQuadrature<Wedge1>::n, 6);
  EXPECT_EQ(DefaultQuadrature<Tri2>::n, 7);
  EXPECT_EQ(DefaultQuadrature<Tet2>::n, 14);
  EXPECT_EQ(DefaultQuadrature<Quad2>::n, 9);
}

/// A rule that is symmetric treats all corners alike: rotating the cell permutes the points.
TEST(QuadratureSymmetry, SimplexRulesDoNotPreferAVertex) {
  const auto first_vertex = [](const auto& Q_points, const auto& weights, auto weight_of) {
    double sum = 0.0;
    for (std::size_t q = 0; q < weights.size(); ++q) sum += weights[q] * std::pow(weight_of(Q_points[q]), 9);
    return sum;
  };
  using Q = Quadrature<Tri1, 6>;
  const double at_0 = first_vertex(Q::points, Q::weights, [](const auto& x) { return 1.0 - x[0] - x[1]; });
  const double at_1 = first_vertex(Q::points, Q::weights, [](const auto& x) { return x[0]; });
  EXPECT_NEAR(at_0, at_1, 1e-16);
}

}  // namespace
}  // namespace ifsi
