// Flows solved end to end on small meshes: exactness, orders, forces, and the same answer on any number of
// ranks.
#include <gtest/gtest.h>

#include <cmath>

#include "ifsi/coupling/point_locator.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/axisymmetric_flow.hpp"
#include "ifsi/simulation/exact_flows.hpp"
#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {
namespace {

FlowOptions tight(double rho_inf = 0.5) {
  FlowOptions options;
  options.rho_inf = rho_inf;
  options.newton.rtol = 1e-11;
  return options;
}

// Poiseuille flow is quadratic in y: order-2 cells hold it exactly, stabilisation and all.
template <class Element>
FlowProblem<Element> poiseuille(const Mesh<Element>& mesh, const std::string& method) {
  FlowBoundary<2> boundary;
  boundary.velocity("left", [](const auto& x, double) { return Vec<double, 2>{x[1] * (1.0 - x[1]), 0.0}; });
  boundary.traction("right", [](const auto& x, double) {
    return Vec<double, 2>{0.0, 0.1 * (1.0 - 2.0 * x[1])};
  });
  boundary.no_slip("top"), boundary.no_slip("bottom");
  FlowOptions options = tight();
  options.linear.method = method;
  FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{0.1}, options);
  const NewtonReport report = flow.solve_steady();
  EXPECT_TRUE(report.converged) << report.failure;
  return flow;
}

template <class Element>
void expect_poiseuille(const FlowProblem<Element>& flow) {
  const auto u = flow.solution();
  const auto x = flow.mesh().node_coordinates();
  for (std::size_t a = 0; a < x.size(); ++a) {
    EXPECT_NEAR(u[a * 3], x[a][1] * (1.0 - x[a][1]), 1e-8);
    EXPECT_NEAR(u[a * 3 + 1], 0.0, 1e-8);
    EXPECT_NEAR(u[a * 3 + 2], 0.2 * (2.0 - x[a][0]), 1e-8);  // dp/dx = -2 mu
  }
}

TEST(FlowProblem, PoiseuilleIsExactOnQuadraticCells) {
  const Communicator comm;
  const auto quads = distribute(box<Quad2>({0.0, 0.0}, {2.0, 1.0}, {4, 3}), comm);
  const auto triangles = distribute(box<Tri2>({0.0, 0.0}, {2.0, 1.0}, {4, 3}), comm);
  expect_poiseuille(poiseuille(quads, "direct"));
  expect_poiseuille(poiseuille(triangles, "direct"));
}

// A start a hundred thousand times too fast: what is small beside its terms is not small beside the
// solution's.
TEST(FlowProblem, ConvergesByTheTermsOfTheSolution) {
  const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {6, 6}), Communicator());
  FlowBoundary<2> boundary;
  for (const char* side : {"left", "bottom", "top"}) boundary.no_slip(side);
  boundary.traction("right", [](const auto&, double) { return Vec<double, 2>{0.0, 1.0}; });
  FlowOptions options;
  options.linear.method = "gmres";
  FlowProblem<Quad1> flow(mesh, boundary, 1.0, Newtonian{1e6}, options);
  flow.start(0.0, [](const auto& x) { return 0.1 * Vec<double, 2>{std::sin(5 * x[1]), std::cos(7 * x[0])}; });
  EXPECT_TRUE(flow.solve_steady().converged);
  flow.assemble_tangent();
  const BlockNorms r = flow.relative_residual();
  EXPECT_LE(r.momentum, 2 * options.newton.rtol);
  EXPECT_LE(r.mass, 2 * options.newton.rtol);
}

template <class Element>
std::vector<double> vortex(const Mesh<Element>& mesh, double rho_inf, double dt, int steps) {
  const TaylorGreen exact{0.05};
  FlowBoundary<2> boundary;
  for (const std::string& side : mesh.boundary_names)
    boundary.velocity(side, [=](const auto& x, double t) { return exact.v(x, t); });
  FlowOptions options = tight(rho_inf);
  options.tau_dt = 0.1;
  FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{0.05}, options);
  flow.start(
      0.0, [&](const auto& x) { return exact.v(x, 0.0); }, [&](const auto& x) { return exact.v_dot(x, 0.0); },
      [&](const auto& x) { return exact.p(x, 0.0); });
  for (int k = 0; k < steps; ++k) EXPECT_TRUE(flow.step(dt).converged);
  return flow.solution();
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b, int component,
                          int stride = 3) {
  double d = 0.0;
  for (std::size_t i = component; i < a.size(); i += stride) d = std::max(d, std::abs(a[i] - b[i]));
  return Communicator().max(d);
}

