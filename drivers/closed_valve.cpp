// A leaflet that closes the whole channel, loaded by a pressure difference: nothing may flow.
//
//        y = 1 ___________________________
//                        |
//     p(t) ->            |                   -> traction-free      beam: centreline x = 2, thickness 0.0212,
//                        |                                         clamped at both walls
//        y = 0 __________|________________
//             x = 0      2               4    cm, g, s (cgs); Black et al. (2026), section 4
//
// Metrics: leak_flow (time mean), p_left, p_right, midspan_ux (time means over the settled part), v_max.
// References: the beam alone under the same pressure (Q2 calculation of ours): 0.24448 cm for the
// compressible material, 0.2313 cm in the incompressible limit that an immersed solid tends to.
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

void closed_valve(Run& run) {
  LeafletOptions o({128, 32}, {5, 64}, 1e-2);
  double E = 5.6e7, nu = 0.4, load = 3e5, ramp = 0.1, settle = 1.0;
  run.params.add("solid.E", E, "dyn/cm^2", "Young's modulus", positive);
  run.params.add("solid.nu", nu, "-", "Poisson's ratio", {-0.99, 0.4999});
  run.params.add("load.pressure", load, "dyn/cm^2", "inlet pressure after the ramp", positive);
  run.params.add("load.ramp", ramp, "s", "length of the ramp", positive);
  run.params.add("time.settle", settle, "s", "time means are taken from here on", non_negative);
  o.declare(run.params);
  run.parse();

  FlowBoundary<2> boundary;
  boundary.pressure("left", [=](double t) { return load * std::min(1.0, t / ramp); });
  boundary.traction_free("right");
  boundary.no_slip("top"), boundary.no_slip("bottom");

  o.with_policies(NeoHookean(Lame::from_young(E, nu)), [&]<class Element>(const auto& law) {
    const auto mesh = distribute(box<Element>({0.0, 0.0}, {4.0, 1.0}, o.n), run.comm());
    using Body = SolidBody<Quad1, std::decay_t<decltype(law)>>;
    const double half = 0.5 * o.thickness;
    std::vector<Body> beam;
    beam.emplace_back("beam", box<Quad1>({2.0 - half, 0.0}, {2.0 + half, 1.0}, o.n_s), law, o.solid());
    const int middle = nearest_node(beam[0], {2.0, 0.5});
    FsiProblem<Element, Body> problem(mesh, boundary, o.rho, Newtonian{o.mu}, std::move(beam), o.flow, o.fsi);
    const Probe<Element> ends(mesh, {{1.0, 0.5}, {3.0, 0.5}});
    attach(run, problem);

    Signal leak, p_left, p_right;
    double v_max = 0.0;
    TipHistory history(run, problem, o.time.end, o.picture_every, middle, "cm",
                       {{"leak", "cm^2/s"}, {"p_left", "dyn/cm^2"}, {"p_right", "dyn/cm^2"}});
    march(run, problem, o.time, [&](double dt) {
      const double t = problem.time();
      const auto u = problem.solution();
      const auto p = ends.values(u, 3);
      leak.add(t, boundary_flux<Cartesian>(mesh, mesh.boundary("right"), u));
      p_left.add(t, p[2]), p_right.add(t, p[5]);
      if (t >= settle) v_max = std::max(v_max, largest_speed(problem));
      history.observe(dt, {leak.at(t), p[2], p[5]});
    });
    const double ux = history.dx().mean(settle);
    run.metric("leak_flow", leak.mean(settle), "cm^2/s"), run.metric("v_max", v_max, "cm/s");
    run.metric("p_left", p_left.mean(settle), "dyn/cm^2"),
        run.metric("p_right", p_right.mean(settle), "dyn/cm^2");
    run.metric("midspan_ux", ux, "cm");
    history.report(settle);
    run.check("p_left", p_left.mean(settle), load, 5e-3, "hydrostatics: no flow, no pressure drop");
    run.check("p_right_over_load", p_right.mean(settle) / load, 0.0, 5e-3, "hydrostatics");
    run.check_between("midspan_ux", ux, 0.98 * 0.2313, 1.02 * 0.24448, "beam alone, Q2 calculation of ours");
  });
}

int main(int argc, char** argv) {
  return run_case(argc, argv,
                  {"closed_valve", "a closed valve under pressure: leak, pressure jump, deflection"},
                  closed_valve);
}
