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
// Metrics: tip_dx_max, tip_dx_min, tip_dy_max of the top leaflet's tip after the first cycle, rms_* to curves
// in data/reference, area_change_max, det_f_min.
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

int main(int argc, char** argv) {
  return run_case(
      argc, argv, {"open_valve", "two leaflets in a pulsating channel flow, tip curves beside ALE"},
      [](Run& run) {
        std::array<int, 2> n = {129, 32}, n_s = {4, 100};
        bool symmetry = false;
        double E = 5.6e7, nu = 0.4, rho = 100.0, mu = 10.0, frames = 0.1;
        TimeOptions time;
        FlowOptions flow;
        FsiOptions fsi;
        time.dt = 5e-3, time.end = 3.0, flow.rho_inf = 0.0;
        run.params.add("mesh.nx", n[0], "-", "fluid cells along the channel", {8, 4096});
        run.params.add("mesh.ny", n[1], "-", "fluid cells across the (full) channel", {4, 1024});
        run.params.add("solid.n_thick", n_s[0], "-", "solid cells through the thickness", {1, 64});
        run.params.add("solid.n_high", n_s[1], "-", "solid cells along the leaflet", {4, 2000});
        run.params.add("symmetry", symmetry, "-", "half channel with a symmetry line at mid height");
        run.params.add("solid.E", E, "dyn/cm^2", "Young's modulus", positive);
        run.params.add("solid.nu", nu, "-", "Poisson's ratio", {-0.99, 0.4999});
        run.params.add("fluid.rho", rho, "g/cm^3", "density of fluid and solid", positive);
        run.params.add("fluid.mu", mu, "P", "dynamic viscosity", positive);
        run.params.add("output.every", frames, "s", "time between pictures", positive);
        time.declare(run.params), flow.declare(run.params), fsi.declare(run.params);
        run.parse();

        constexpr double length = 8.0, height = 1.61, leaflet = 0.7, x_0 = 1.9788, x_1 = 2.0;
        const double y_0 = symmetry ? 0.5 * height : 0.0;
        const auto mesh = distribute(
            box<Quad1>({0.0, y_0}, {length, height}, {n[0], symmetry ? n[1] / 2 : n[1]}), run.comm());
        FlowBoundary<2> boundary;
        boundary.velocity("left", [](const auto& x, double t) {
          return Vec<double, 2>{5.0 * (std::sin(2.0 * std::numbers::pi * t) + 1.1) * x[1] * (height - x[1]),
                                0.0};
        });
        boundary.traction_free("right"), boundary.backflow("right", 0.5);
        boundary.no_slip("top");
        if (symmetry)
          boundary.slip("bottom");
        else
          boundary.no_slip("bottom");

        using Body = SolidBody<Quad1, NeoHookean>;
        const Body::Parameters solid{.rho_s = rho, .rho_f = rho, .mu_f = mu};
        const NeoHookean law(Lame::from_young(E, nu));
        std::vector<Body> leaflets;
        leaflets.emplace_back("top leaflet", box<Quad1>({x_0, height - leaflet}, {x_1, height}, n_s), law,
                              solid);
        if (!symmetry)
          leaflets.emplace_back("bottom leaflet", box<Quad1>({x_0, 0.0}, {x_1, leaflet}, n_s), law, solid);
        const int tip = nearest_node(leaflets[0], {0.5 * (x_0 + x_1), height - leaflet});
        FsiProblem<Quad1, Body> problem(mesh, boundary, rho, Newtonian{mu}, std::move(leaflets), flow, fsi);
        run.totals.dofs = mesh.nodes.n_global() * 3;
        log_newton(run, problem);

        Signal dx, dy;
        FsiExtremes extremes;
        FsiPictures pictures(run, frames);
        CsvFile history = run.csv("history.csv", {{"t", "s"},
                                                  {"tip_dx", "cm"},
                                                  {"tip_dy", "cm"},
                                                  {"area", "cm^2"},
                                                  {"elastic_energy", "erg/cm"},
                                                  {"det_f_min", "-"},
                                                  {"dt", "s"}});
        march(run, problem, time, [&](double dt) {
          const auto u = problem.solids().displacement(tip);
          const auto totals = extremes.observe(problem);
          dx.add(problem.time(), u[0]), dy.add(problem.time(), u[1]);
          history.row({problem.time(), u[0], u[1], totals.volume, totals.elastic_energy,
                       totals.deformation.min_det_F, dt});
          pictures.write(problem);
        });
        pictures.write(problem, true);
        const double settled = std::min(1.0, 0.34 * time.end);
        run.metric("tip_dx_max", dx.max(settled).value, "cm"),
            run.metric("tip_dx_min", dx.min(settled).value, "cm");
        run.metric("tip_dy_max", dy.max(settled).value, "cm");
        const std::string data = IFSI_DATA_DIR "/reference/open_valve_tip_d";
        run.metric("rms_dx_ale", rms_difference(dx, data + "x_ale.csv", "dx_cm", 0.0, time.end), "cm");
        extremes.report(run);
      });
}
