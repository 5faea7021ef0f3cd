/// \file
/// The contract of ReferenceElement, held by every element.

#include <algorithm>
#include <numeric>
#include <set>
#include <type_traits>

#include "element/samples.hpp"
#include "ifsi/core/pack.hpp"

namespace ifsi {
namespace {

using test::norm, test::random_point;

struct WithoutFaces : Line1 {
  static constexpr int face_nodes = 0;
};
struct WithoutHessians : Line1 {
  static constexpr int hessians = 0;
};
static_assert(!ReferenceElement<WithoutFaces> && !ReferenceElement<WithoutHessians> &&
              !ReferenceElement<int>);

template <class E>
class ElementTest : public ::testing::Test {
 public:
  using Point = Vec<double, E::dim>;
  // Not inlined: that would only cost compile time.
  [[gnu::noinline]] static std::array<double, E::n_nodes> values(const Point& xi) {
    std::array<double, E::n_nodes> N;
    E::shape_functions(xi, N);
    return N;
  }
  [[gnu::noinline]] static std::array<Point, E::n_nodes> gradients(const Point& xi) {
    std::array<Point, E::n_nodes> dN{};
    E::gradients(xi, dN);
    return dN;
  }
  [[gnu::noinline]] static std::array<Mat<double, E::dim>, E::n_nodes> hessians(const Point& xi) {
    std::array<Mat<double, E::dim>, E::n_nodes> ddN{};
    E::hessians(xi, ddN);
    return ddN;
  }
  static Point shifted(Point xi, int axis, double step) {
    xi[axis] += step;
    return xi;
  }
  std::mt19937 random{1};
};
TYPED_TEST_SUITE(ElementTest, test::Elements, test::ElementName);

TYPED_TEST(ElementTest, IsKroneckerDeltaAtNodes) {
  using E = TypeParam;
  for (int a = 0; a < E::n_nodes; ++a) {
    const auto N = this->values(E::nodes[a]);
    for (int b = 0; b < E::n_nodes; ++b) EXPECT_NEAR(N[b], a == b ? 1.0 : 0.0, 1e-15) << a << ' ' << b;
  }
}

TYPED_TEST(ElementTest, ReproducesConstantAndLinearFieldsAlsoOutside) {
  using E = TypeParam;
  for (int sample = 0; sample < 20; ++sample) {
    const auto xi = random_point<E>(this->random, -1.0, 0.5);
    const auto N = this->values(xi);
    const auto dN = this->gradients(xi);
    EXPECT_NEAR(std::accumulate(N.begin(), N.end(), 0.0), 1.0, 1e-13);
    const auto same = interpolate(N, E::nodes);
    for (int i = 0; i < E::dim; ++i) {
      EXPECT_NEAR(same[i], xi[i], 1e-14);
      double gradient_sum = 0.0;
      for (const auto& gradient : dN) gradient_sum += gradient[i];
      EXPECT_NEAR(gradient_sum, 0.0, 1e-13);
    }
  }
}

TYPED_TEST(ElementTest, DerivativesAreDifferences) {
  using E = TypeParam;
  const double step = 1e-5;
  const auto xi = random_point<E>(this->random);
  const auto dN = this->gradients(xi);
  const auto ddN = this->hessians(xi);
  for (int j = 0; j < E::dim; ++j) {
    const auto forward = this->shifted(xi, j, step), backward = this->shifted(xi, j, -step);
    const auto N_forward = this->values(forward), N_backward = this->values(backward);
    const auto dN_forward = this->gradients(forward), dN_backward = this->gradients(backward);
    for (int a = 0; a < E::n_nodes; ++a) {
      EXPECT_NEAR(dN[a][j], (N_forward[a] - N_backward[a]) / (2.0 * step), 1e-9) << a << ' ' << j;
      for (int i = 0; i < E::dim; ++i)
        EXPECT_NEAR(ddN[a](i, j), (dN_forward[a][i] - dN_backward[a][i]) / (2.0 * step), 1e-9) << a;
    }
  }
}

TYPED_TEST(ElementTest, IsLinearWhereSecondDerivativesVanish) {
  using E = TypeParam;
  double largest = 0.0;
  for (const auto& ddN : this->hessians(random_point<E>(this->random)))
    for (int k = 0; k < E::dim * E::dim; ++k) largest = std::max(largest, std::abs(ddN.data[k]));
  EXPECT_EQ(largest == 0.0, E::linear);
}

TYPED_TEST(ElementTest, PacksGiveTheSameNumbers) {
  using E = TypeParam;
  using Lane = Pack<2>;
  const auto xi = random_point<E>(this->random);
  Vec<Lane, E::dim> packed{};
  for (int i = 0; i < E::dim; ++i) packed[i] = xi[i];
  std::array<Lane, E::n_nodes> N;
  std::array<Vec<Lane, E::dim>, E::n_nodes> dN;
  std::array<Mat<Lane, E::dim>, E::n_nodes> ddN;
  E::shape_functions(packed, N);
  E::gradients(packed, dN);
  E::hessians(packed, ddN);
  for (int a = 0; a < E::n_nodes; ++a) {
    EXPECT_NEAR(N[a][1], this->values(xi)[a], 1e-15);
    for (int i = 0; i < E::dim; ++i) EXPECT_NEAR(dN[a][i][1], this->gradients(xi)[a][i], 1e-15);
    for (int k = 0; k < E::dim * E::dim; ++k)
      EXPECT_NEAR(ddN[a].data[k][1], this->hessians(xi)[a].data[k], 1e-15);
  }
}

TYPED_TEST(ElementTest, KnowsInsideFromOutside) {
  using E = TypeParam;
  for (int a = 0; a < E::n_nodes; ++a) {
    EXPECT_TRUE(E::contains(E::nodes[a], 0.0));
    if (a < E::n_vertices && E::dim > 0) {
      const auto beyond = E::nodes[a] + 0.01 * (E::nodes[a] - E::center);
      EXPECT_FALSE(E::contains(beyond, 1e-3));
      EXPECT_TRUE(E::contains(beyond, 0.011));
    }
  }
  EXPECT_TRUE(E::contains(E::center, E::dim == 0 ? 0.0 : -0.2));
  for (int i = 0; i < E::dim; ++i) {
    auto nan = E::center;
    nan[i] = std::nan("");
    EXPECT_FALSE(E::contains(nan, 1e9)) << "coordinate " << i;
  }
}

TYPED_TEST(ElementTest, OrdersOfOtherFormatsArePermutations) {
  using E = TypeParam;
  auto vtk = E::vtk_order, gmsh = E::gmsh_order;
  std::sort(vtk.begin(), vtk.end());
  std::sort(gmsh.begin(), gmsh.end());
  EXPECT_EQ(vtk, detail::same_order<E::n_nodes>());
  EXPECT_EQ(gmsh, detail::same_order<E::n_nodes>());
}

TYPED_TEST(ElementTest, MetricIsThatOfTheRegularCellOfEdgeTwo) {
  using E = TypeParam;
  double longest = 0.0, shortest = 1e300;
  for (int a = 0; a < E::n_vertices; ++a)
    for (int b = 0; b < a; ++b) {
      const auto edge = E::nodes[a] - E::nodes[b];
      const double length = std::sqrt(inner(E::metric, outer(edge, edge)));
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  EXPECT_NEAR(shortest, E::dim == 0 ? 1e300 : 2.0, 1e-14);
  const bool simplex = E::shape == Shape::triangle || E::shape == Shape::tet;
  EXPECT_NEAR(longest, simplex ? 2.0 : longest, 1e-14);
}

template <class E>
class FaceTest : public ::testing::Test {};
TYPED_TEST_SUITE(FaceTest, test::CellsWithNormals, test::ElementName);

/// Calls check(face, FaceElement{}) for every face of E.
template <class E, class Check>
void for_each_face(Check check) {
  for (int f = 0; f < E::n_faces; ++f) {
    if (E::face_shape(f) == E::Face::shape) check(f, typename E::Face{});
    if constexpr (requires { typename E::OtherFace; })
      if (E::face_shape(f) == E::OtherFace::shape) check(f, typename E::OtherFace{});
  }
}

/// The order-1 element of the same shape: what says where the mid nodes of a face belong.
template <class Face>
using Linear = std::conditional_t<Face::shape == Shape::line, Line1,
                                  std::conditional_t<Face::shape == Shape::triangle, Tri1, Quad1>>;

TYPED_TEST(FaceTest, NodesAgreeWithTheFaceElement) {
  using E = TypeParam;
  for_each_face<E>([](int f, auto face) {
    using Face = decltype(face);
    const auto nodes = E::face_nodes(f);
    ASSERT_EQ(nodes.size(), static_cast<std::size_t>(Face::n_nodes));
    std::array<Vec<double, E::dim>, Face::n_vertices> vertices;
    for (int v = 0; v < Face::n_vertices; ++v) vertices[v] = E::nodes[nodes[v]];
    for (int k = 0; k < Face::n_nodes; ++k) {
      EXPECT_EQ(nodes[k] < E::n_vertices, k < Face::n_vertices) << "vertices first";
      const auto expected = map<Linear<Face>>(Face::nodes[k], vertices);
      EXPECT_NEAR(norm(E::nodes[nodes[k]] - expected), 0.0, 1e-15) << "face " << f << " node " << k;
      EXPECT_NEAR(E::outside(expected), 0.0, 1e-15);
    }
  });
}

TYPED_TEST(FaceTest, NormalsPointOutward) {
  using E = TypeParam;
  for_each_face<E>([](int f, auto face) {
    using Face = decltype(face);
    std::array<Vec<double, Face::dim>, Face::n_nodes> dN;
    Face::gradients(Face::center, dN);
    const auto normal = area_normal(jacobian(dN, on_face<E, Face>(f, E::nodes)));
    const auto outward = face_to_cell<E, Face>(f, Face::center) - E::center;
    EXPECT_GT(dot(normal, outward), 0.1) << "face " << f;
    for (int a = 0; a < E::n_vertices; ++a)
      EXPECT_LE(dot(normal, E::nodes[a] - face_to_cell<E, Face>(f, Face::center)), 1e-15)
          << "cell behind face";
  });
}

TYPED_TEST(FaceTest, AreDistinctAndMeetInEveryVertex) {
  using E = TypeParam;
  std::set<std::set<int>> faces;
  std::array<int, E::n_nodes> count{};
  for (int f = 0; f < E::n_faces; ++f) {
    const auto nodes = E::face_nodes(f);
    faces.insert({nodes.begin(), nodes.end()});
    for (int a : nodes) ++count[a];
  }
  EXPECT_EQ(faces.size(), static_cast<std::size_t>(E::n_faces));
  for (int a = 0; a < E::n_vertices; ++a) EXPECT_EQ(count[a], E::dim);
}

TEST(ElementFormats, GmshTetSwapsItsLastEdges) {
  EXPECT_EQ(Tet2::nodes[Tet2::gmsh_order[8]], (Vec<double, 3>{0.0, 0.5, 0.5}));
  EXPECT_EQ(Tet2::nodes[Tet2::gmsh_order[9]], (Vec<double, 3>{0.5, 0.0, 0.5}));
}

/// Gmsh's reference manual, "Node ordering": edges of the hex27, then its faces.
TEST(ElementFormats, GmshHexNumbersEdgesByTheirVertices) {
  const int edges[12][2] = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                            {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  const int faces[6][4] = {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
  for (int e = 0; e < 12; ++e)
    EXPECT_EQ(Hex2::nodes[Hex2::gmsh_order[8 + e]],
              0.5 * (Hex2::nodes[edges[e][0]] + Hex2::nodes[edges[e][1]]));
  for (int f = 0; f < 6; ++f) {
    const auto& v = faces[f];
    EXPECT_EQ(Hex2::nodes[Hex2::gmsh_order[20 + f]],
              0.25 * (Hex2::nodes[v[0]] + Hex2::nodes[v[1]] + Hex2::nodes[v[2]] + Hex2::nodes[v[3]]));
  }
}

/// VTK wants the triangle (0,1,2) of a wedge to turn outwards.
TEST(ElementFormats, VtkWedgeTurnsItsTriangleOutwards) {
  const auto node = [](int k) { return Wedge1::nodes[Wedge1::vtk_order[k]]; };
  const Vec<double, 3> a = node(1) - node(0), b = node(2) - node(0), up = node(3) - node(0);
  EXPECT_LT(det(Mat<double, 3>{a[0], a[1], a[2], b[0], b[1], b[2], up[0], up[1], up[2]}), 0.0);
}

}  // namespace
}  // namespace ifsi
