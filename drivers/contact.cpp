// Solids that touch: do they stay out of each other?
//
//     scene=valve                                        scene=discs
//        y = 1 ________________________                     +---------+
//                  \                                        |   _     |   closed box of 1 x 1,
//     traction-free  \            <- p(t)                   |  (_) |  |   discs of radius 0.15 whose
//                    /                                      |   _  v  |   weights drive them together
//        y = 0 ____/___________________                     |  (_) ^  |
//             x = 0  1                 3   cm, g, s         +---------+
//
//     a reversed pressure closes two leaflets, straight and slanted at first, clamped at the walls
//
// Metrics: gap_min, gap_end (least distance of the nodes of two bodies), inside_max (nodes of one body inside
// another), leak_end (flow out on the left in the last fifth), s1_p99, contact_gap_min (nodes that repel).
#include "ifsi/simulation/contact_cases.hpp"
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

void contact(Run& run) {
  ContactOptions o;
  o.time.dt = 3e-3, o.time.end = 0.6, o.flow.rho_inf = 0.0, o.fsi.contact_range = 3.0;
  o.declare(run.params);
  run.parse();
  if (o.fsi.contact_pressure == 0.0) o.fsi.contact_pressure = o.load;

  ContactScene scene = o.scene == "valve" ? closing_valve(o) : colliding_discs(o);
  const auto mesh = distribute(scene.fluid, run.comm());
  const int tip = nearest_node(scene.bodies[0], {1.0 + 0.42 * o.slant, 0.58});
  FsiProblem<Quad1, ContactScene::Body> problem(mesh, scene.boundary, o.rho, Newtonian{o.mu},
                                                std::move(scene.bodies), o.flow, o.fsi);
  if (o.fsi.contact_range > 0.0)
    for (const auto& plane : scene.planes) problem.add_contact_plane(plane);
  attach(run, problem);

  Signal gap, leak;
  int inside_max = 0;
  TipHistory history(run, problem, o.time.end, o.picture_every, tip, "cm",
                     {{"gap", "cm"}, {"inside", "-"}, {"leak", "cm^2/s"}});
  march(run, problem, o.time, [&](double dt) {
    auto near = nearness(problem.solids().bodies(), problem.solids().positions());
    if (o.symmetry)  // the other leaflet is the mirror image
      for (const auto& x : problem.solids().positions())
        near.distance = std::min(near.distance, 2.0 * x[1] - 1.0);
    inside_max = std::max(inside_max, near.inside);
    gap.add(problem.time(), near.distance);
    leak.add(problem.time(), boundary_flux<Cartesian>(mesh, mesh.boundary("left"), problem.solution()));
    history.observe(dt, {near.distance, static_cast<double>(near.inside), leak.last()});
  });
  history.report(0.0);
  run.metric("gap_min", gap.min().value, "cm"), run.metric("gap_end", gap.last(), "cm");
  run.metric("leak_end", leak.mean(0.8 * o.time.end), "cm^2/s"), run.metric("inside_max", inside_max);
  run.check("inside_max", inside_max, 0.0, 0.5, "solids do not pass through each other");
}

int main(int argc, char** argv) {
  return run_case(argc, argv, {"contact", "leaflets that close, discs that collide: contact"}, contact);
}
