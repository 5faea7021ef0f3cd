// Boxes of every cell type: measures, boundaries, conformity, periodic sides, grading.
#include "ifsi/mesh/box.hpp"

#include <gtest/gtest.h>

#include <set>

#include "ifsi/mesh/check.hpp"
#include "mesh/measure.hpp"

namespace ifsi {
namespace {

using testing_mesh::boundary_is_exterior;
using testing_mesh::boundary_measures;
using testing_mesh::faces_conform;
using testing_mesh::volume;

template <int dim>
constexpr Vec<double, dim> corner(double x, double y, double z) {
  const double all[] = {x, y, z};
  Vec<double, dim> r;
  for (int d = 0; d < dim; ++d) r[d] = all[d];
  return r;
}

template <class Element>
class Box : public testing::Test {
 protected:
  static constexpr int dim = Element::dim;
  static std::array<int, dim> counts() {
    constexpr int all[] = {3, 4, 5};
    std::array<int, dim> n;
    for (int d = 0; d < dim; ++d) n[d] = all[d];
    return n;
  }
  static GlobalMesh<Element> make(const BoxOptions<dim>& options = {}) {
    return box<Element>(corner<dim>(-1, 0, 2), corner<dim>(1, 3, 2.5), counts(), options);
  }
};

using AllCells = testing::Types<Line1, Line2, Tri1, Tri2, Quad1, Quad2, Tet1, Tet2, Hex1, Hex2, Wedge1>;
TYPED_TEST_SUITE(Box, AllCells);

TYPED_TEST(Box, HasTheVolumeAndIsConforming) {
  const auto mesh = this->make();
  check(mesh);
  const double volumes[] = {2, 6, 3};
  EXPECT_NEAR(volume(mesh), volumes[this->dim - 1], 1e-12);
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_TRUE(faces_conform(mesh));
}

TYPED_TEST(Box, NodeCountIsThatOfTheLattice) {
  int expected = 1;
  for (int n : this->counts()) expected *= n * TypeParam::order + 1;
  EXPECT_EQ(this->make().n_points(), expected);
}

TYPED_TEST(Box, BoundariesLieOnTheirSides) {
  const auto mesh = this->make();
  const std::vector<std::string> names{"left", "right", "bottom", "top", "front", "back"};
  ASSERT_EQ(mesh.boundary_names, std::vector<std::string>(names.begin(), names.begin() + 2 * this->dim));
  const double side[] = {-1, 1, 0, 3, 2, 2.5};
  for (const auto& face : mesh.boundary_faces)
    for (int a : TypeParam::face_nodes(face.local_face))
      EXPECT_DOUBLE_EQ(mesh.points[mesh.cells[face.cell][a]][face.boundary / 2], side[face.boundary]);
}

TYPED_TEST(Box, NormalsPointOutwards) {
  if constexpr (TypeParam::dim > 1) {
    auto areas = boundary_measures(this->make());
    EXPECT_NEAR(areas["flux"], TypeParam::dim * volume(this->make()), 1e-12);
    EXPECT_NEAR(areas["left"], this->dim == 2 ? 3 : 1.5, 1e-12);
    EXPECT_NEAR(areas["top"], this->dim == 2 ? 2 : 1.0, 1e-12);
  }
}

TYPED_TEST(Box, FullyPeriodicHasNoBoundary) {
  BoxOptions<TypeParam::dim> options;
  options.periodic.fill(true);
  const auto mesh = this->make(options);
  check(mesh);
  EXPECT_TRUE(mesh.boundary_faces.empty());
  EXPECT_TRUE(exterior_faces(mesh).empty());
  EXPECT_TRUE(faces_conform(mesh));
  int expected = 1;
  for (int n : this->counts()) expected *= n * TypeParam::order;
  EXPECT_EQ(std::set<int>(mesh.point_node.begin(), mesh.point_node.end()).size(),
            static_cast<size_t>(expected));
}

TYPED_TEST(Box, PointsOfAPeriodicNodeDifferByThePeriod) {
  BoxOptions<TypeParam::dim> options;
  options.periodic[0] = true;
  const auto mesh = this->make(options);
  EXPECT_EQ(boundary_is_exterior(mesh), true);
  int pairs = 0;
  for (int p = 0; p < mesh.n_points(); ++p) {
    const auto shift = mesh.points[p] - mesh.points[mesh.node(p)];
    EXPECT_TRUE(shift[0] == 0 || shift[0] == 2.0);
    pairs += shift[0] == 2.0;
    for (int d = 1; d < TypeParam::dim; ++d) EXPECT_EQ(shift[d], 0);
  }
  EXPECT_EQ(pairs * (this->counts()[0] * TypeParam::order + 1), mesh.n_points());
}

TEST(BoxAxes, GradedBoxFollowsItsAxesWithAffineCells) {
  const Axis x = geometric_axis(0, 1, 4, 8), y = symmetric_axis(0, 1, 5, 3);
  const auto mesh = box<Quad2>({x, y});
  EXPECT_NEAR(volume(mesh), 1, 1e-14);
  for (const auto& cell : mesh.cells)
    for (int d = 0; d < 2; ++d)
      EXPECT_DOUBLE_EQ(mesh.points[cell[8]][d], 0.5 * (mesh.points[cell[0]][d] + mesh.points[cell[2]][d]));
}

TEST(BoxDiagonals, AlternateOrNot) {
  const auto slopes = [](Diagonals diagonals) {
    const auto mesh = box<Tri1>({0, 0}, {2, 2}, {2, 2}, {{}, diagonals});
    std::set<double> found;
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const auto X = mesh.cell_coordinates(c);
      for (int a = 0; a < 3; ++a) {
        const auto edge = X[(a + 1) % 3] - X[a];
        found.insert(edge[0] * edge[1]);
      }
    }
    return found;
  };
  EXPECT_EQ(slopes(Diagonals::uniform), (std::set<double>{0, 1}));
  EXPECT_EQ(slopes(Diagonals::alternating), (std::set<double>{-1, 0, 1}));
}

TEST(BoxErrors, BadAxesAreRefused) {
  EXPECT_THROW(box<Quad1>({Axis{0, 1, 1}, Axis{0, 1}}), Error);
  EXPECT_THROW(box<Quad1>({Axis{0}, Axis{0, 1}}), Error);
  EXPECT_THROW(box<Quad1>({Axis{0, NAN, 1}, Axis{0, 1}}), Error);
  EXPECT_THROW(box<Quad1>({0, 0}, {1, 1}, {2, 3}, {{true, false}}), Error);
  EXPECT_THROW(box<Hex1>({0, 0, 0}, {1, 1, 1}, {2, 3, 0}), Error);
  EXPECT_THROW(box<Wedge1>({0, 0, 0}, {1, 1, 1}, {3, 3, 2}, {{false, false, true}}), Error);
}

}  // namespace
}  // namespace ifsi