TEST(FlowProblem, SecondOrderInTimeForVelocityAndPressure) {
  const auto mesh = distribute(box<Quad2>({0.0, 0.0}, {1.0, 1.0}, {8, 8}), Communicator());
  for (double rho_inf : {0.5, 0.0}) {
    const auto a = vortex(mesh, rho_inf, 0.05, 16), b = vortex(mesh, rho_inf, 0.025, 32),
               c = vortex(mesh, rho_inf, 0.0125, 64);
    for (int component : {0, 2}) {
      const double order =
          std::log2(largest_difference(a, b, component) / largest_difference(b, c, component));
      EXPECT_GT(order, 1.6) << "rho_inf " << rho_inf << " component " << component;
      EXPECT_LT(order, 2.6) << "rho_inf " << rho_inf << " component " << component;
    }
  }
}

// The same problem on this rank alone and on all ranks.
TEST(FlowProblem, DoesNotDependOnTheRanks) {
  const auto global = box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {12, 10});
  const auto alone = distribute(global, Communicator(MPI_COMM_SELF)),
             shared = distribute(global, Communicator());
  const auto u = vortex(alone, 0.5, 0.05, 3), w = vortex(shared, 0.5, 0.05, 3);
  std::vector<int> local(global.points.size());
  for (int i = 0; i < alone.n_points(); ++i) local[alone.input_point[i]] = alone.point_node[i];
  for (int i = 0; i < shared.n_points(); ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(w[shared.point_node[i] * 3 + k], u[local[shared.input_point[i]] * 3 + k], 1e-8);
}

TEST(FlowProblem, DirectAndIterativeSolversAgree) {
  const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {2.0, 1.0}, {16, 8}), Communicator());
  const auto a = poiseuille(mesh, "direct").solution(), b = poiseuille(mesh, "gmres").solution();
  for (int component : {0, 1, 2}) EXPECT_LT(largest_difference(a, b, component), 1e-7);
}

// Half a channel with a symmetry line is the whole channel's lower half.
TEST(FlowProblem, SlipIsASymmetryLine) {
  const auto mesh = distribute(box<Quad2>({0.0, 0.0}, {2.0, 0.5}, {4, 2}), Communicator());
  FlowBoundary<2> boundary;
  boundary.velocity("left", [](const auto& x, double) { return Vec<double, 2>{x[1] * (1.0 - x[1]), 0.0}; });
  boundary.traction("right", [](const auto& x, double) {
    return Vec<double, 2>{0.0, 0.1 * (1.0 - 2.0 * x[1])};
  });
  boundary.no_slip("bottom"), boundary.slip("top");
  FlowProblem<Quad2> flow(mesh, boundary, 1.0, Newtonian{0.1}, tight());
  ASSERT_TRUE(flow.solve_steady().converged);
  expect_poiseuille(flow);
}

template <class Element>
GlobalMesh<Element> turned(GlobalMesh<Element> mesh, const Mat<double, Element::dim>& Q) {
  for (auto& x : mesh.points) x = Q * x;
  return mesh;
}

