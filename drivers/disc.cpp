// An elastic disc swings in a closed box of fluid with little viscosity: is energy conserved over many steps?
//
//        +---------------+
//        |    .-'''-.    |     radius 0.25 about (0.5, 0.5), neo-Hookean of shear modulus G,
//        |   (       )   |     densities 1; at t = 0 unstrained, everything in the motion
//        |    '-...-'    |     v = curl psi,  psi = v_0 (x - 1/2) (y - 1/2) sin^2(pi x) sin^2(pi y)
//        +---------------+     that stretches it along x
//
// Metrics: energy_growth, the largest rise of kinetic and elastic energy above an earlier value, over the
// initial one: physics allows none. amplitude of the node at (0.75, 0.5) in the last fifth of the run,
// frequency, area_change_max, energy_lost (to the scheme, over the work).
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

namespace {

Vec<double, 2> stretching(const Vec<double, 2>& x, double v_0) {
  constexpr double pi = std::numbers::pi;
  const auto f = [&](double s) { return (s - 0.5) * std::pow(std::sin(pi * s), 2); };
  const auto df = [&](double s) {
    return std::pow(std::sin(pi * s), 2) + (s - 0.5) * pi * std::sin(2.0 * pi * s);
  };
  return {v_0 * f(x[0]) * df(x[1]), -v_0 * df(x[0]) * f(x[1])};
}

}  // namespace

void swing(Run& run) {
  int n = 32;
  double G = 1.0, nu = 0.4, mu = 1e-3, v_0 = 4.0, picture_every = 1.0;
  TimeOptions time;
  FlowOptions flow;
  FsiOptions fsi;
  time.dt = 0.01, time.end = 10.0, flow.rho_inf = 0.0;
  run.params.add("mesh.n", n, "-", "fluid cells per side", {8, 1024});
  run.params.add("solid.G", G, "force/area", "shear modulus", positive);
  run.params.add("solid.nu", nu, "-", "Poisson's ratio", {-0.99, 0.4999});
  run.params.add("fluid.mu", mu, "mass/(length time)", "dynamic viscosity", positive);
  run.params.add("start.v", v_0, "length/time", "speed v_0 of the initial motion", positive);
  run.params.add("output.every", picture_every, "time", "time between pictures", positive);
  time.declare(run.params), flow.declare(run.params), fsi.declare(run.params);
  run.parse();

  const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {n, n}), run.comm());
  FlowBoundary<2> boundary;
  for (const std::string& side : mesh.boundary_names) boundary.no_slip(side);
  using Body = SolidBody<Quad1, NeoHookean>;
  auto section = disc<Quad1>({0.25, 0.12, n / 2, n / 4, 1.0});
  for (auto& x : section.points) x += Vec<double, 2>{0.5, 0.5};
  std::vector<Body> body;
  body.emplace_back("disc", std::move(section), NeoHookean(Lame::from_shear(G, nu)),
                    Body::Parameters{.rho_s = 1.0, .rho_f = 1.0, .mu_f = mu, .mu_s = 0.0, .gravity = {}});
  const int right = nearest_node(body[0], {0.75, 0.5});
  FsiProblem<Quad1, Body> problem(mesh, boundary, 1.0, Newtonian{mu}, std::move(body), flow, fsi);
  problem.start(0.0, [&](const auto& x) { return stretching(x, v_0); });
  attach(run, problem);

  TipHistory history(run, problem, time.end, picture_every, right, "length");
  const double start = problem.totals().kinetic;
  double least = start, growth = 0.0;
  march(run, problem, time, [&](double dt) {
    history.observe(dt);
    const double energy = problem.totals().kinetic + problem.solids().totals().elastic_energy;
    growth = std::max(growth, energy - least), least = std::min(least, energy);
  });
  history.report(0.8 * time.end);
  run.metric("amplitude",
             0.5 * (history.dx().max(0.8 * time.end).value - history.dx().min(0.8 * time.end).value),
             "length");
  run.metric("frequency", history.dx().frequency(0.0), "1/time");
  run.metric("energy_growth", growth / start);
  run.check("energy_growth", growth / start, 0.0, 0.01, "energy cannot come from nothing");
}

int main(int argc, char** argv) {
  return run_case(argc, argv, {"disc", "an elastic disc swings in a closed box: energy over many steps"},
                  swing);
}
