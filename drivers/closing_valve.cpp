// Two slanted leaflets that a reversed pressure closes: do they touch, and do they stay out of each other?
//
//        y = 1 ____________________________
//                    \ .
//     traction-free     \  .             <- p(t)       leaflets clamped at the walls, straight at first,
//                       /                              slanted downstream, the lower one longer by `longer`
//        y = 0 ______/_____________________
//             x = 0  1.5                   4    cm, g, s (cgs)
//
// Metrics: gap_min, gap_end (distance of the nodes of both leaflets), inside_max (nodes of one leaflet inside
// the other), leak_end (flow back through the valve over the last fifth), tip_*, s1_p99.
#include "ifsi/simulation/fsi_case.hpp"
#include "ifsi/simulation/solid_overlap.hpp"

using namespace ifsi;

namespace {

/// A straight leaflet from the wall at `y` to y + height (either sign), sheared by `slant` per height.
GlobalMesh<Quad1> leaflet(double y, double height, double thickness, double slant, std::array<int, 2> n) {
  auto mesh = box<Quad1>({1.5, std::min(y, y + height)}, {1.5 + thickness, std::max(y, y + height)}, n);
  for (auto& p : mesh.points) p[0] += slant * std::abs(p[1] - y);
  return mesh;
}

}  // namespace

void closing_valve(Run& run) {
  LeafletOptions o({128, 32}, {4, 64}, 2e-3);
  double E = 5.6e7, nu = 0.4, height = 0.42, slant = 1.0, longer = 0.0, load = 300.0, ramp = 0.1;
  o.time.end = 1.0, o.picture_every = 0.05, o.fsi.contact_range = 1.0, o.fsi.contact_pressure = 300.0;
  run.params.add("solid.E", E, "dyn/cm^2", "Young's modulus", positive);
  run.params.add("solid.nu", nu, "-", "Poisson's ratio", {-0.99, 0.4999});
  run.params.add("solid.height", height, "cm", "height of the leaflets above their walls", {0.1, 0.49});
  run.params.add("solid.slant", slant, "-", "distance downstream per height", non_negative);
  run.params.add("solid.longer", longer, "cm", "by how much the lower leaflet is higher", non_negative);
  run.params.add("load.pressure", load, "dyn/cm^2", "pressure at the outlet after the ramp", positive);
  run.params.add("load.ramp", ramp, "s", "length of the ramp", positive);
  o.declare(run.params);
  run.parse();

  const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {4.0, 1.0}, o.n), run.comm());
  FlowBoundary<2> boundary;
  boundary.pressure("right", [=](double t) { return load * std::min(1.0, t / ramp); });
  boundary.traction_free("left"), boundary.backflow("left", 0.5), boundary.backflow("right", 0.5);
  boundary.no_slip("top"), boundary.no_slip("bottom");

  using Body = SolidBody<Quad1, NeoHookean>;
  const NeoHookean law(Lame::from_young(E, nu));
  std::vector<Body> leaflets;
  leaflets.emplace_back("top leaflet", leaflet(1.0, -height, o.thickness, slant, o.n_s), law, o.solid());
  leaflets.emplace_back("bottom leaflet", leaflet(0.0, height + longer, o.thickness, slant, o.n_s), law,
                        o.solid());
  const int tip = nearest_node(leaflets[0], {1.5 + slant * height, 1.0 - height});
  FsiProblem<Quad1, Body> problem(mesh, boundary, o.rho, Newtonian{o.mu}, std::move(leaflets), o.flow, o.fsi);
  attach(run, problem);

  Signal gap, leak;
  int inside_max = 0;
  TipHistory history(run, problem, o.time.end, o.picture_every, tip, "cm",
                     {{"gap", "cm"}, {"inside", "-"}, {"leak", "cm^2/s"}});
  march(run, problem, o.time, [&](double dt) {
    const double t = problem.time();
    const SolidNearness near = nearness(problem.solids().bodies(), problem.solids().positions());
    inside_max = std::max(inside_max, near.inside);
    gap.add(t, near.distance);
    leak.add(t, boundary_flux<Cartesian>(mesh, mesh.boundary("left"), problem.solution()));
    history.observe(dt, {near.distance, static_cast<double>(near.inside), leak.last()});
  });
  history.report(0.0);
  run.metric("gap_min", gap.min().value, "cm"), run.metric("gap_end", gap.last(), "cm");
  run.metric("inside_max", inside_max), run.metric("leak_end", leak.mean(0.8 * o.time.end), "cm^2/s");
  run.check("inside_max", inside_max, 0.0, 0.5, "solids do not pass through each other");
}

int main(int argc, char** argv) {
  return run_case(argc, argv, {"closing_valve", "two leaflets close against each other: contact"},
                  closing_valve);
}
