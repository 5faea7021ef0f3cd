// Discs and balls, whole and cut: sound cells, named boundaries, symmetry.
#include "ifsi/mesh/ball.hpp"

#include <gtest/gtest.h>

#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/check.hpp"

namespace ifsi {
namespace {

template <class Element>
void expect_sound(const GlobalMesh<Element>& mesh) {
  for (int c = 0; c < mesh.n_cells(); ++c) {
    std::array<Vec<double, Element::dim>, Element::n_nodes> dN;
    for (const auto& xi : Element::nodes) {
      Element::gradients(xi, dN);
      EXPECT_GT(det(jacobian(dN, mesh.cell_coordinates(c))), 0.0) << "cell " << c;
    }
  }
}

TEST(Ball, WholeBall) {
  const auto mesh = ball<Hex1>({2.0, 1.2, 4, 3, 2.0});
  EXPECT_EQ(mesh.n_cells(), 4 * 4 * 4 + 6 * 4 * 4 * 3);
  EXPECT_EQ(mesh.boundary_faces.size(), 6u * 4 * 4);
  expect_sound(mesh);
}

TEST(Ball, QuarterHasAQuarterOfTheCellsAndNamedCuts) {
  const auto mesh = ball<Hex1>({2.0, 1.2, 4, 3}, {true, true, false});
  EXPECT_EQ(mesh.n_cells() * 4, 4 * 4 * 4 + 6 * 4 * 4 * 3);
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"surface", "cut_x", "cut_y"}));
  int on_surface = 0;
  for (const auto& face : mesh.boundary_faces) on_surface += face.boundary == 0;
  EXPECT_EQ(on_surface * 4, 6 * 4 * 4);
  for (const auto& x : mesh.points) EXPECT_TRUE(x[0] >= 0.0 && x[1] >= 0.0);
  expect_sound(mesh);
}

TEST(Ball, HalfADisc) {
  const auto mesh = ball<Quad1>({2.0, 1.2, 6, 2}, {true, false});
  EXPECT_EQ(mesh.n_cells() * 2, 6 * 6 + 4 * 6 * 2);
  expect_sound(mesh);
}

TEST(Ball, ImpossibleNumbersAreRefused) {
  EXPECT_THROW(ball<Hex1>({1.0, 1.2, 4, 3}), Error);
  EXPECT_THROW(ball<Quad1>({1.0, 0.5, 5, 3}, {true, false}), Error);
  EXPECT_NO_THROW(ball<Quad1>({1.0, 0.5, 5, 3}));
}

}  // namespace
}  // namespace ifsi
