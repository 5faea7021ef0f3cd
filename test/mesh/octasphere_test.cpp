// Balls of tetrahedra over an octahedron: their points, sound and conforming cells, evenness, symmetry.
#include "ifsi/mesh/octasphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/check.hpp"

namespace ifsi {
namespace {

std::vector<Vec<double, 3>> points_on_sphere(const GlobalMesh<Tet1>& mesh, double radius) {
  std::vector<Vec<double, 3>> points;
  for (const auto& x : mesh.points)
    if (std::sqrt(dot(x, x)) > 0.999 * radius) points.push_back(x);
  return points;
}

double volume_of(const GlobalMesh<Tet1>& mesh) {
  std::array<Vec<double, 3>, 4> dN;
  Tet1::gradients({0.25, 0.25, 0.25}, dN);
  double volume = 0.0;
  for (int c = 0; c < mesh.n_cells(); ++c) volume += det(jacobian(dN, mesh.cell_coordinates(c))) / 6.0;
  return volume;
}

class OctasphereOf : public testing::TestWithParam<int> {};

TEST_P(OctasphereOf, HasFourPointsPerSquareOfTheFrequencyOnEachShell) {
  const int f = GetParam(), on_shell = 4 * f * f + 2;
  const auto mesh = octasphere({0.25, f, 3});
  EXPECT_EQ(mesh.n_points(), 1 + 3 * on_shell);
  std::array<int, 4> count{};
  for (const auto& x : mesh.points) {
    const double shell = 3.0 * std::sqrt(dot(x, x)) / 0.25;
    EXPECT_NEAR(shell, std::round(shell), 1e-14);
    ++count[std::lround(shell)];
  }
  EXPECT_EQ(count, (std::array<int, 4>{1, on_shell, on_shell, on_shell}));
}

TEST_P(OctasphereOf, CellsAreSoundAndMeetFaceToFace) {
  const int f = GetParam(), triangles = 8 * f * f;
  const auto mesh = octasphere({2.0, f, 3});
  EXPECT_NO_THROW(check(mesh));
  EXPECT_EQ(mesh.n_cells(), 7 * triangles);
  // Faces that do not meet their neighbour would be exterior, too.
  EXPECT_EQ(mesh.boundary_faces.size(), static_cast<std::size_t>(triangles));
  for (const auto& face : mesh.boundary_faces)
    for (int a : Tet1::face_nodes(face.local_face)) {
      const auto& x = mesh.points[mesh.cells[face.cell][a]];
      EXPECT_NEAR(dot(x, x), 4.0, 1e-14);
    }
}

TEST_P(OctasphereOf, SpreadsItsPointsEvenly) {
  const int f = GetParam();
  const auto points = points_on_sphere(octasphere({0.25, f}), 0.25);
  const double spacing = even_spacing(0.25, 4.0 * f * f + 2.0);
  EXPECT_EQ(octasphere_frequency(0.25, spacing), f);
  for (const auto& x : points) {
    double nearest = 1.0;
    for (const auto& y : points)
      if (&x != &y) nearest = std::min(nearest, detail::distance(x, y));
    EXPECT_GT(nearest, 0.8 * spacing);
    EXPECT_LT(nearest, 1.08 * spacing);
  }
}

TEST_P(OctasphereOf, QuarterIsAQuarterWithNamedCuts) {
  const int f = GetParam();
  const auto whole = octasphere({2.0, f, 2}), quarter = octasphere({2.0, f, 2}, {true, true, false});
  EXPECT_NO_THROW(check(quarter));
  EXPECT_EQ(4 * quarter.n_cells(), whole.n_cells());
  EXPECT_NEAR(4.0 * volume_of(quarter), volume_of(whole), 1e-12);
  EXPECT_EQ(quarter.boundary_names, (std::vector<std::string>{"surface", "cut_x", "cut_y"}));
  for (const auto& x : quarter.points) EXPECT_TRUE(x[0] >= 0.0 && x[1] >= 0.0);
  std::array<int, 3> faces{};
  for (const auto& face : quarter.boundary_faces) {
    ++faces[face.boundary];
    if (face.boundary == 0) continue;
    for (int a : Tet1::face_nodes(face.local_face))
      EXPECT_EQ(quarter.points[quarter.cells[face.cell][a]][face.boundary - 1], 0.0);
  }
  EXPECT_EQ(faces, (std::array<int, 3>{2 * f * f, 6 * f, 6 * f}));
}

INSTANTIATE_TEST_SUITE_P(Frequencies, OctasphereOf, testing::Values(1, 2, 3, 5, 8));

TEST(Octasphere, FillsTheBallWithSecondOrder) {
  const double exact = 4.0 / 3.0 * std::numbers::pi;
  const auto missing = [&](int f) { return exact - volume_of(octasphere({1.0, f, 2})); };
  EXPECT_GT(missing(16), 0.0);
  EXPECT_LT(missing(16), 0.01 * exact);
  EXPECT_NEAR(missing(8) / missing(16), 4.0, 0.1);
}

TEST(Octasphere, ImpossibleNumbersAreRefused) {
  EXPECT_THROW(octasphere({0.0, 4, 1}), Error);
  EXPECT_THROW(octasphere({1.0, 0, 1}), Error);
  EXPECT_THROW(octasphere({1.0, 4, 0}), Error);
}

}  // namespace
}  // namespace ifsi
