#pragma once
/// \file
/// Set-up and figures of the cylinder benchmark (Schaefer & Turek 1996), in two and three dimensions.

#include <cmath>
#include <numbers>
#include <string>

#include "ifsi/io/run.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/flow_boundary.hpp"
#include "ifsi/simulation/probe.hpp"
#include "ifsi/simulation/signal.hpp"

namespace ifsi {

/// Channel, inflow and scales of one of the benchmark's flows; units m, s, kg with rho = 1 kg/m^3.
template <int dim>
struct CylinderFlow {
  using Point = Vec<double, dim>;
  static constexpr double H = 0.41, D = 0.1, nu = 1e-3;
  bool steady;
  double U_max;        ///< largest inflow velocity
  bool pulse = false;  ///< inflow follows sin(pi t / 8)
  double force_scale;  ///< from force to coefficient
  Point front, back;   ///< where the pressure difference is taken

  explicit CylinderFlow(const std::string& problem) : steady(problem == "2D-1" || problem == "3D-1Z") {
    if ((problem == "3D-1Z") != (dim == 3))
      throw Error(ExitCode::configuration,
                  "problem " + problem + " needs an element of dimension " + (dim == 3 ? "2" : "3"));
    U_max = dim == 3 ? 0.45 : problem == "2D-1" ? 0.3 : 1.5;
    pulse = problem == "2D-3";
    const double U_mean = U_max * (dim == 3 ? 4.0 / 9.0 : 2.0 / 3.0);
    force_scale = 2.0 / (U_mean * U_mean * D * (dim == 3 ? H : 1.0));
    if constexpr (dim == 2)
      front = {0.15, 0.2}, back = {0.25, 0.2};
    else
      front = {0.45, 0.2, 0.205}, back = {0.55, 0.2, 0.205};
  }

  [[nodiscard]] FlowBoundary<dim> boundary() const {
    FlowBoundary<dim> b;
    b.velocity("inlet", [U = U_max, pulse = pulse](const Point& x, double t) {
      auto v = Point::zero();
      v[0] = U * 4.0 * x[1] * (H - x[1]) / (H * H) * (pulse ? std::sin(std::numbers::pi * t / 8.0) : 1.0);
      if constexpr (dim == 3) v[0] *= 4.0 * x[2] * (H - x[2]) / (H * H);
      return v;
    });
    b.traction_free("outlet");
    b.no_slip("walls");
    b.no_slip("cylinder");
    return b;
  }
};

/// The body-fitted mesh, in 3D extruded over the channel's width.
template <class Element>
GlobalMesh<Element> cylinder_mesh(double refinement, int n_layers) {
  if constexpr (Element::dim == 2) {
    return channel_with_cylinder<Element>(CylinderChannel{}.refined(refinement));
  } else {
    using Section = std::conditional_t<Element::shape == Shape::wedge, Tri1,
                                       std::conditional_t<Element::order == 2, Quad2, Quad1>>;
    const auto section = channel_with_cylinder<Section>(schaefer_turek_3d_section().refined(refinement));
    const int n = std::max(2, static_cast<int>(std::lround(n_layers * refinement)));
    return extrude<Element>(section, uniform_axis(0.0, 0.41, n), {"walls", "walls"});
  }
}

/// Coefficients over time and the comparison with the benchmark.
struct CylinderFigures {
  Signal cd, cl, dp;

  void add(double t, double t_alpha, double drag, double lift, double pressure_difference) {
    cd.add(t_alpha, drag), cl.add(t_alpha, lift), dp.add(t, pressure_difference);
  }

  void report_steady(Run& run, const std::string& problem) const {
    const bool plane = problem == "2D-1";
    const std::string source = plane ? "Nabh 1998, spectral" : "Braack & Richter 2006";
    run.metric("cd", cd.last()), run.metric("cl", cl.last()), run.metric("dp", dp.last(), "Pa");
    run.check("cd", cd.last(), plane ? 5.57953523384 : 6.18533, plane ? 1e-3 : 1e-2, source);
    if (!plane) return;
    run.check("cl", cl.last(), 0.010618948146, 1e-2, source);
    run.check("dp", dp.last(), 0.11752016697, 1e-3, source);
  }

  void report_transient(Run& run, const std::string& problem, double settle) const {
    const auto cd_max = cd.max(settle), cl_max = cl.max(settle), cl_min = cl.min(settle);
    run.metric("cd_max", cd_max.value), run.metric("cl_max", cl_max.value);
    run.metric("cl_amplitude", cl_max.value - cl_min.value), run.metric("dp_end", dp.last(), "Pa");
    if (problem == "2D-2") {
      const double strouhal = 0.1 * cl.frequency(settle);
      run.metric("strouhal", strouhal);
      run.check_between("cd_max", cd_max.value, 3.22, 3.24, "Schaefer & Turek 1996, interval");
      run.check_between("cl_max", cl_max.value, 0.98, 1.02, "Schaefer & Turek 1996, interval");
      run.check_between("strouhal", strouhal, 0.295, 0.305, "Schaefer & Turek 1996, interval");
    } else {
      run.metric("t_cd_max", cd_max.t, "s"), run.metric("t_cl_max", cl_max.t, "s");
      run.check("cd_max", cd_max.value, 2.950921575, 1e-2, "John 2004");
      run.check("cl_max", cl_max.value, 0.47795, 1e-2, "John 2004");
      run.check("dp_end", dp.last(), -0.1116, 1e-2, "John 2004");
    }
  }
};

}  // namespace ifsi
