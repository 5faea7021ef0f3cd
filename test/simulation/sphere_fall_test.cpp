// Meshes of the falling sphere: what its order in h hangs on.
#include "ifsi/simulation/sphere_fall.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ifsi {
namespace {

SphereOptions elastic_sphere(const std::string& model, double n) {
  SphereOptions o;
  o.model = model, o.body = "elastic", o.n = n;
  return o;
}

/// Depth of the node nearest to the surface but not on it, in fluid cells.
template <int dim>
double first_node_below_surface(const SphereOptions& o) {
  double depth = 1e300;
  for (auto x : sphere_mesh<dim>(o).points) {
    x[dim - 1] -= o.z_0;
    const double below = (o.a - std::sqrt(dot(x, x))) / o.h();
    if (below > 1e-9) depth = std::min(depth, below);
  }
  return depth;
}

TEST(SphereFall, NoNodesOfAnElasticSphereLieCloseBelowItsSurface) {
  for (const double n : {3.15, 4.41, 6.3, 8.82, 15.0}) {
    EXPECT_GE(first_node_below_surface<3>(elastic_sphere("quarter3d", n)), 2.0) << "a / h = " << n;
    EXPECT_GE(first_node_below_surface<3>(elastic_sphere("elastic3d", n)), 2.0) << "a / h = " << n;
  }
  for (const double n : {7.0, 10.0, 20.0})
    EXPECT_GE(first_node_below_surface<2>(elastic_sphere("axisymmetric", n)), 2.0) << "a / h = " << n;
}

TEST(SphereFall, PointsInSpaceAreAsFarApartAsAskedFor) {
  for (const double n : {3.15, 6.3, 8.82}) {
    const SphereOptions o = elastic_sphere("elastic3d", n);
    const auto points = boundary_points(sphere_mesh<3>(o), 0);
    EXPECT_NEAR(even_spacing(o.a, static_cast<double>(points.size())) / o.h(), 1.2, 0.02) << "a / h = " << n;
  }
}

TEST(SphereFall, CellsOfTheTankAtTheAxisHaveTheNamedSize) {
  for (const double n : {2.5, 3.15, 4.0, 4.41, 6.0, 8.0}) {
    const SphereOptions o = elastic_sphere("quarter3d", n);
    double first = 1e300;
    for (const auto& x : tank_mesh<Hex1>(o).points)
      if (x[0] > 1e-9 && x[1] == 0.0) first = std::min(first, x[0]);
    EXPECT_NEAR(first / o.h(), 1.0, 0.01) << "a / h = " << n;
  }
}

}  // namespace
}  // namespace ifsi
