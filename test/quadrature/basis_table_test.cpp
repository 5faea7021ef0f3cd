/// \file
/// Tabulated bases agree with the elements, and integrate cells and their boundaries.

#include "ifsi/quadrature/basis_table.hpp"

#include "element/samples.hpp"

namespace ifsi {
namespace {

using test::norm;

template <class E>
class BasisTableTest : public ::testing::Test {
 public:
  std::mt19937 random{6};
};
TYPED_TEST_SUITE(BasisTableTest, test::Cells, test::ElementName);

TYPED_TEST(BasisTableTest, HoldsTheElementAtTheQuadraturePoints) {
  using E = TypeParam;
  using Table = BasisTable<E>;
  for (int q = 0; q < Table::n_points; ++q) {
    std::array<double, E::n_nodes> N;
    std::array<Vec<double, E::dim>, E::n_nodes> dN;
    std::array<Mat<double, E::dim>, E::n_nodes> ddN;
    const auto& xi = DefaultQuadrature<E>::points[q];
    E::shape_functions(xi, N);
    E::gradients(xi, dN);
    E::hessians(xi, ddN);
    for (int a = 0; a < E::n_nodes; ++a) {
      EXPECT_NEAR(Table::N[q][a], N[a], 1e-15);
      for (int i = 0; i < E::dim; ++i) EXPECT_NEAR(Table::dN[q][a][i], dN[a][i], 1e-15);
      for (int k = 0; k < E::dim * E::dim; ++k) EXPECT_NEAR(Table::ddN[q][a].data[k], ddN[a].data[k], 1e-15);
    }
  }
}

/// Volume of a cell by quadrature of det J.
template <class Table, class Nodes>
double volume(const Nodes& X) {
  double sum = 0.0;
  for (int q = 0; q < Table::n_points; ++q) sum += Table::weights[q] * det(jacobian(Table::dN[q], X));
  return sum;
}

TYPED_TEST(BasisTableTest, IntegratesTheVolumeOfDistortedCells) {
  using E = TypeParam;
  const auto X = test::random_cell<E>(this->random, 0.1);
  using Finer = BasisTable<E, Quadrature<E, E::shape == Shape::wedge ? 6 : 9>>;
  EXPECT_NEAR(volume<BasisTable<E>>(X), volume<Finer>(X), 1e-13);
}

template <class E>
class FaceBasisTableTest : public ::testing::Test {
 public:
  std::mt19937 random{7};
};
TYPED_TEST_SUITE(FaceBasisTableTest, test::CellsWithNormals, test::ElementName);

/// Sum over the faces of shape Face of the integrals of n and of x.n / dim, as [n, volume].
template <class E, class Face>
Vec<double, E::dim + 1> surface_integrals(const test::CellNodes<E>& X) {
  using Table = FaceBasisTable<E, Face>;
  Vec<double, E::dim + 1> sum = Vec<double, E::dim + 1>::zero();
  for (int f = 0; f < E::n_faces; ++f) {
    if (E::face_shape(f) != Face::shape) continue;
    for (int q = 0; q < Table::n_points; ++q) {
      const auto n = area_normal(jacobian(Table::OnFace::dN[q], on_face<E, Face>(f, X)));
      const auto x = interpolate(Table::N[f][q], X);
      for (int i = 0; i < E::dim; ++i) sum[i] += Table::weights[q] * n[i];
      sum[E::dim] += Table::weights[q] * dot(x, n) / E::dim;
    }
  }
  return sum;
}

/// Gauss' theorem: the normals sum to zero, and the flux of x / dim is the volume. It needs outward normals,
/// consistent orders of nodes on all faces, and cell bases that agree with face bases.
TYPED_TEST(FaceBasisTableTest, SatisfiesTheDivergenceTheorem) {
  using E = TypeParam;
  const auto X = test::random_cell<E>(this->random, 0.1);
  auto sum = surface_integrals<E, typename E::Face>(X);
  if constexpr (requires { typename E::OtherFace; }) sum += surface_integrals<E, typename E::OtherFace>(X);
  for (int i = 0; i < E::dim; ++i) EXPECT_NEAR(sum[i], 0.0, 1e-13);
  EXPECT_NEAR(sum[E::dim], volume<BasisTable<E>>(X), 1e-13);
}

TYPED_TEST(FaceBasisTableTest, CellBasisOnAFaceIsTheFaceBasis) {
  using E = TypeParam;
  using Table = FaceBasisTable<E>;
  for (int f = 0; f < E::n_faces; ++f) {
    if (E::face_shape(f) != E::Face::shape) continue;
    for (int q = 0; q < Table::n_points; ++q) {
      auto cell = Table::N[f][q];
      for (int k = 0; k < E::Face::n_nodes; ++k) cell[E::face_nodes(f)[k]] -= Table::OnFace::N[q][k];
      for (int a = 0; a < E::n_nodes; ++a) EXPECT_NEAR(cell[a], 0.0, 1e-15) << "face " << f << " node " << a;
    }
  }
}

TYPED_TEST(FaceBasisTableTest, DerivativesAreThoseAtThePointsOfTheFaces) {
  using E = TypeParam;
  using Table = FaceBasisTable<E>;
  const int f = E::n_faces - 1, q = Table::n_points - 1;
  const auto dN = test::gradients_at<E>(Table::points[f][q]);
  std::array<Mat<double, E::dim>, E::n_nodes> ddN;
  E::hessians(Table::points[f][q], ddN);
  for (int a = 0; a < E::n_nodes; ++a) {
    EXPECT_NEAR(norm(Table::dN[f][q][a] - dN[a]), 0.0, 1e-14);
    for (int k = 0; k < E::dim * E::dim; ++k) EXPECT_NEAR(Table::ddN[f][q][a].data[k], ddN[a].data[k], 1e-14);
  }
}

}  // namespace
}  // namespace ifsi
