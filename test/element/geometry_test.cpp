/// \file
/// The isoparametric map on random distorted and curved cells.

#include "ifsi/element/geometry.hpp"

#include "element/samples.hpp"
#include "ifsi/core/pack.hpp"

namespace ifsi {
namespace {

using test::norm, test::random_cell, test::random_point;

/// Node movement that leaves valid but clearly distorted cells.
template <class E>
constexpr double distortion = (E::order == 1 ? 0.25 : 0.1) *
                              (E::linear || E::shape == Shape::triangle ? 0.7 : 1.0);

/// Everything a kernel asks for at one point.
template <class E, class T = double>
struct PointGeometry {
  std::array<double, E::n_nodes> N;
  std::array<Vec<double, E::dim>, E::n_nodes> dN;
  std::array<Mat<double, E::dim>, E::n_nodes> ddN;
  Mat<T, E::dim> J, J_inverse;
  std::array<Vec<T, E::dim>, E::n_nodes> grad_N;
  std::array<T, E::n_nodes> lap_N;

  [[gnu::noinline]] PointGeometry(const Vec<double, E::dim>& xi,
                                  const std::array<Vec<T, E::dim>, E::n_nodes>& X) {
    E::shape_functions(xi, N);
    E::gradients(xi, dN);
    E::hessians(xi, ddN);
    J = jacobian(dN, X);
    J_inverse = inverse(J);
    grad_N = physical_gradients(dN, J_inverse);
    lap_N = physical_laplacians(ddN, grad_N, X, J_inverse);
  }
};

template <class E>
class GeometryTest : public ::testing::Test {
 public:
  std::mt19937 random{2};
};
TYPED_TEST_SUITE(GeometryTest, test::Cells, test::ElementName);

TYPED_TEST(GeometryTest, JacobianIsTheDifferenceOfTheMap) {
  using E = TypeParam;
  const auto X = random_cell<E>(this->random, distortion<E>);
  const auto xi = random_point<E>(this->random);
  const auto J = PointGeometry<E>(xi, X).J;
  for (int j = 0; j < E::dim; ++j) {
    auto forward = xi, backward = xi;
    forward[j] += 1e-5;
    backward[j] -= 1e-5;
    const auto difference = 5e4 * (map<E>(forward, X) - map<E>(backward, X));
    for (int i = 0; i < E::dim; ++i) EXPECT_NEAR(J(i, j), difference[i], 1e-9);
  }
}

TYPED_TEST(GeometryTest, LinearFieldsHaveTheirGradientAndNoLaplacian) {
  using E = TypeParam;
  for (int sample = 0; sample < 10; ++sample) {
    const auto X = random_cell<E>(this->random, distortion<E>);
    const PointGeometry<E> at(random_point<E>(this->random), X);
    Mat<double, E::dim> grad_x = Mat<double, E::dim>::zero();
    for (int a = 0; a < E::n_nodes; ++a) grad_x += outer(X[a], at.grad_N[a]);
    for (int i = 0; i < E::dim; ++i) {
      for (int j = 0; j < E::dim; ++j) EXPECT_NEAR(grad_x(i, j), i == j ? 1.0 : 0.0, 1e-12);
      double laplacian = 0.0;
      for (int a = 0; a < E::n_nodes; ++a) laplacian += at.lap_N[a] * X[a][i];
      EXPECT_NEAR(laplacian, 0.0, 1e-10);
    }
  }
}

/// On curved cells, differences in x need xi(x): Newton on the map, from the point itself.
template <class E>
Vec<double, E::dim> reference_point(const test::CellNodes<E>& X, const Vec<double, E::dim>& x,
                                    Vec<double, E::dim> xi) {
  for (int k = 0; k < 6; ++k) xi -= inverse(PointGeometry<E>(xi, X).J) * (map<E>(xi, X) - x);
  return xi;
}

TYPED_TEST(GeometryTest, LaplaciansAreDifferencesOfGradients) {
  using E = TypeParam;
  const double step = 1e-5;
  const auto X = random_cell<E>(this->random, distortion<E>);
  const auto xi = random_point<E>(this->random);
  const auto x = map<E>(xi, X);
  std::array<double, E::n_nodes> expected{};
  for (int i = 0; i < E::dim; ++i) {
    auto forward = x, backward = x;
    forward[i] += step;
    backward[i] -= step;
    const PointGeometry<E> plus(reference_point<E>(X, forward, xi), X),
        minus(reference_point<E>(X, backward, xi), X);
    for (int a = 0; a < E::n_nodes; ++a)
      expected[a] += (plus.grad_N[a][i] - minus.grad_N[a][i]) / (2.0 * step);
  }
  const PointGeometry<E> at(xi, X);
  for (int a = 0; a < E::n_nodes; ++a)
    EXPECT_NEAR(at.lap_N[a], expected[a], 1e-6 * (1.0 + std::abs(expected[a])));
}

TYPED_TEST(GeometryTest, PacksGiveTheSameNumbers) {
  using E = TypeParam;
  using Lane = Pack<2>;
  const auto X = random_cell<E>(this->random, distortion<E>), Y = random_cell<E>(this->random, distortion<E>);
  std::array<Vec<Lane, E::dim>, E::n_nodes> packed;
  for (int a = 0; a < E::n_nodes; ++a)
    for (int i = 0; i < E::dim; ++i) {
      packed[a][i].set(0, X[a][i]);
      packed[a][i].set(1, Y[a][i]);
    }
  const auto xi = random_point<E>(this->random);
  const PointGeometry<E, Lane> both(xi, packed);
  const PointGeometry<E> second(xi, Y);
  for (int a = 0; a < E::n_nodes; ++a) {
    EXPECT_NEAR(both.grad_N[a][E::dim - 1][1], second.grad_N[a][E::dim - 1], 1e-12);
    EXPECT_NEAR(both.lap_N[a][1], second.lap_N[a], 1e-9);
  }
  EXPECT_NEAR(metric_tensor<E>(both.J_inverse)(0, 0)[1], metric_tensor<E>(second.J_inverse)(0, 0), 1e-11);
}

/// G of the reference cell stretched to edges of length h along each edge direction is 4 / h^2 in that
/// direction.
TYPED_TEST(GeometryTest, MetricTensorMeasuresEdges) {
  using E = TypeParam;
  const double h = 0.1;
  auto X = E::nodes;
  for (auto& x : X) x = h * x;
  const auto G = metric_tensor<E>(PointGeometry<E>(E::center, X).J_inverse);
  const auto edge = X[1] - X[0];  // two units long in the metric of any parent cell
  EXPECT_NEAR(dot(edge, G * edge), 4.0, 1e-13);
}

TEST(Metric, RegularSimplexOfEdgeHGivesFourOverHSquared) {
  const double h = 0.3, s3 = std::sqrt(3.0), s6 = std::sqrt(6.0);
  const test::CellNodes<Tri1> triangle = {{{0, 0}, {h, 0}, {0.5 * h, 0.5 * s3 * h}}};
  const test::CellNodes<Tet1> tet = {
      {{0, 0, 0}, {h, 0, 0}, {0.5 * h, 0.5 * s3 * h, 0}, {0.5 * h, s3 / 6.0 * h, s6 / 3.0 * h}}};
  const auto G2 = metric_tensor<Tri1>(PointGeometry<Tri1>(Tri1::center, triangle).J_inverse);
  const auto G3 = metric_tensor<Tet1>(PointGeometry<Tet1>(Tet1::center, tet).J_inverse);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) EXPECT_NEAR(G2(i, j), i == j ? 4.0 / (h * h) : 0.0, 1e-12);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(G3(i, j), i == j ? 4.0 / (h * h) : 0.0, 1e-12);
}

/// All numberings of a tet describe the same cell: G must not depend on which vertex is the first.
TEST(Metric, DoesNotDependOnTheFirstVertex) {
  std::mt19937 random(5);
  const auto X = random_cell<Tet1>(random, 0.2);
  const test::CellNodes<Tet1> Y = {{X[1], X[2], X[0], X[3]}}, Z = {{X[3], X[2], X[1], X[0]}};
  const auto G = [](const auto& nodes) {
    return metric_tensor<Tet1>(PointGeometry<Tet1>(Tet1::center, nodes).J_inverse);
  };
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(G(X).data[k], G(Y).data[k], 1e-10);
    EXPECT_NEAR(G(X).data[k], G(Z).data[k], 1e-10);
  }
}

}  // namespace
}  // namespace ifsi
