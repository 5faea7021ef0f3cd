// Discs, pipes and elevated meshes.
#include "ifsi/mesh/pipe.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/check.hpp"
#include "ifsi/mesh/elevate.hpp"
#include "ifsi/mesh/ring.hpp"
#include "mesh/measure.hpp"

namespace ifsi {
namespace {

using std::numbers::pi;
using testing_mesh::area_within_arcs;
using testing_mesh::boundary_is_exterior;
using testing_mesh::boundary_measures;
using testing_mesh::faces_conform;
using testing_mesh::volume;

template <class Element>
class DiscOf : public testing::Test {};
using PlaneCells = testing::Types<Quad1, Quad2, Tri1, Tri2>;
TYPED_TEST_SUITE(DiscOf, PlaneCells);

TYPED_TEST(DiscOf, HasTheAreaOfACircle) {
  const auto mesh = disc<TypeParam>({2.0, 1.0, 6, 4, 0.5});
  check(mesh);
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_TRUE(faces_conform(mesh));
  EXPECT_NEAR(volume(mesh), area_within_arcs(TypeParam::order, 24, 2), 1e-12);
  for (const auto& face : mesh.boundary_faces)
    for (int a : TypeParam::face_nodes(face.local_face)) {
      const auto& x = mesh.points[mesh.cells[face.cell][a]];
      EXPECT_NEAR(std::sqrt(dot(x, x)), 2, 1e-14);
    }
}

template <class Element>
class PipeOf : public testing::Test {};
using SolidCells = testing::Types<Hex1, Hex2, Wedge1>;
TYPED_TEST_SUITE(PipeOf, SolidCells);

TYPED_TEST(PipeOf, HasTheMeasuresOfACylinder) {
  const auto mesh = pipe<TypeParam>({2.0, 1.0, 4, 3, 1.0}, geometric_axis(0, 4, 5, 2));
  check(mesh);
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"wall", "inlet", "outlet"}));
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_TRUE(faces_conform(mesh));
  const double section = area_within_arcs(TypeParam::order, 16, 2);
  auto area = boundary_measures(mesh);
  EXPECT_NEAR(volume(mesh), 4 * section, 1e-11);
  EXPECT_NEAR(area["inlet"], section, 1e-11);
  EXPECT_NEAR(area["outlet"], section, 1e-11);
  const double polygon = 16 * 4 * std::sin(pi / 16);
  if (TypeParam::order == 1)
    EXPECT_NEAR(area["wall"], 4 * polygon, 1e-11);
  else
    EXPECT_NEAR(area["wall"], 16 * pi, 2e-3);
  EXPECT_NEAR(area["flux"], 3 * volume(mesh), 1e-10);
}

TEST(Pipe, PeriodicPipeHasOnlyItsWall) {
  const auto mesh = pipe<Hex1>({}, uniform_axis(0, 1, 3), {"", "", true});
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"wall"}));
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_THROW(pipe<Hex1>({}, uniform_axis(0, 1, 2), {"", "", true}), Error);
}

TEST(Pipe, NonsenseIsRefused) {
  EXPECT_THROW(disc<Quad1>({1.0, 1.5, 4, 4, 1.0}), Error);
  EXPECT_THROW(disc<Quad1>({1.0, 0.5, 0, 4, 1.0}), Error);
  EXPECT_THROW(disc<Quad1>({1.0, 0.5, 4, 0, 1.0}), Error);
  EXPECT_THROW(disc<Quad1>({NAN, 0.5, 4, 4, 1.0}), Error);
  EXPECT_THROW(pipe<Hex1>({}, {0.0, 1.0, 0.5}), Error);
}

TEST(Extrude, RegionsAreInherited) {
  auto plane = box<Quad1>({0, 0}, {1, 1}, {2, 1});
  plane.cell_region = {1, 0};
  plane.region_names = {"a", "b"};
  const auto mesh = extrude<Hex1>(plane, uniform_axis(0, 1, 2));
  EXPECT_EQ(mesh.cell_region, (std::vector<int>{1, 0, 1, 0}));
  EXPECT_EQ(mesh.region_names, plane.region_names);
}

template <class First, class Second>
struct Elevation {
  using first = First;
  using second = Second;
};
template <class Pair>
class Elevate : public testing::Test {};
using Elevations = testing::Types<Elevation<Line1, Line2>, Elevation<Tri1, Tri2>, Elevation<Quad1, Quad2>,
                                  Elevation<Tet1, Tet2>, Elevation<Hex1, Hex2>>;
TYPED_TEST_SUITE(Elevate, Elevations);

/// The order-2 box made directly has the same cells, up to the numbers of the points.
TYPED_TEST(Elevate, AgreesWithTheOrderTwoBox) {
  using First = typename TypeParam::first;
  using Second = typename TypeParam::second;
  std::array<Axis, First::dim> axes;
  axes.fill(geometric_axis(0, 1, 3, 2));
  const auto elevated = elevate<Second>(box<First>(axes));
  const auto direct = box<Second>(axes);
  ASSERT_EQ(elevated.n_points(), direct.n_points());
  ASSERT_EQ(elevated.n_cells(), direct.n_cells());
  for (int c = 0; c < direct.n_cells(); ++c) {
    const auto X = elevated.cell_coordinates(c), Y = direct.cell_coordinates(c);
    for (int a = 0; a < Second::n_nodes; ++a) EXPECT_NEAR(dot(X[a] - Y[a], X[a] - Y[a]), 0, 1e-28);
  }
  EXPECT_EQ(elevated.boundary_faces, direct.boundary_faces);
  EXPECT_TRUE(faces_conform(elevated));
}

TEST(Elevate, BoundaryNodesMoveToTheCurve) {
  const auto straight = disc<Tri1>({1.0, 0.5, 8, 4, 1.0});
  const auto curved =
      elevate<Tri2>(straight, [](int, const Vec<double, 2>& x) { return (1 / std::sqrt(dot(x, x))) * x; });
  EXPECT_NEAR(volume(straight), area_within_arcs(1, 32, 1), 1e-12);
  EXPECT_GT(pi - volume(straight), 1e-2);
  EXPECT_LT(pi - volume(curved), 1e-5);
}

TEST(Elevate, PeriodicMeshesAreRefused) {
  EXPECT_THROW(elevate<Quad2>(box<Quad1>({0, 0}, {1, 1}, {3, 3}, {{true, false}})), Error);
}

TEST(Ring, ClosesAndNeedsThreeCellsAround) {
  const auto mesh = ring_mesh<Quad1>({1.0, 2.0}, 0.5, 0.75, 12, 2);
  EXPECT_EQ(mesh.n_cells(), 24);
  EXPECT_EQ(mesh.points.size(), 36u);  // the first and the last column of nodes are one
  EXPECT_THROW(ring_mesh<Quad1>({0.0, 0.0}, 0.5, 0.75, 2, 1), Error);
}

}  // namespace
}  // namespace ifsi
