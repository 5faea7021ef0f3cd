// Rigid bodies in a flow: the constraint holds, momentum is balanced, the answer does not depend on the
// ranks.
#include <gtest/gtest.h>

#include "ifsi/assembly/rigid_shape.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/ball.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/rigid_fsi_problem.hpp"

namespace ifsi {
namespace {

using Problem = RigidFsiProblem<Quad1>;
constexpr double radius = 0.15;

FlowOptions rigid_flow_options() {
  FlowOptions options;
  options.rho_inf = 0.0;
  options.newton.rtol = 1e-10;
  return options;
}

Mesh<Quad1> square(Communicator comm) {
  return distribute(box<Quad1>({-1.0, -1.0}, {1.0, 1.0}, {30, 30}), comm);
}

/// A disc about a centre. \param force on it
Problem::Immersed disc_at(const Vec<double, 2>& centre, const Vec<double, 2>& force) {
  const auto mesh = moved(ball<Quad1>({radius, 0.6 * radius, 4, 2}), centre);
  return {{rigid_shape<Cartesian>(mesh), 2.0, force, {true, true, true}},
          boundary_points(mesh, 0),
          [centre](const auto& x) { return std::sqrt(dot(x - centre, x - centre)) - radius; }};
}

/// Walls that move to the right above and to the left below.
FlowBoundary<2> shear() {
  FlowBoundary<2> boundary;
  for (const char* side : {"left", "right", "bottom", "top"})
    boundary.velocity(side, [](const auto& x, double) { return Vec<double, 2>{x[1], 0.0}; });
  return boundary;
}
FlowBoundary<2> basin() {
  FlowBoundary<2> boundary;
  for (const char* side : {"left", "right", "bottom"}) boundary.no_slip(side);
  boundary.traction_free("top");
  return boundary;
}

// In a slow shear flow a free disc turns with half the shear rate and stays where it is.
TEST(RigidFsiProblem, ADiscInShearTurnsWithHalfTheShearRate) {
  const auto mesh = square(Communicator());
  RigidFsiOptions options;
  const auto disc = disc_at({0.0, 0.0}, {0.0, 0.0});
  EXPECT_THROW(Problem(mesh, shear(), 1.0, Newtonian{10.0}, {disc}, rigid_flow_options(), options),
               Error);  // enclosed
  options.interior = 1.0;
  Problem problem(mesh, shear(), 1.0, Newtonian{10.0}, {disc}, rigid_flow_options(), options);
  ASSERT_TRUE(problem.solve_steady().converged);
  const auto W = problem.body(0).velocity();
  EXPECT_NEAR(W[0], 0.0, 1e-6);
  EXPECT_NEAR(W[1], 0.0, 1e-6);
  EXPECT_NEAR(W[2], -0.5, 0.02);
  EXPECT_LT(problem.constraint_violation(), 1e-8);
}

struct Settling : Problem {
  explicit Settling(const Mesh<Quad1>& mesh)
      : Problem(mesh, basin(), 1.0, Newtonian{1.0}, {disc_at({0.2, 0.1}, {0.0, -1.0})}, rigid_flow_options(),
                {}) {
    EXPECT_TRUE(start_step(1e-6).converged);
    for (int k = 0; k < 5; ++k) EXPECT_TRUE(step(0.02).converged);
  }
};

// It falls, moves away from the middle line no faster than it falls, and its points move with the fluid.
TEST(RigidFsiProblem, ADiscFalls) {
  const auto mesh = square(Communicator());
  Settling problem(mesh);
  const auto& body = problem.body(0);
  EXPECT_LT(body.velocity()[1], -1e-3);
  EXPECT_LT(std::abs(body.velocity()[0]), 0.2 * std::abs(body.velocity()[1]));
  EXPECT_LT(problem.constraint_violation(), 1e-8);
  const std::vector<double> v(problem.state().velocity().begin(), problem.state().velocity().end());
  const auto v_f = problem.interpolation().velocities(v.data(), 3);
  // The body moved by 0.1 of a cell since the points were placed: r hardly changed.
  for (int p = 0; p < problem.interpolation().n_points(); ++p)
    EXPECT_NEAR(v_f[p][1],
                body.velocity()[1] +
                    body.velocity()[2] * (problem.interpolation().positions()[p][0] - body.position()[0]),
                1e-6);
}

TEST(RigidFsiProblem, DoesNotDependOnTheRanks) {
  const auto alone = square(Communicator(MPI_COMM_SELF)), shared = square(Communicator());
  const Settling one(alone), all(shared);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(all.body(0).velocity()[i], one.body(0).velocity()[i], 1e-9);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(all.body(0).position()[i], one.body(0).position()[i], 1e-10);
}

// Half a disc that rests on a symmetry plane: at the points on it only motion along it is constrained,
// however it is inclined.
std::vector<double> speeds_past_half_a_disc(const Mat<double, 2>& Q) {
  const auto turned = [&](GlobalMesh<Quad1> global) {
    for (auto& x : global.points) x = Q * x;
    return global;
  };
  const auto mesh = distribute(turned(box<Quad1>({-1.0, 0.0}, {1.0, 1.0}, {30, 15})), Communicator());
  FlowBoundary<2> boundary;
  boundary.velocity("left", [=](const auto& x, double) {
    const double y = (transpose(Q) * x)[1];
    return Q * Vec<double, 2>{1.0 - y * y, 0.0};
  });
  boundary.traction_free("right"), boundary.no_slip("top"), boundary.slip("bottom");
  const auto body = turned(ball<Quad1>({radius, 0.6 * radius, 4, 2}, {false, true}));
  Problem::Immersed disc{{rigid_shape<Cartesian>(body), 2.0, {}, {false, false, false}},
                         boundary_points(body, 0),
                         [](const auto& x) { return std::sqrt(dot(x, x)) - radius; }};
  Problem problem(mesh, boundary, 1.0, Newtonian{1.0}, {disc}, rigid_flow_options(), {});
  EXPECT_TRUE(problem.solve_steady().converged);
  EXPECT_LT(problem.constraint_violation(), 1e-8);
  const std::vector<double> u = problem.solution();
  std::vector<double> speeds(mesh.comm.sum(long{mesh.n_owned_nodes()}), 0.0);  // in the order of the input
  for (int i = 0; i < mesh.n_points(); ++i)
    if (const int a = mesh.point_node[i]; a < mesh.n_owned_nodes())
      speeds[mesh.input_point[i]] = std::hypot(u[a * 3], u[a * 3 + 1]);
  mesh.comm.sum_in_place(speeds.data(), static_cast<int>(speeds.size()));
  return speeds;
}

TEST(RigidFsiProblem, PointsOnAnInclinedSymmetryPlane) {
  const auto straight = speeds_past_half_a_disc(Mat<double, 2>::identity()),
             inclined = speeds_past_half_a_disc({{0.5, -std::sqrt(0.75), std::sqrt(0.75), 0.5}});
  for (std::size_t k = 0; k < straight.size(); ++k) EXPECT_NEAR(inclined[k], straight[k], 1e-6);
}

TEST(RigidFsiProblem, ABodyOutsideIsRefused) {
  const auto mesh = square(Communicator());
  EXPECT_THROW(Problem(mesh, basin(), 1.0, Newtonian{1.0}, {disc_at({0.95, 0.0}, {0.0, 0.0})},
                       rigid_flow_options(), {}),
               Error);
}

}  // namespace
}  // namespace ifsi
