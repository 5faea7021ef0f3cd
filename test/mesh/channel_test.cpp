// The channel with a cylinder: geometry, quality, the flag band, the extruded channel.
#include <gtest/gtest.h>

#include <numbers>

#include "ifsi/mesh/channel_with_cylinder.hpp"
#include "ifsi/mesh/check.hpp"
#include "ifsi/mesh/extrude.hpp"
#include "mesh/measure.hpp"

namespace ifsi {
namespace {

using testing_mesh::area_within_arcs;
using testing_mesh::boundary_is_exterior;
using testing_mesh::boundary_measures;
using testing_mesh::faces_conform;
using testing_mesh::volume;

template <class Element>
class Channel : public testing::Test {};
using PlaneCells = testing::Types<Quad1, Quad2, Tri1, Tri2>;
TYPED_TEST_SUITE(Channel, PlaneCells);

TYPED_TEST(Channel, HasTheAreaAndTheBoundaries) {
  const auto mesh = channel_with_cylinder<TypeParam>();
  check(mesh);
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_TRUE(faces_conform(mesh));
  EXPECT_NEAR(volume(mesh), 2.2 * 0.41 - area_within_arcs(TypeParam::order, 64, 0.05), 1e-13);
  auto length = boundary_measures(mesh);
  EXPECT_NEAR(length["inlet"], 0.41, 1e-12);
  EXPECT_NEAR(length["outlet"], 0.41, 1e-12);
  EXPECT_NEAR(length["walls"], 4.4, 1e-12);
  EXPECT_NEAR(length["cylinder"], 0.1 * std::numbers::pi, TypeParam::order == 1 ? 2e-4 : 1e-7);
  EXPECT_NEAR(length["flux"], 2 * volume(mesh), 1e-12);
}

TYPED_TEST(Channel, NodesOfTheCylinderLieOnTheCircle) {
  const CylinderChannel channel;
  const auto mesh = channel_with_cylinder<TypeParam>(channel);
  int faces = 0;
  for (const auto& face : mesh.boundary_faces) {
    if (mesh.boundary_names[face.boundary] != "cylinder") continue;
    ++faces;
    for (int a : TypeParam::face_nodes(face.local_face)) {
      const auto r = mesh.points[mesh.cells[face.cell][a]] - channel.center;
      EXPECT_NEAR(std::sqrt(dot(r, r)), channel.radius, 1e-15);
    }
  }
  EXPECT_EQ(faces, channel.n_around);
}

/// Smallest over largest determinant of the Jacobian at the nodes of a cell; 1 for an affine cell.
template <class Element>
double worst_distortion(const GlobalMesh<Element>& mesh) {
  double worst = 1;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    double low = INFINITY, high = 0;
    for (const auto& xi : Element::nodes) {
      std::array<Vec<double, Element::dim>, Element::n_nodes> dN;
      Element::gradients(xi, dN);
      const double J = det(jacobian(dN, mesh.cell_coordinates(c)));
      low = std::min(low, J);
      high = std::max(high, J);
    }
    worst = std::min(worst, low / high);
  }
  return worst;
}

TYPED_TEST(Channel, CellsAreLittleDistortedAtEveryResolution) {
  for (double factor : {0.25, 0.5, 1.0, 2.0})
    EXPECT_GT(worst_distortion(channel_with_cylinder<TypeParam>(CylinderChannel{}.refined(factor))), 0.25)
        << "refined by " << factor;
}

TEST(CylinderChannel, TheFirstLayerIsAsThinAsToldAndRefinementHalvesIt) {
  for (double factor : {1.0, 2.0}) {
    const CylinderChannel channel = CylinderChannel{}.refined(factor);
    const auto mesh = channel_with_cylinder<Quad1>(channel);
    double nearest = 1;
    for (const auto& x : mesh.points) {
      const double d = std::sqrt(dot(x - channel.center, x - channel.center)) - channel.radius;
      if (d > 1e-9) nearest = std::min(nearest, d);
    }
    EXPECT_NEAR(nearest, 0.00125 / factor, 0.01 * 0.00125 / factor);
  }
}

TEST(CylinderChannel, NeighbouringCellsHaveSimilarSizes) {
  const auto mesh = channel_with_cylinder<Quad1>();
  double worst = 1;
  const auto area = [&](int c) {
    const auto X = mesh.cell_coordinates(c);
    const auto a = X[2] - X[0], b = X[3] - X[1];
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
  };
  for_each_face(sorted_faces(mesh), [&](const CellFace* face, int sides) {
    if (sides == 2)
      worst =
          std::max({worst, area(face[0].cell) / area(face[1].cell), area(face[1].cell) / area(face[0].cell)});
  });
  EXPECT_LT(worst, 2.1);
}

TEST(CylinderChannel, TheFlagOfTurekHronLiesInFineEqualCells) {
  const auto mesh = channel_with_cylinder<Quad2>(turek_hron_channel());
  check(mesh);
  int inside = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const auto X = mesh.cell_coordinates(c);
    if (X[8][0] < 0.3 || X[8][0] > 0.6 || std::abs(X[8][1] - 0.2) > 0.01) continue;
    ++inside;
    EXPECT_NEAR(X[2][1] - X[0][1], 0.005, 1e-12);
    EXPECT_NEAR(X[2][0] - X[0][0], 0.34 / 56, 1e-12);
  }
  EXPECT_GT(inside, 150);
  EXPECT_NEAR(volume(mesh), 2.5 * 0.41 - std::numbers::pi * 0.0025, 1e-8);
}

