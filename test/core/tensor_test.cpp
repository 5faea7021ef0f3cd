/// \file
/// Small vectors and tensors against Eigen.

#include "ifsi/core/tensor.hpp"

#include <gtest/gtest.h>

#include <random>
#include <type_traits>

#include "support/eigen.hpp"

namespace ifsi {
namespace {

template <class T, int n>
using EigenMatrix = Eigen::Matrix<T, n, n, n == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

template <int n>
Mat<double, n> random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Mat<double, n> a;
  for (double& x : a.data) x = uniform(random);
  for (int i = 0; i < n; ++i) a(i, i) += 2.5;  // keeps the inverse small
  return a;
}

template <int n>
EigenMatrix<double, n> to_eigen(const Mat<double, n>& a) {
  return Eigen::Map<const EigenMatrix<double, n>>(a.data);
}

template <int n>
void expect_equal(const Mat<double, n>& a, const EigenMatrix<double, n>& b) {
  EXPECT_LE((to_eigen(a) - b).cwiseAbs().maxCoeff(), 1e-13);
}

template <class Dimension>
class TensorTest : public ::testing::Test {
 public:
  static constexpr int n = Dimension::value;
  std::mt19937 random{17};
};

using Dimensions = ::testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                    std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(TensorTest, Dimensions);

TYPED_TEST(TensorTest, DeterminantAndInverse) {
  constexpr int n = TypeParam::value;
  for (int sample = 0; sample < 20; ++sample) {
    const Mat<double, n> a = random_matrix<n>(this->random);
    EXPECT_NEAR(det(a), to_eigen(a).determinant(), 1e-12);
    expect_equal<n>(inverse(a), to_eigen(a).inverse());
    expect_equal<n>(a * inverse(a), EigenMatrix<double, n>::Identity());
  }
}

TYPED_TEST(TensorTest, Products) {
  constexpr int n = TypeParam::value;
  const Mat<double, n> a = random_matrix<n>(this->random), b = random_matrix<n>(this->random);
  expect_equal<n>(a * b, to_eigen(a) * to_eigen(b));
  expect_equal<n>(2.0 * a + b - transpose(a), 2.0 * to_eigen(a) + to_eigen(b) - to_eigen(a).transpose());
  expect_equal<n>(sym(a), 0.5 * (to_eigen(a) + to_eigen(a).transpose()));
  EXPECT_NEAR(inner(a, b), to_eigen(a).cwiseProduct(to_eigen(b)).sum(), 1e-13);
  EXPECT_NEAR(trace(a), to_eigen(a).trace(), 1e-14);
}

TYPED_TEST(TensorTest, Vectors) {
  constexpr int n = TypeParam::value;
  const Mat<double, n> a = random_matrix<n>(this->random);
  Vec<double, n> x, y;
  for (int i = 0; i < n; ++i) x[i] = 1.0 + i, y[i] = 0.5 - i;
  const Mat<double, n> xy = outer(x, y);
  EXPECT_NEAR(dot(x, a * y), inner(a, xy), 1e-13);
  EXPECT_EQ((x + y) - y, x);
  EXPECT_EQ(2.0 * x, x + x);
}

TEST(Tensor, CrossProduct) {
  const Vec<double, 3> e1{1, 0, 0}, e2{0, 1, 0}, e3{0, 0, 1}, a{1, -2, 3}, b{0.5, 4, -1};
  EXPECT_EQ(cross(e1, e2), e3);
  EXPECT_EQ(cross(e2, e3), e1);
  EXPECT_EQ(cross(e3, e1), e2);
  EXPECT_EQ(cross(a, b), (Vec<double, 3>{-10, 2.5, 5}));
  EXPECT_EQ(cross(b, a), -1.0 * cross(a, b));
}

TEST(Tensor, CofactorIsTheDeterminantTimesTheInverseTransposed) {
  std::mt19937 random(5);
  for (int sample = 0; sample < 5; ++sample) {
    const auto a = random_matrix<2>(random);
    const auto b = random_matrix<3>(random);
    expect_equal<2>(cofactor(a), to_eigen(a).determinant() * to_eigen(a).inverse().transpose());
    expect_equal<3>(cofactor(b), to_eigen(b).determinant() * to_eigen(b).inverse().transpose());
  }
}

// Of two vectors on two it is their cross product on that of those.
TEST(Tensor, CofactorOfASingularMatrix) {
  const Vec<double, 3> a{1, 2, 3}, b{-1, 0.5, 2}, e1{1, 0, 0}, e2{0, 1, 0}, e3{0, 0, 1};
  const Mat<double, 3> plane = outer(a, e1) + outer(b, e2);
  EXPECT_EQ(cofactor(plane), outer(cross(a, b), e3));
  EXPECT_EQ(cofactor(Mat<double, 2>{2, 4, 1, 2}), (Mat<double, 2>{2, -1, -4, 2}));
}

TEST(Tensor, RectangularProductsAndTransposes) {
  const Mat<double, 2, 3> a = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(a * transpose(a), (Mat<double, 2>{14, 32, 32, 77}));
  EXPECT_EQ(transpose(a)(2, 1), 6.0);
  EXPECT_EQ(a * (Vec<double, 3>{1, 0, -1}), (Vec<double, 2>{-2, -2}));
}

TEST(Tensor, WorksAtCompileTime) {
  constexpr Mat<double, 2> a = {2, 0, 0, 4};
  static_assert(det(a) == 8.0 && inverse(a) == Mat<double, 2>{0.5, 0, 0, 0.25});
  static_assert(trace(Mat<double, 3>::identity()) == 3.0);
}

}  // namespace
}  // namespace ifsi
