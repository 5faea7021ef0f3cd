#include "ifsi/mesh/leaflet.hpp"

#include <gtest/gtest.h>

#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/check.hpp"
#include "mesh/measure.hpp"

namespace ifsi {
namespace {

using testing_mesh::volume;
constexpr double degree = std::numbers::pi / 180.0;

TEST(AorticRoot, AttachmentLinesLieOnTheStraightVessel) {
  const AorticRoot root;
  for (double angle = -180.0; angle <= 180.0; angle += 7.0)
    EXPECT_EQ(root.wall_radius(angle * degree, root.attachment(angle * degree)), root.radius);
  EXPECT_EQ(root.attachment(0.0), 0.0);
  EXPECT_NEAR(root.attachment(60.0 * degree), root.commissure, 1e-14);
  EXPECT_NEAR(root.attachment(100.0 * degree), root.attachment(20.0 * degree),
              1e-14);  // three times the same
}

TEST(AorticRoot, MapKeepsPlanesThroughTheAxisAndTakesTheWallToTheWall) {
  const AorticRoot root;
  for (double angle : {-170.0, -60.0, 0.0, 33.0, 60.0, 120.0})
    for (double z : {-1.0, 0.0, 0.7, 1.2, 2.0, 2.4, 5.0}) {
      const double c = std::cos(angle * degree), s = std::sin(angle * degree);
      for (double r : {0.0, 0.6, root.radius}) {
        const auto x = root.map({r * c, r * s, z});
        EXPECT_EQ(x[2], z);
        EXPECT_NEAR(x[0] * s - x[1] * c, 0.0, 1e-15);
        if (r < root.radius) continue;
        EXPECT_NEAR(std::hypot(x[0], x[1]), root.wall_radius(angle * degree, z), 1e-14);
      }
    }
  EXPECT_NEAR(root.wall_radius(0.0, 1.2), 1.3 * root.radius, 1e-12);  // the deepest place of a sinus
}

TEST(AorticRoot, RefusesWhatIsNoRoot) {
  EXPECT_THROW((AorticRoot{.height = 1.0, .commissure = 1.2}.check()), Error);
  EXPECT_THROW((AorticRoot{.lobe = -0.1}.check()), Error);
}

template <class Element>
class LeafletMeshes : public testing::Test {};
using SheetElements = testing::Types<Hex1, Hex2>;
TYPED_TEST_SUITE(LeafletMeshes, SheetElements);

TYPED_TEST(LeafletMeshes, AreSoundAndAsThickAsTold) {
  const AorticRoot root;
  const Leaflet leaflet;
  for (bool half : {true, false}) {
    const auto mesh = leaflet_mesh<TypeParam>(root, leaflet, 0.1, 2, half).mesh;
    check(mesh);  // no inverted cell
    const auto area = testing_mesh::boundary_measures(mesh);
    const double middle = 0.5 * (area.at("ventricle") + area.at("aorta"));
    EXPECT_NEAR(volume(mesh), leaflet.thickness * middle, 2e-3 * volume(mesh));
    EXPECT_NEAR(middle, half ? 1.66 : 3.32, half ? 0.05 : 0.1);  // cm^2
  }
}

TYPED_TEST(LeafletMeshes, StayWithinTheirThirdAndProtrudeNoFurtherThanTold) {
  const AorticRoot root;
  const Leaflet leaflet;
  const auto mesh = leaflet_mesh<TypeParam>(root, leaflet, 0.1, 1, false).mesh;
  for (const auto& x : mesh.points) {
    const double to_plane = x[0] * std::sin(60.0 * degree) - std::abs(x[1]) * std::cos(60.0 * degree);
    EXPECT_GT(to_plane, leaflet.gap - leaflet.thickness);
    EXPECT_LT(std::hypot(x[0], x[1]), root.radius + leaflet.protrusion + leaflet.thickness);
  }
  const auto attached = std::find(mesh.boundary_names.begin(), mesh.boundary_names.end(), "attachment");
  for (const auto& face : mesh.boundary_faces)
    if (face.boundary == attached - mesh.boundary_names.begin())
      for (int a : TypeParam::face_nodes(face.local_face)) {
        const auto& x = mesh.points[mesh.cells[face.cell][a]];
        EXPECT_GT(std::hypot(x[0], x[1]), root.wall_radius(std::atan2(x[1], x[0]), x[2]));
      }
}

TEST(LeafletMesh, HalfLiesOnItsCutAndIsHalfOfTheWhole) {
  const AorticRoot root;
  const Leaflet leaflet;
  const auto half = leaflet_mesh<Hex2>(root, leaflet, 0.1, 1, true);
  const auto whole = leaflet_mesh<Hex2>(root, leaflet, 0.1, 1, false);
  int on_cut = 0;
  for (const auto& x : half.mesh.points) {
    EXPECT_GE(x[1], 0.0);
    on_cut += x[1] == 0.0 ? 1 : 0;
  }
  EXPECT_EQ(on_cut, 3 * (2 * 9 + 1));  // nine cells from the attachment to the free edge
  EXPECT_NEAR(2.0 * volume(half.mesh), volume(whole.mesh), 1e-9 * volume(whole.mesh));
  EXPECT_EQ(half.lines.back().size(), 2u * 10u + 1u);
  EXPECT_EQ(whole.lines.back().size(), 2u * 20u + 1u);
  for (std::size_t k = 1; k < half.lines.back().size(); ++k)
    EXPECT_GT(half.mesh.points[half.lines.back()[k]][1], half.mesh.points[half.lines.back()[k - 1]][1]);
}

TEST(LeafletMesh, OthersAreTheFirstTurned) {
  const AorticRoot root;
  const auto first = leaflet_mesh<Hex1>(root, {}, 0.2, 1, false).mesh;
  const auto second = leaflet_mesh<Hex1>(root, {}, 0.2, 1, false, 120.0 * degree).mesh;
  const double c = std::cos(120.0 * degree), s = std::sin(120.0 * degree);
  for (int p = 0; p < first.n_points(); ++p) {
    const auto &x = first.points[p], &y = second.points[p];
    EXPECT_NEAR(y[0], c * x[0] - s * x[1], 1e-13);
    EXPECT_NEAR(y[1], s * x[0] + c * x[1], 1e-13);
  }
}

TEST(LeafletMembrane, IsTheMiddleOfTheVolume) {
  const AorticRoot root;
  const Leaflet leaflet;
  for (bool half : {true, false}) {
    const auto volume = leaflet_mesh<Hex2>(root, leaflet, 0.1, 1, half, 0.4);
    const auto membrane = leaflet_membrane<Quad2>(root, leaflet, 0.1, half, 0.4);
    EXPECT_EQ(3 * membrane.mesh.n_points(), volume.mesh.n_points());
    EXPECT_EQ(membrane.mesh.n_cells(), volume.mesh.n_cells());
    ASSERT_EQ(membrane.lines.size(), volume.lines.size());
    for (std::size_t j = 0; j < membrane.lines.size(); ++j) {
      ASSERT_EQ(membrane.lines[j].size(), volume.lines[j].size());
      for (std::size_t i = 0; i < membrane.lines[j].size(); ++i) {
        const auto to_middle =
            membrane.mesh.points[membrane.lines[j][i]] - volume.mesh.points[volume.lines[j][i]];
        EXPECT_NEAR(std::sqrt(dot(to_middle, to_middle)), 0.5 * leaflet.thickness, 1e-12);
      }
    }
    for (const auto& cell : volume.mesh.cells) {
      const auto &low = volume.mesh.points[cell[0]], &high = volume.mesh.points[cell[4]];
      const auto middle = 0.5 * (low + high);
      EXPECT_TRUE(std::any_of(membrane.mesh.points.begin(), membrane.mesh.points.end(),
                              [&](const auto& x) { return std::sqrt(dot(x - middle, x - middle)) < 1e-12; }));
    }
  }
}

TEST(LeafletMembrane, HalvesMakeTheWhole) {
  const AorticRoot root;
  const auto half = leaflet_membrane<Quad2>(root, {}, 0.1, true),
             whole = leaflet_membrane<Quad2>(root, {}, 0.1, false);
  ASSERT_EQ(half.lines.size(), whole.lines.size());
  for (std::size_t j = 0; j < half.lines.size(); ++j) {
    const std::size_t n = half.lines[j].size() - 1;
    ASSERT_EQ(whole.lines[j].size(), 2 * n + 1);
    EXPECT_EQ(half.mesh.points[half.lines[j][0]][1], 0.0);
    for (std::size_t i = 0; i <= n; ++i) {
      const auto &x = half.mesh.points[half.lines[j][i]], &right = whole.mesh.points[whole.lines[j][n + i]],
                 &left = whole.mesh.points[whole.lines[j][n - i]];
      for (int d = 0; d < 3; ++d) {
        EXPECT_NEAR(right[d], x[d], 1e-12);
        EXPECT_NEAR(left[d], d == 1 ? -x[d] : x[d], 1e-12);
      }
    }
  }
}

// Each node inside the sheet has one; its arms go to the next nodes along both lines, the first along a.
TEST(LeafletMembrane, CrossesJoinNeighbours) {
  const auto membrane = leaflet_membrane<Quad2>(AorticRoot{}, {}, 0.1, true);
  const auto& [mesh, lines] = membrane;
  std::vector<std::array<int, 2>> place(mesh.n_points(), {-1, -1});
  for (int j = 0; j < static_cast<int>(lines.size()); ++j)
    for (int i = 0; i < static_cast<int>(lines[j].size()); ++i) place[lines[j][i]] = {i, j};
  for (const auto& p : place) EXPECT_GE(p[0], 0);  // lines hold all nodes
  EXPECT_EQ(mesh.crosses.size(), (lines.size() - 2) * (lines[0].size() - 2));
  std::vector<int> crosses_at(mesh.n_points(), 0);
  for (const auto& cross : mesh.crosses) {
    ++crosses_at[cross[0]];
    const auto [i, j] = place[cross[0]];
    const std::array<std::array<int, 2>, 4> arms{{{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}}};
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(place[cross[1 + k]], arms[k]);
    }
  }
  EXPECT_EQ(*std::max_element(crosses_at.begin(), crosses_at.end()), 1);
  // Neighbours in the mesh: one cell has both.
  for (const auto& cross : mesh.crosses)
    for (int k = 1; k < 5; ++k)
      EXPECT_TRUE(std::any_of(mesh.cells.begin(), mesh.cells.end(), [&](const auto& cell) {
        return std::count(cell.begin(), cell.end(), cross[0]) == 1 &&
               std::count(cell.begin(), cell.end(), cross[k]) == 1;
      }));
}

// A parabola between its two tangents, as fast where it ends as where it starts.
TEST(LeafletSurface, TurnsUpTowardsTheFreeEdge) {
  const LeafletSurface surface(AorticRoot{}, {});
  const auto edge = surface.at(0.0, 1.0), wall = surface.at(0.0, 0.0);
  constexpr double d = 1e-6;
  const auto end = (1.0 / d) * (edge - surface.at(0.0, 1.0 - d)),
             start = (1.0 / d) * (surface.at(0.0, d) - wall);
  EXPECT_NEAR(end[0], 0.0, 1e-5);  // straight up
  const double turn_at = wall[2] + start[2] / start[0] * (edge[0] - wall[0]);
  EXPECT_NEAR(edge[2] - turn_at, Leaflet{}.coaptation, 1e-5);
  EXPECT_NEAR(std::sqrt(dot(start, start)), end[2], 1e-5);
  const auto commissural_edge = surface.at(1.0, 0.5);
  EXPECT_NEAR(std::hypot(commissural_edge[0], commissural_edge[1]), std::hypot(wall[0], wall[1]), 1e-12);
}

TEST(LeafletMesh, RefusesWhatIsNoLeaflet) {
  const AorticRoot root;
  EXPECT_THROW(LeafletSurface(root, {.height = 1.0}), Error);  // below the commissures
  EXPECT_THROW(LeafletSurface(root, {.gap = 0.005}), Error);   // through the neighbour
  EXPECT_THROW(LeafletSurface(root, {.rounding = 0.8}), Error);
  EXPECT_THROW(LeafletSurface(root, {.protrusion = -0.1}), Error);
  EXPECT_THROW(LeafletSurface(root, {.coaptation = 1.1}), Error);  // from below the nadir
}

}  // namespace
}  // namespace ifsi