// The rigid flag is a hole with straight sides that begins on the circle.
TEST(CylinderChannel, TheFlagCanBeCutOut) {
  CylinderChannel channel = turek_hron_channel();
  channel.band_half_height = channel.flag_half_height;
  channel.band_end = 0.6;
  channel.n_band_rows = 4;
  channel.n_beside_band = 9;
  channel.cut_flag = true;
  const auto mesh = channel_with_cylinder<Quad2>(channel);
  check(mesh);
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_TRUE(faces_conform(mesh));
  const double root = 0.2 + std::sqrt(0.05 * 0.05 - 0.01 * 0.01), half_angle = std::asin(0.2);
  const double under_arc =
      0.0025 * half_angle + 0.01 * (root - 0.2);  // area of the disc within the flag's height
  auto length = boundary_measures(mesh);
  EXPECT_NEAR(length["flag"], 2 * (0.6 - root) + 0.02, 1e-12);
  EXPECT_NEAR(length["cylinder"], 0.1 * (std::numbers::pi - half_angle), 1e-7);
  EXPECT_NEAR(volume(mesh), 2.5 * 0.41 - std::numbers::pi * 0.0025 - (0.02 * 0.4 - under_arc), 1e-7);
  for (const auto& face : mesh.boundary_faces)
    if (mesh.boundary_names[face.boundary] == "flag")
      for (int a : Quad2::face_nodes(face.local_face)) {
        const auto& x = mesh.points[mesh.cells[face.cell][a]];
        EXPECT_TRUE(std::abs(std::abs(x[1] - 0.2) - 0.01) < 1e-14 || std::abs(x[0] - 0.6) < 1e-14);
      }
  channel.band_half_height = 0.02;
  EXPECT_THROW(channel_with_cylinder<Quad2>(channel), Error);
}

TEST(CylinderChannel, NonsenseIsRefused) {
  const auto broken = [](auto change) {
    CylinderChannel channel;
    change(channel);
    return channel;
  };
  EXPECT_THROW(channel_with_cylinder<Quad1>(broken([](auto& c) { c.n_around = 12; })), Error);
  EXPECT_THROW(channel_with_cylinder<Quad1>(broken([](auto& c) { c.n_radial = 0; })), Error);
  EXPECT_THROW(channel_with_cylinder<Quad1>(broken([](auto& c) { c.radius = 0.1; })), Error);
  EXPECT_THROW(channel_with_cylinder<Quad1>(broken([](auto& c) { c.height = 0.25; })), Error);
  EXPECT_THROW(channel_with_cylinder<Quad1>(broken([](auto& c) { c.length = NAN; })), Error);
  EXPECT_THROW(channel_with_cylinder<Quad1>(broken([](auto& c) { c.first_layer = 0.06; })), Error);
  EXPECT_THROW(channel_with_cylinder<Quad1>(broken([](auto& c) { c.n_band_rows = 4; })), Error);
}

template <class Prism, class Plane>
void expect_extruded_channel() {
  const auto plane = channel_with_cylinder<Plane>(schaefer_turek_3d_section().refined(0.5));
  const auto mesh = extrude<Prism>(plane, symmetric_axis(0, 0.41, 4, 2), {"walls", "walls", false});
  check(mesh);
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"inlet", "outlet", "walls", "cylinder"}));
  EXPECT_TRUE(boundary_is_exterior(mesh));
  EXPECT_TRUE(faces_conform(mesh));
  auto area = boundary_measures(mesh);
  EXPECT_NEAR(volume(mesh), 0.41 * volume(plane), 1e-12);
  EXPECT_NEAR(area["inlet"], 0.41 * 0.41, 1e-12);
  EXPECT_NEAR(area["walls"], 2 * 2.5 * 0.41 + 2 * volume(plane), 1e-10);
  EXPECT_NEAR(area["flux"], 3 * volume(mesh), 1e-10);
}

TEST(CylinderChannel, ExtrudesToTheThreeDimensionalChannel) {
  expect_extruded_channel<Hex1, Quad1>();
  expect_extruded_channel<Hex2, Quad2>();
  expect_extruded_channel<Wedge1, Tri1>();
}

}  // namespace
}  // namespace ifsi