// The same half channel, its symmetry line inclined by 60 degrees.
TEST(FlowProblem, SlipIsASymmetryLineHoweverInclined) {
  const Mat<double, 2> Q{{0.5, -std::sqrt(0.75), std::sqrt(0.75), 0.5}}, Qt = transpose(Q);
  const auto mesh = distribute(turned(box<Quad2>({0.0, 0.0}, {2.0, 0.5}, {4, 2}), Q), Communicator());
  using V = Vec<double, 2>;
  FlowBoundary<2> boundary;
  boundary.velocity("left", [=](const V& x, double) {
    const double y = (Qt * x)[1];
    return Q * V{y * (1.0 - y), 0.0};
  });
  boundary.traction("right", [=](const V& x, double) { return Q * V{0.0, 0.1 * (1.0 - 2.0 * (Qt * x)[1])}; });
  boundary.no_slip("bottom"), boundary.slip("top");
  for (const char* method : {"direct", "gmres"}) {
    FlowOptions options = tight();
    options.linear.method = method;
    FlowProblem<Quad2> flow(mesh, boundary, 1.0, Newtonian{0.1}, options);
    ASSERT_TRUE(flow.solve_steady().converged);
    const auto u = flow.solution();
    const auto x = mesh.node_coordinates();
    for (std::size_t a = 0; a < x.size(); ++a) {
      const V at = Qt * x[a], v = Qt * V{u[a * 3], u[a * 3 + 1]};
      EXPECT_NEAR(v[0], at[1] * (1.0 - at[1]), 1e-8);
      EXPECT_NEAR(v[1], 0.0, at[1] > 0.5 - 1e-9 ? 1e-16 : 1e-8);  // nothing passes the plane
      EXPECT_NEAR(u[a * 3 + 2], 0.2 * (2.0 - at[0]), 1e-8);
    }
  }
}

// Symmetry planes that meet at 60 degrees: the potential r^3 cos(3 theta) has a quadratic velocity, which
// order-2 cells hold exactly.
TEST(FlowProblem, SlipPlanesMayMeetAtAnyAngle) {
  constexpr int n = 4;
  GlobalMesh<Tri1> wedge;
  const auto index = [](int i, int j) { return j * (n + 1) - j * (j - 1) / 2 + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i + j <= n; ++i) wedge.points.push_back({(i + 0.5 * j) / n, std::sqrt(0.75) * j / n});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + j < n; ++i) {
      wedge.cells.push_back({index(i, j), index(i + 1, j), index(i, j + 1)});
      if (i + j + 1 < n) wedge.cells.push_back({index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  wedge.boundary_names = {"below", "above", "open"};
  mark_boundaries(wedge, [](const auto& x) {
    if (x[1] < 1e-9) return 0;
    return x[1] > std::sqrt(3.0) * x[0] - 1e-9 ? 1 : 2;
  });
  const auto mesh = distribute(elevate<Tri2>(wedge), Communicator());
  const auto exact = [](const auto& x, double) {
    return Vec<double, 2>{x[0] * x[0] - x[1] * x[1], -2.0 * x[0] * x[1]};
  };
  FlowBoundary<2> boundary;
  boundary.slip("below"), boundary.slip("above"), boundary.velocity("open", exact);
  FlowProblem<Tri2> flow(mesh, boundary, 1e-9, Newtonian{1.0}, tight());
  ASSERT_TRUE(flow.solve_steady().converged);
  const auto u = flow.solution();
  const auto x = mesh.node_coordinates();
  for (std::size_t a = 0; a < x.size(); ++a)
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(u[a * 3 + i], exact(x[a], 0.0)[i], 1e-8);
}

// In space: slip on five sides that meet in edges, and with a wall; the box turned about all axes has the
// same flow, turned.
TEST(FlowProblem, ATurnedBoxHasTheTurnedFlow) {
  using V = Vec<double, 3>;
  const auto global = box<Tet1>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {4, 3, 3});
  const auto flow_in = [&](const Mat<double, 3>& Q) {
    const auto mesh = distribute(turned(global, Q), Communicator());
    FlowBoundary<3> boundary;
    boundary.velocity("left", [=](const V& x, double t) {
      const V at = transpose(Q) * x;
      return Q * V{t * (1.0 + at[1] + at[2]), 0.0, 0.0};
    });
    boundary.traction_free("right"), boundary.no_slip("top");
    for (const char* side : {"front", "back", "bottom"}) boundary.slip(side);
    FlowProblem<Tet1> flow(mesh, boundary, 1.0, Newtonian{0.1}, tight());
    EXPECT_TRUE(flow.step(0.1).converged && flow.step(0.1).converged);
    const std::vector<double> u = flow.solution();
    std::vector<double> straight(global.points.size() * 4, 0.0);  // the same order however the box is turned
    for (int i = 0; i < mesh.n_points(); ++i) {
      const double* at = &u[mesh.point_node[i] * 4];
      if (mesh.point_node[i] >= mesh.n_owned_nodes()) continue;
      const V v = transpose(Q) * V{at[0], at[1], at[2]};
      for (int k = 0; k < 4; ++k) straight[mesh.input_point[i] * 4 + k] = k < 3 ? v[k] : at[3];
    }
    mesh.comm.sum_in_place(straight.data(), static_cast<int>(straight.size()));
    return straight;
  };
  const Mat<double, 3> Q{{0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6}};
  const auto straight = flow_in(Mat<double, 3>::identity()), inclined = flow_in(Q);
  double largest = 0.0;
  for (std::size_t k = 0; k < straight.size(); ++k) {
    EXPECT_NEAR(inclined[k], straight[k], 1e-8);
    if (k % 4 == 1) largest = std::max(largest, std::abs(straight[k]));
  }
  EXPECT_GT(largest, 1e-3);  // it is no parallel flow
}

TEST(FlowProblem, SlipNeedsAPlane) {
  auto global = box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {6, 6});
  for (auto& x : global.points) x[1] += 0.1 * x[0] * x[0];
  const auto mesh = distribute(global, Communicator());
  FlowBoundary<2> boundary;
  boundary.no_slip("left"), boundary.no_slip("right"), boundary.no_slip("bottom"), boundary.slip("top");
  try {
    FlowProblem<Quad1>(mesh, boundary, 1.0, Newtonian{}, {});
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::configuration);
    EXPECT_NE(std::string(e.what()).find("\"top\" is no plane"), std::string::npos) << e.what();
  }
}

