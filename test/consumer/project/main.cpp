// A soft disc carried along a channel: ifsi within a program of one's own, which owns MPI, meshes and time
// loop.
#include <cmath>
#include <iostream>

#include "ifsi/core/error.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/ball.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/fsi_problem.hpp"

using namespace ifsi;

namespace {

int carry_a_disc() {
  using Disc = SolidBody<Quad1, NeoHookean>;
  // Cells of any shape: read_gmsh<Tri1>("fluid.msh") in place of the box, read_gmsh<Quad1>("solid.msh") of
  // the disc.
  const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {2.0, 1.0}, {24, 12}), Communicator());
  std::vector<Disc> bodies;
  bodies.emplace_back(
      "disc", moved(ball<Quad1>({.radius = 0.2, .core_radius = 0.12, .n_core = 2, .n_shell = 1}), {0.5, 0.5}),
      NeoHookean(Lame::from_young(1e3, 0.4)),
      SolidParameters<2>{.rho_s = 1.1, .rho_f = 1.0, .mu_f = 0.1, .mu_s = 0.0, .gravity = {}});

  FlowBoundary<2> boundary;
  boundary.velocity("left", [](const Vec<double, 2>& x, double t) {
    return Vec<double, 2>{std::min(1.0, 10.0 * t) * 4.0 * x[1] * (1.0 - x[1]), 0.0};
  });
  boundary.traction_free("right");
  boundary.no_slip("top"), boundary.no_slip("bottom");

  FlowOptions flow;
  flow.rho_inf = 0.0;
  FsiProblem<Quad1, Disc> problem(mesh, boundary, 1.0, Newtonian{0.1}, std::move(bodies), flow, FsiOptions{});
  for (int n = 0; n < 10; ++n) {
    const StepReport report = problem.step(0.04);
    if (!report.converged) {
      std::cerr << "t = " << problem.time() << ": " << report.failure << '\n';
      return 1;
    }
  }
  const auto totals = problem.solids().totals();
  const double area = totals.volume / totals.reference_volume;
  const double v = totals.momentum[0] / (1.1 * totals.reference_volume);
  std::cout << "consumer: v " << v << ", area " << area << '\n';
  return v > 0.5 && v < 1.0 && std::abs(area - 1.0) < 0.01 ? 0 : 1;  // as fast as the fluid around, to a part
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int result = 1;
  try {
    result = carry_a_disc();
  } catch (const Error& error) {  // bad input, with what was found and expected
    std::cerr << "consumer: " << error.what() << '\n';
  }
  MPI_Finalize();
  return result;
}
