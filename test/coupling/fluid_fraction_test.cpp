// Which part of a cell is fluid: exact for planes, second order for curved bodies.
#include "ifsi/coupling/fluid_fraction.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "ifsi/assembly/integrals.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/quadrature/coordinates.hpp"

namespace ifsi {
namespace {

TEST(FluidFraction, PlaneAtAnyPlace) {
  const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {4, 4}), Communicator(MPI_COMM_SELF));
  for (double at : {0.25, 0.3, 0.4375, 0.49999, 0.5}) {
    const auto fraction = fluid_fraction<Cartesian>(mesh, [&](const auto& x) { return x[0] - at; });
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const double left = std::min(mesh.cell_coordinates(c)[0][0], mesh.cell_coordinates(c)[2][0]);
      EXPECT_NEAR(fraction[c], std::clamp((left + 0.25 - at) / 0.25, 0.0, 1.0), 1e-12) << at;
    }
  }
}

TEST(FluidFraction, VolumeOfABall) {
  const auto mesh =
      distribute(box<Hex1>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {8, 9, 10}), Communicator(MPI_COMM_SELF));
  const Vec<double, 3> centre{0.51, 0.47, 0.49};
  const auto weights = fluid_weights<Cartesian>(
      mesh, [&](const auto& x) { return std::sqrt(dot(x - centre, x - centre)) - 0.3; }, 0.1);
  double wet = 0.0;
  for_each_cell_point<Cartesian, DefaultQuadrature<Hex1>>(
      mesh, true, [&](const auto& q) { wet += q.JxW * weights[q.cell]; });
  EXPECT_NEAR(1.0 - wet, 0.9 * 4.0 / 3.0 * std::numbers::pi * 0.027, 2e-4);
  EXPECT_NEAR(*std::min_element(weights.begin(), weights.end()), 0.1, 1e-14);
  EXPECT_EQ(*std::max_element(weights.begin(), weights.end()), 1.0);
}

}  // namespace
}  // namespace ifsi
