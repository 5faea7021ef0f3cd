#pragma once
/// \file
/// Runs of the tests of Turek & Hron with a fluid: CFD1-3 around a rigid flag, FSI1-3 with an immersed one.

#include "ifsi/simulation/flow_case.hpp"
#include "ifsi/simulation/fsi_case.hpp"
#include "ifsi/simulation/solid_cases.hpp"
#include "ifsi/simulation/turek_hron.hpp"

namespace ifsi {

struct TurekHronOptions {
  double refinement = 1.0;
  double ramp = 2.0, settle = 0.0, force_window = 0.0, picture_every = 1.0;
  int n_long = 70, n_thick = 4;  ///< cells of the flag at refinement 1
  double nu_s = TurekHronTest::nu_s;
  std::string law = "sheet";
  TimeOptions time;
  FlowOptions flow;
  FsiOptions fsi;

  TurekHronOptions() { time.dt = 0.01, time.end = 10.0, flow.rho_inf = 0.0; }
  void declare(Parameters& params) {
    params.add("mesh.refinement", refinement, "-", "factor on all cell counts", {0.25, 8.0});
    params.add("flow.ramp", ramp, "s", "the inflow rises from rest for this long", non_negative);
    params.add("time.settle", settle, "s", "oscillations are measured from here on", non_negative);
    params.add("metrics.force_window", force_window, "s", "forces of periodic FSI tests are averaged over it",
               non_negative);
    params.add("output.every", picture_every, "s", "time between pictures", positive);
    params.add("solid.n_long", n_long, "-", "cells along the flag at mesh.refinement = 1", {4, 10000});
    params.add("solid.n_thick", n_thick, "-", "cells across the flag at mesh.refinement = 1", {1, 1000});
    params.add("solid.nu", nu_s, "-", "Poisson's ratio of the flag", {-0.99, 0.4999});
    params.add_choice("solid.law", law, {"sheet", "volume"},
                      "the flag in plane stress across its thickness, or as a volume");
    time.declare(params), flow.declare(params), fsi.declare(params);
  }
  [[nodiscard]] int scaled(int n) const { return std::max(1, static_cast<int>(std::lround(n * refinement))); }
};

/// Forces on cylinder and flag over time.
template <class Element>
void run_turek_hron_cfd(Run& run, const TurekHronTest& test, const TurekHronOptions& o) {
  const auto mesh = distribute(
      channel_with_cylinder<Element>(turek_hron_rigid_channel().refined(o.refinement)), run.comm());
  auto boundary = test.boundary(test.steady() ? 0.0 : o.ramp);
  boundary.no_slip("flag");
  FlowProblem<Element> flow(mesh, boundary, test.rho_f, Newtonian{test.mu_f}, o.flow);
  TurekHronCurves curves;
  const auto measure = [&] {
    const auto F = flow.force("cylinder") + flow.force("flag");
    curves.add("drag", flow.state().time_alpha(), F[0]), curves.add("lift", flow.state().time_alpha(), F[1]);
    return F;
  };
  if (test.steady()) {
    solve_steady(run, flow);
    measure();
    write_fields(run, flow);
    return curves.report(run, test, 0.0);
  }
  attach(run, flow);
  if (run.restarted()) curves.read(run.path("history.csv"), {"drag", "lift"}, flow.time());
  CsvFile history =
      run.csv("history.csv", {{"t", "s"}, {"drag", "N/m"}, {"lift", "N/m"}}, flow.state().time_alpha());
  march(run, flow, o.time, [&](double) {
    const auto F = measure();
    history.row({flow.state().time_alpha(), F[0], F[1]});
  });
  write_fields(run, flow);
  curves.report(run, test, o.settle);
}

/// Radius on which a flag's root lies within the cylinder, whose cells along the flag are straight.
inline double root_radius(const CylinderChannel& c) {
  const double cells_along_flag = c.n_band_rows * c.flag_half_height / c.band_half_height;
  return c.radius * std::cos(1.1 * std::asin(c.flag_half_height / c.radius) / cells_along_flag);
}

/// The flag as an immersed body: forces on cylinder and flag, and its tip.
template <class Element, class Law>
void run_flag(Run& run, const TurekHronTest& test, const TurekHronOptions& o, const Law& law) {
  using Body = SolidBody<Quad1, Law>;
  const CylinderChannel channel = turek_hron_moving_channel().refined(o.refinement);
  const auto mesh = distribute(channel_with_cylinder<Element>(channel), run.comm());
  std::vector<Body> flag;
  flag.emplace_back("flag",
                    turek_hron_flag<Quad1>(o.scaled(o.n_long), o.scaled(o.n_thick), root_radius(channel)),
                    law, SolidParameters<2>{test.rho_s, test.rho_f, test.mu_f, 0.0, {}});
  const int tip = nearest_node(flag[0], {0.6, 0.2});
  // The root lies outside of the fluid, and is held: at a node in a cell, however close to the wall, a little
  // velocity is left, with which the flag would creep.
  FsiProblem<Element, Body> problem(mesh, test.boundary(o.ramp), test.rho_f, Newtonian{test.mu_f},
                                    std::move(flag), o.flow, o.fsi, true);
  attach(run, problem);
  const std::vector<std::string> figures = {"tip_ux", "tip_uy", "drag", "lift"};
  TurekHronCurves curves;
  if (run.restarted()) curves.read(run.path("history.csv"), figures, problem.time());
  CsvFile history = run.csv("history.csv",
                            {{"t", "s"},
                             {"tip_ux", "mm"},
                             {"tip_uy", "mm"},
                             {"drag", "N/m"},
                             {"lift", "N/m"},
                             {"area_change", "-"},
                             {"det_f_min", "-"},
                             {"dt", "s"}},
                            problem.time());
  FsiExtremes extremes;
  FsiPictures pictures(run, o.picture_every);
  if (run.restarted()) pictures.resume(problem.time());
  march(run, problem, o.time, [&](double dt) {
    const auto totals = extremes.observe(problem);
    const auto u = 1e3 * problem.solids().displacement(tip), F = problem.force_with_bodies("cylinder");
    const double values[] = {u[0], u[1], F[0], F[1]};
    for (std::size_t k = 0; k < figures.size(); ++k) curves.add(figures[k], problem.time(), values[k]);
    history.row({problem.time(), u[0], u[1], F[0], F[1], totals.volume / totals.reference_volume - 1.0,
                 totals.deformation.min_det_F, dt});
    pictures.write(problem, problem.time() >= o.time.end * (1.0 - 1e-10));
  });
  extremes.report(run);
  curves.report(run, test, o.settle, test.steady() ? 0.0 : o.force_window);
}

/// The flag by its law. As a sheet it bends like the compressible flag of the benchmark, though the fluid
/// makes it incompressible; it is thicker than a cell, and keeps its shear modulus.
template <class Element>
void run_turek_hron_fsi(Run& run, const TurekHronTest& test, const TurekHronOptions& o) {
  const StVenantKirchhoff volume(Lame::from_shear(test.mu_s, o.nu_s));
  if (o.law == "volume") return run_flag<Element>(run, test, o, volume);
  run_flag<Element>(run, test, o, ThinSheet(volume, {0.0, 1.0, 0.0}, test.mu_s, 0.3 * test.mu_s));
}

}  // namespace ifsi