/// Periodic in x, driven by a body force in the place of -dp/dx; mu dv/dy = 0.1 at the walls.
template <class Element>
FlowProblem<Element> periodic_poiseuille(const Mesh<Element>& mesh) {
  FlowBoundary<2> boundary;
  boundary.no_slip("bottom"), boundary.no_slip("top");
  FlowOptions options = tight();
  options.gravity = {0.2, 0.0, 0.0};
  FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{0.1}, options);
  EXPECT_TRUE(flow.solve_steady().converged);
  return flow;
}

// The walls hold the whole body force (eq. 12).
TEST(FlowProblem, ConsistentForceBalancesTheBodyForce) {
  const auto mesh = distribute(box<Quad2>({0.0, 0.0}, {2.0, 1.0}, {6, 4}, {{true, false}}), Communicator());
  const auto flow = periodic_poiseuille(mesh);
  const auto u = flow.solution();
  const auto x = flow.mesh().node_coordinates();
  for (std::size_t a = 0; a < x.size(); ++a) EXPECT_NEAR(u[a * 3], x[a][1] * (1.0 - x[a][1]), 1e-8);
  EXPECT_NEAR(flow.force("top")[0], 0.2, 1e-8);
  EXPECT_NEAR(flow.force("bottom")[0], 0.2, 1e-8);
}

/// Integral of -sigma n over a boundary by the velocity gradient of its cells.
template <class Element>
Vec<double, 2> surface_stress(const FlowProblem<Element>& flow, const std::string& boundary, double mu) {
  const auto& mesh = flow.mesh();
  const auto u = flow.solution();
  const PointLocator<Element> locator(mesh);
  auto F = Vec<double, 2>::zero();
  for_each_face_point<Cartesian>(mesh, mesh.boundary(boundary), true, [&](const FacePoint<2>& q) {
    const auto X = mesh.cell_coordinates(q.cell);
    const auto xi = locator.find(q.x).xi;
    std::array<Vec<double, 2>, Element::n_nodes> dN;
    Element::gradients(xi, dN);
    const auto grad_N = physical_gradients(dN, inverse(jacobian(dN, X)));
    auto sigma = Mat<double, 2>::zero();
    for (std::size_t a = 0; a < q.nodes.size(); ++a)
      for (int i = 0; i < 2; ++i) sigma(i, i) -= q.N[a] * u[q.nodes[a] * 3 + 2];
    for (int a = 0; a < Element::n_nodes; ++a)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
          const double dv_ij = u[mesh.cells[q.cell][a] * 3 + i] * grad_N[a][j];
          sigma(i, j) += mu * dv_ij, sigma(j, i) += mu * dv_ij;
        }
    F -= sigma * q.n_dA;
  });
  mesh.comm.sum_in_place(F.data, 2);
  return F;
}

