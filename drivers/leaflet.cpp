// A flexible leaflet swept to and fro by an oscillating channel flow (Black et al. 2026, section 4).
//
//        y = 1 ___________________________   symmetry (slip)
//   15 y (2 - y) sin(2 pi t)
//        ->            |  leaflet            -> traction-free      0.0212 x 0.8, clamped at the bottom wall
//        y = 0 ________|__________________   no slip
//             x = 0    x_0              4     SI units
//
// Metrics: tip_dx_max, tip_dx_min, tip_dy_min of the last cycle, periodicity (largest difference of the tip
// between the last two cycles over its range), area_change_max, det_f_min, constraint_max.
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

void leaflet(Run& run) {
  LeafletOptions o({192, 32}, {4, 45}, 4e-3);
  double x_0 = 2.0, C0 = 1e7, kappa_ratio = 0.1;
  run.params.add("solid.x", x_0, "m", "centre of the leaflet", {0.1, 3.9});
  run.params.add("solid.C0", C0, "Pa", "shear modulus", positive);
  run.params.add("solid.kappa_ratio", kappa_ratio, "-", "bulk modulus over C0", positive);
  o.declare(run.params);
  run.parse();

  FlowBoundary<2> boundary;
  boundary.velocity("left", [](const auto& x, double t) {
    return Vec<double, 2>{15.0 * x[1] * (2.0 - x[1]) * std::sin(2.0 * std::numbers::pi * t), 0.0};
  });
  boundary.traction_free("right"), boundary.backflow("right", 0.5);
  boundary.slip("top"), boundary.no_slip("bottom");

  o.with_policies(UncoupledNeoHookean(C0, kappa_ratio * C0), [&]<class Element>(const auto& law) {
    const auto mesh = distribute(box<Element>({0.0, 0.0}, {4.0, 1.0}, o.n), run.comm());
    using Body = SolidBody<Quad1, std::decay_t<decltype(law)>>;
    constexpr double height = 0.8;
    const double half = 0.5 * o.thickness;
    std::vector<Body> body;
    body.emplace_back("leaflet", box<Quad1>({x_0 - half, 0.0}, {x_0 + half, height}, o.n_s), law, o.solid());
    const int tip = nearest_node(body[0], {x_0, height});
    FsiProblem<Element, Body> problem(mesh, boundary, o.rho, Newtonian{o.mu}, std::move(body), o.flow, o.fsi);
    attach(run, problem);

    TipHistory history(run, problem, o.time.end, o.picture_every, tip, "m");
    march(run, problem, o.time, [&](double dt) { history.observe(dt); });
    history.report(std::max(0.0, o.time.end - 1.0));
    run.metric("tip_dy_min", history.dy().min(std::max(0.0, o.time.end - 1.0)).value, "m");
    if (o.time.end >= 3.0) run.metric("periodicity", cycle_difference(history.dx(), o.time.end, 1.0));
  });
}

int main(int argc, char** argv) {
  return run_case(argc, argv, {"leaflet", "a leaflet in an oscillating channel flow"}, leaflet);
}
