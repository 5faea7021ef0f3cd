#pragma once
/// \file
/// The structural tests CSM1-3 of Turek & Hron (2006, doi:10.1007/3-540-34596-5_15): their flag in gravity,
/// without a fluid.

#include "ifsi/io/run.hpp"
#include "ifsi/simulation/signal.hpp"
#include "ifsi/simulation/solid_cases.hpp"
#include "ifsi/simulation/solid_output.hpp"
#include "ifsi/simulation/solid_problem.hpp"

namespace ifsi {

/// Mesh of biquadratic cells and, for CSM3, time steps.
struct CsmOptions {
  int n_x = 35, n_y = 2;  ///< cells along and across the flag
  double dt = 0.005, end = 10.0;
  double rho_inf = 1.0;

  void declare(Parameters& params, const std::string& prefix = "csm.") {
    params.add(prefix + "n_x", n_x, "-", "cells along the flag", {4, 1000});
    params.add(prefix + "n_y", n_y, "-", "cells across the flag", {1, 64});
    params.add(prefix + "dt", dt, "s", "time step of CSM3", {1e-4, 0.1});
    params.add(prefix + "end", end, "s", "end of CSM3", {2.0, 100.0});
    params.add(prefix + "rho_inf", rho_inf, "-", "spectral radius of generalized-alpha", {0.0, 1.0});
  }
};

using Flag = SolidBody<Quad2, StVenantKirchhoff>;

/// The flag, clamped to its cylinder, in gravity of 2 m/s^2: rho = 1000, nu = 0.4, shear modulus mu.
inline Flag csm_flag(const CsmOptions& o, double mu) {
  return Flag("flag", turek_hron_flag<Quad2>(o.n_x, o.n_y), StVenantKirchhoff(Lame::from_shear(mu, 0.4)),
              {1000.0, 0.0, 0.0, 0.0, {0.0, -2.0}});
}

namespace detail {

inline void count(Run& run, const SolidProblem<Flag>& flag, long steps) {
  run.totals.dofs = flag.body().n_dofs();
  run.totals.newton += flag.newton_iterations();
  run.totals.steps += steps;
}

/// Checks a figure in mm against its reference.
inline void check_mm(Run& run, const std::string& name, double value, double reference, double tolerance) {
  run.metric(name, value, "mm");
  run.check(name, value, reference, tolerance, "Turek & Hron 2006");
}

inline void csm_static(Run& run, const CsmOptions& o, double mu, const Vec<double, 2>& reference) {
  SolidProblem<Flag> flag(csm_flag(o, mu));
  flag.clamp("left");
  flag.solve_static();
  count(run, flag, 1);
  const Vec<double, 2> u = 1e3 * flag.displacement(flag.node_at({0.6, 0.2}));
  check_mm(run, "tip_ux", u[0], reference[0], 0.01);
  check_mm(run, "tip_uy", u[1], reference[1], 0.01);
  if (run.comm().is_root())
    VtuSeries(Communicator(MPI_COMM_SELF), run.path(""), "solid")
        .write(0.0, deformed_body(flag.body(), flag.u()));
}

/// The flag let go at t = 0; figures from the last period, as the reference takes them.
inline void csm_swing(Run& run, const CsmOptions& o) {
  SolidProblem<Flag> flag(csm_flag(o, 0.5e6));
  flag.clamp("left");
  const GeneralizedAlpha scheme = second_order_scheme(o.rho_inf);
  const int tip = flag.node_at({0.6, 0.2});
  const long n_steps = std::lround(o.end / o.dt);
  CsvFile history = run.csv("history.csv", {{"t", "s"}, {"tip_ux", "mm"}, {"tip_uy", "mm"}});
  Signal ux, uy;
  for (long i = 1; i <= n_steps; ++i) {
    flag.step(o.dt, scheme);
    const Vec<double, 2> u = 1e3 * flag.displacement(tip);
    ux.add(flag.time(), u[0]);
    uy.add(flag.time(), u[1]);
    history.row({flag.time(), u[0], u[1]});
    run.progress(static_cast<double>(i) / n_steps, "t = " + std::to_string(flag.time()));
  }
  count(run, flag, n_steps);
  const double frequency = uy.frequency(0.0), last_period = o.end - 1.0 / frequency;
  const auto middle = [&](const Signal& s) {
    return 0.5 * (s.max(last_period).value + s.min(last_period).value);
  };
  const auto half = [&](const Signal& s) {
    return 0.5 * (s.max(last_period).value - s.min(last_period).value);
  };
  check_mm(run, "tip_ux_mean", middle(ux), -14.305, 0.01);
  check_mm(run, "tip_ux_amplitude", half(ux), 14.305, 0.01);
  check_mm(run, "tip_uy_mean", middle(uy), -63.607, 0.01);
  check_mm(run, "tip_uy_amplitude", half(uy), 65.160, 0.01);
  run.metric("frequency", frequency, "Hz");
  run.check("frequency", frequency, 1.0995, 0.01, "Turek & Hron 2006");
}

}  // namespace detail

/// Runs test 1, 2 or 3. Metrics: tip_ux, tip_uy (CSM1, CSM2), or their mean, amplitude and frequency (CSM3).
inline void run_csm(Run& run, int test, const CsmOptions& o) {
  if (test == 1) return detail::csm_static(run, o, 0.5e6, {-7.187, -66.10});
  if (test == 2) return detail::csm_static(run, o, 2e6, {-0.469, -16.97});
  detail::csm_swing(run, o);
}

}  // namespace ifsi