// (eq. 31) on cells that hold Poiseuille flow exactly: shear 0.1, and the pressure.
TEST(FlowProblem, WallTractionOfPoiseuilleFlow) {
  const auto mesh = distribute(box<Quad2>({0.0, 0.0}, {2.0, 1.0}, {8, 3}), Communicator());
  const auto flow = poiseuille(mesh, "direct");
  const auto wall = flow.wall_traction({"bottom"});
  const auto x = mesh.node_coordinates();
  for (int node = 0; node < mesh.n_nodes(); ++node) {
    const bool is_end = x[node][0] < 1e-9 || x[node][0] > 2.0 - 1e-9;
    if (is_end) continue;  // there the boundaries on both sides hold the node
    const bool on_wall = x[node][1] == 0.0;
    EXPECT_NEAR(wall.shear[node][0], on_wall ? 0.1 : 0.0, 1e-9);
    EXPECT_NEAR(wall.shear[node][1], 0.0, 1e-12);
    EXPECT_NEAR(wall.traction[node][1], on_wall ? -0.2 * (2.0 - x[node][0]) : 0.0, 1e-9);
  }
}

// Bilinear cells: the consistent shear stress is exact where the stress of the cells at the wall is of
// first order; the integral of that tends to the consistent force.
TEST(FlowProblem, WallShearStressOfBilinearCells) {
  std::vector<double> difference;
  for (int n : {8, 16}) {
    const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {2.0, 1.0}, {4, n}, {{true, false}}), Communicator());
    const auto flow = periodic_poiseuille(mesh);
    const auto shear = flow.wall_traction({"top", "bottom"}).shear;
    for (const char* wall : {"top", "bottom"})
      for (int node : mesh.nodes_on(wall)) EXPECT_NEAR(shear[node][0], 0.1, 1e-9);
    difference.push_back((flow.force("bottom") - surface_stress(flow, "bottom", 0.1))[0]);
  }
  EXPECT_NEAR(difference[0], 0.2 / 8, 1e-9);
  EXPECT_NEAR(difference[1], 0.2 / 16, 1e-9);
}

// A pipe of mean velocity U: 4 mu U / R, to second order.
TEST(FlowProblem, WallShearStressInAPipe) {
  constexpr double U = 0.7, R = 0.5, mu = 0.2;
  std::vector<double> error;
  for (int n : {8, 16}) {
    const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {R, 2.0}, {n, n}), Communicator());
    FlowBoundary<2> boundary;
    boundary.velocity("bottom", [](const auto& x, double) {
      return Vec<double, 2>{0.0, 2.0 * U * (1.0 - x[0] * x[0] / (R * R))};
    });
    boundary.traction_free("top"), boundary.slip("left"), boundary.no_slip("right");
    FlowProblem<Quad1, AxisymmetricFlow> flow(mesh, boundary, 1.0, Newtonian{mu}, tight());
    ASSERT_TRUE(flow.solve_steady().converged);
    const auto shear = flow.wall_traction({"right"}).shear;
    const auto x = mesh.node_coordinates();
    double largest = 0.0;
    for (int node : mesh.nodes_on("right"))
      if (std::abs(x[node][1] - 1.0) < 0.3)
        largest = std::max(largest, std::abs(shear[node][1] / (4.0 * mu * U / R) - 1.0));
    error.push_back(mesh.comm.max(largest));
  }
  EXPECT_LT(error[1], 1.5e-3);
  EXPECT_LT(error[1], 0.3 * error[0]) << error[0];
}

TEST(FlowProblem, EveryBoundaryNeedsACondition) {
  const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {4, 4}), Communicator());
  FlowBoundary<2> boundary;
  boundary.no_slip("left"), boundary.no_slip("right"), boundary.no_slip("top");
  try {
    FlowProblem<Quad1>(mesh, boundary, 1.0, Newtonian{}, {});
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::configuration);
    EXPECT_NE(std::string(e.what()).find("bottom"), std::string::npos);
  }
  boundary.no_slip("botom");
  EXPECT_THROW(FlowProblem<Quad1>(mesh, boundary, 1.0, Newtonian{}, {}), Error);
}

}  // namespace
}  // namespace ifsi
