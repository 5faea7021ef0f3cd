// A flexible leaflet swept to and fro by an oscillating channel flow (Black et al. 2026, section 4).
//
//        y = 1 ___________________________   symmetry (slip)
//   15 y (2 - y) sin(2 pi t)
//        ->            |  leaflet            -> traction-free      0.0212 x 0.8, clamped at the bottom wall
//        y = 0 ________|__________________   no slip
//             x = 0    x_0              4     SI units
//
// Metrics: tip_dx_max, tip_dx_min, tip_dy_min, periodicity (largest difference of the tip between the last
// two cycles over its range), area_change_max, det_f_min.
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

int main(int argc, char** argv) {
  return run_case(argc, argv, {"leaflet", "a leaflet in an oscillating channel flow"}, [](Run& run) {
    std::array<int, 2> n = {192, 32}, n_s = {4, 45};
    double x_0 = 2.0, C0 = 1e7, kappa_ratio = 0.1, rho = 100.0, mu = 10.0, frames = 0.1;
    TimeOptions time;
    FlowOptions flow;
    FsiOptions fsi;
    time.dt = 4e-3, time.end = 3.0, flow.rho_inf = 0.0;
    run.params.add("mesh.nx", n[0], "-", "fluid cells along the channel", {8, 4096});
    run.params.add("mesh.ny", n[1], "-", "fluid cells across the channel", {4, 1024});
    run.params.add("solid.n_thick", n_s[0], "-", "solid cells through the thickness", {1, 64});
    run.params.add("solid.n_high", n_s[1], "-", "solid cells along the leaflet", {4, 2000});
    run.params.add("solid.x", x_0, "m", "centre of the leaflet", {0.1, 3.9});
    run.params.add("solid.C0", C0, "Pa", "shear modulus", positive);
    run.params.add("solid.kappa_ratio", kappa_ratio, "-", "bulk modulus over C0", positive);
    run.params.add("fluid.rho", rho, "kg/m^3", "density of fluid and solid", positive);
    run.params.add("fluid.mu", mu, "Pa s", "dynamic viscosity", positive);
    run.params.add("output.every", frames, "s", "time between pictures", positive);
    time.declare(run.params), flow.declare(run.params), fsi.declare(run.params);
    run.parse();

    const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {4.0, 1.0}, n), run.comm());
    FlowBoundary<2> boundary;
    boundary.velocity("left", [](const auto& x, double t) {
      return Vec<double, 2>{15.0 * x[1] * (2.0 - x[1]) * std::sin(2.0 * std::numbers::pi * t), 0.0};
    });
    boundary.traction_free("right"), boundary.backflow("right", 0.5);
    boundary.slip("top"), boundary.no_slip("bottom");

    using Body = SolidBody<Quad1, UncoupledNeoHookean>;
    constexpr double half = 0.0106, height = 0.8;
    std::vector<Body> leaflet;
    leaflet.emplace_back(
        "leaflet", box<Quad1>({x_0 - half, 0.0}, {x_0 + half, height}, n_s),
        UncoupledNeoHookean(C0, kappa_ratio * C0),
        Body::Parameters{.rho_s = rho, .rho_f = rho, .mu_f = mu, .mu_s = 0.0, .gravity = {}});
    const int tip = nearest_node(leaflet[0], {x_0, height});
    FsiProblem<Quad1, Body> problem(mesh, boundary, rho, Newtonian{mu}, std::move(leaflet), flow, fsi);
    run.totals.dofs = mesh.nodes.n_global() * 3;
    log_newton(run, problem);

    Signal dx, dy;
    FsiExtremes extremes;
    FsiPictures pictures(run, frames);
    CsvFile history = run.csv(
        "history.csv",
        {{"t", "s"}, {"tip_dx", "m"}, {"tip_dy", "m"}, {"area", "m^2"}, {"det_f_min", "-"}, {"dt", "s"}});
    march(run, problem, time, [&](double dt) {
      const auto u = problem.solids().displacement(tip);
      const auto totals = extremes.observe(problem);
      dx.add(problem.time(), u[0]), dy.add(problem.time(), u[1]);
      history.row({problem.time(), u[0], u[1], totals.volume, totals.deformation.min_det_F, dt});
      pictures.write(problem);
    });
    pictures.write(problem, true);
    const double last = std::max(0.0, time.end - 1.0);
    run.metric("tip_dx_max", dx.max(last).value, "m"), run.metric("tip_dx_min", dx.min(last).value, "m");
    run.metric("tip_dy_min", dy.min(last).value, "m");
    if (time.end >= 3.0) run.metric("periodicity", cycle_difference(dx, time.end, 1.0));
    extremes.report(run);
  });
}
