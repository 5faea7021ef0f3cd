// Two elastic leaflets in a pulsating channel flow, the open valve of Kamensky et al. (2015) and Black et al.
// (2026).
//
//        y = 1.61 ____________________________________________
//                        |  top leaflet, 0.7 x 0.0212, clamped at the wall
//     v(y, t) ->         '                                         -> traction-free
//                        .
//        y = 0    _______|____________________________________
//              x = 0     2                                     8   cm, g, s (cgs)
//
// Metrics: tip_dx_max, tip_dx_min, tip_dy_max of the top leaflet's tip after the first cycle,
// rms_d[xy]_{ale,m3} to curves in data/reference, area_change_max, det_f_min, constraint_max (|v_s - C^T v|
// at the end of a step).
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

void open_valve(Run& run) {
  LeafletOptions o({129, 32}, {4, 100}, 5e-3);
  bool symmetry = false;
  double E = 5.6e7, nu = 0.4;
  run.params.add("symmetry", symmetry, "-", "half channel with a symmetry line at mid height");
  run.params.add("solid.E", E, "dyn/cm^2", "Young's modulus", positive);
  run.params.add("solid.nu", nu, "-", "Poisson's ratio", {-0.99, 0.4999});
  o.declare(run.params);
  run.parse();

  constexpr double length = 8.0, height = 1.61, tip_y = height - 0.7, x_1 = 2.0;
  const double x_0 = x_1 - o.thickness;
  if (symmetry) o.n[1] /= 2;
  FlowBoundary<2> boundary;
  boundary.velocity("left", [](const auto& x, double t) {
    const double pulse = 5.0 * (std::sin(2.0 * std::numbers::pi * t) + 1.1);
    return Vec<double, 2>{pulse * x[1] * (height - x[1]), 0.0};
  });
  boundary.traction_free("right"), boundary.backflow("right", 0.5);
  boundary.no_slip("top");
  symmetry ? boundary.slip("bottom") : boundary.no_slip("bottom");

  o.with_policies(NeoHookean(Lame::from_young(E, nu)), [&]<class Element>(const auto& law) {
    const auto mesh =
        distribute(box<Element>({0.0, symmetry ? 0.5 * height : 0.0}, {length, height}, o.n), run.comm());
    using Body = SolidBody<Quad1, std::decay_t<decltype(law)>>;
    std::vector<Body> leaflets;
    leaflets.emplace_back("top leaflet", box<Quad1>({x_0, tip_y}, {x_1, height}, o.n_s), law, o.solid());
    if (!symmetry)
      leaflets.emplace_back("bottom leaflet", box<Quad1>({x_0, 0.0}, {x_1, 0.7}, o.n_s), law, o.solid());
    const int tip = nearest_node(leaflets[0], {0.5 * (x_0 + x_1), tip_y});
    FsiProblem<Element, Body> problem(mesh, boundary, o.rho, Newtonian{o.mu}, std::move(leaflets), o.flow,
                                      o.fsi);
    attach(run, problem);

    TipHistory history(run, problem, o.time.end, o.picture_every, tip, "cm");
    march(run, problem, o.time, [&](double dt) { history.observe(dt); });
    history.report(o.time.end / 3.0);
    for (const std::string curve : {"ale", "m3"})
      history.compare(IFSI_DATA_DIR "/reference/open_valve_tip", curve);
    if (o.n[0] != 512 || o.time.end < 3.0) return;
    run.check("tip_dx_max", history.dx().max(1.0).value, 0.5775, 0.02, "Black et al. 2026, mesh M3");
    run.check("tip_dy_max", history.dy().max(1.0).value, 0.396, 0.02, "Black et al. 2026, mesh M3");
  });
}

int main(int argc, char** argv) {
  return run_case(argc, argv,
                  {"open_valve", "two leaflets in a pulsating channel flow, tip curves beside ALE"},
                  open_valve);
}
