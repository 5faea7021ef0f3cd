#pragma once
/// \file
/// The semilunar valve as its driver sees it.

#include <cmath>
#include <string>

#include "ifsi/io/run.hpp"
#include "ifsi/mesh/leaflet.hpp"
#include "ifsi/simulation/fsi_problem.hpp"
#include "ifsi/simulation/law_choice.hpp"
#include "ifsi/simulation/time_loop.hpp"

namespace ifsi {

/// An aortic valve over one beat, cgs units: a straight vessel with a root of three sinuses, three leaflets.
struct ValveOptions {
  static constexpr double z_inlet = -4.0;

  std::string model = "sector", element = "tet1", drive = "pressure", curve;
  LawChoice law{"membrane", 0.01, 1.0};
  AorticRoot root;
  Leaflet leaflet;
  double downstream = 11.8, angle = 60.0, h = 0.35, h_valve = 0.12, growth = 0.2, wall_ratio = 0.7;
  double spacing = 0.5, protrusion_max = 0.08;
  int layers = 1;
  double rho_f = 1.1, mu = 0.036, rho_s = 1.0, E = 3e5, nu = 0.4, backflow = 1.0;
  double fibres = 3e7, fibres_across = 3e6, fibres_stiffening = 0.0, bending = 100.0;
  double z_before = -1.0, z_behind = 5.0, picture_every = 0.02;
  TimeOptions time;
  FlowOptions flow;
  FsiOptions fsi;

  ValveOptions() {
    time.dt = 1e-3, time.end = 1.0, time.adaptive = true, time.dt_max = 2e-3, time.checkpoint_every = 0.1;
    flow.rho_inf = 0.0, flow.newton.rtol = 1e-4;
    fsi.s.s_max = 1e3, fsi.k_p_rings = 1, fsi.patch_layers = 1, fsi.seal = 1e4, fsi.seal_range = 4.0;
  }

  void declare(Parameters& params) {
    params.add_choice("model", model, {"sector", "full"}, "half a leaflet between two planes, or all");
    params.add("sector.angle", angle, "degrees", "between the planes of the sector", positive);
    params.add("root.radius", root.radius, "cm", "of the straight vessel", positive);
    params.add("root.height", root.height, "cm", "from the nadirs to the end of the sinuses", positive);
    params.add("root.commissure", root.commissure, "cm", "height of the commissures", positive);
    params.add("root.lobe", root.lobe, "-", "depth of a sinus over the radius", {0.0, 1.0});
    params.add("root.downstream", downstream, "cm", "vessel behind the root", positive);
    params.add_choice("mesh.element", element, {"tet1", "tet2"}, "element of the fluid");
    params.add("mesh.h", h, "cm", "fluid cells far from the valve", positive);
    params.add("mesh.h_valve", h_valve, "cm", "fluid cells around the valve", positive);
    params.add("mesh.growth", growth, "-", "of the cells per length away from the valve", positive);
    params.add("mesh.wall_ratio", wall_ratio, "-", "cells at the wall over those at the axis", {0.1, 1.0});
    params.add("solid.height", leaflet.height, "cm", "of the commissures' top over the nadir", positive);
    params.add("solid.dip", leaflet.dip, "cm", "of the free edge in the middle below it", non_negative);
    params.add("solid.thickness", leaflet.thickness, "cm", "of the leaflets", positive);
    params.add("solid.gap", leaflet.gap, "cm", "of the free edge to the plane of the commissures", positive);
    params.add("solid.rounding", leaflet.rounding, "cm", "of the free edge in the middle", positive);
    params.add("solid.coaptation", leaflet.coaptation, "cm",
               "height over which a leaflet's middle turns up to the free edge", positive);
    params.add("solid.protrusion", leaflet.protrusion, "cm", "of the attached edges into the wall",
               non_negative);
    params.add("solid.protrusion_max", protrusion_max, "cm", "no node may lie further outside of the vessel",
               non_negative);
    params.add("solid.spacing", spacing, "-", "of the leaflets' nodes over the fluid's at the valve",
               {0.05, 2.0});
    params.add("solid.layers", layers, "-", "cells through the thickness", {1, 4});
    params.add("solid.rho", rho_s, "g/cm^3", "density of the leaflets", positive);
    params.add("solid.E", E, "dyn/cm^2", "Young's modulus", positive);
    params.add("solid.nu", nu, "-", "Poisson's ratio", {-0.99, 0.4999});
    params.add("solid.fibres", fibres, "dyn/cm^2", "modulus of fibres between the commissures (eq. 43)",
               non_negative);
    params.add("solid.fibres_across", fibres_across, "dyn/cm^2",
               "modulus of fibres at right angles to them, membranes and sheets", non_negative);
    params.add("solid.fibres_stiffening", fibres_stiffening, "-",
               "their stress grows by exp(this strain^2) (eq. 43)", non_negative);
    params.add("solid.bending", bending, "dyn cm", "bending stiffness of membranes (eq. 46)", non_negative);
    params.add_choice("solid.law", law.law, {"membrane", "sheet", "volume"},
                      "leaflets of one layer of nodes, or of a thickness, in plane stress or not");
    law.declare_sheet(params);
    params.add("fluid.rho", rho_f, "g/cm^3", "density of the blood", positive);
    params.add("fluid.mu", mu, "P", "viscosity of the blood", positive);
    params.add_choice("inlet.drive", drive, {"flow", "pressure"}, "what is prescribed at the inlet");
    params.add("inlet.curve", curve, "", "CSV file of it over time (default: data/curves)");
    params.add("outlet.backflow", backflow, "-", "backflow stabilisation (eq. 11)", {0.0, 1.0});
    params.add("metrics.z_before", z_before, "cm", "section of the pressure before the valve");
    params.add("metrics.z_behind", z_behind, "cm", "section of the pressure behind the valve");
    params.add("output.every", picture_every, "s", "time between pictures", positive);
    time.declare(params), flow.declare(params), fsi.declare(params);
  }

  [[nodiscard]] bool is_sector() const { return model == "sector"; }
  /// How many of what is computed make a whole valve.
  [[nodiscard]] double copies() const { return is_sector() ? 6.0 : 1.0; }
  [[nodiscard]] double z_outlet() const { return root.height + downstream; }

  [[nodiscard]] std::string curve_file(const std::string& data) const {
    return curve.empty() ? data + "/curves/aortic_" + drive + ".csv" : curve;
  }

  /// \throws Error (configuration) for a sector that is not cut along planes of symmetry.
  void check() const {
    if (is_sector() && std::abs(angle - 60.0) > 1e-9)
      throw Error(ExitCode::configuration,
                  "sector.angle = " + std::to_string(angle) +
                      ": the cut at this angle is no plane of symmetry; expected 60, from the middle of a "
                      "leaflet to its commissure, or model = full");
  }
};

/// Computes the valve of the options. \param data folder with geometry/vessel.geo and curves/
void run_semilunar_valve(Run& run, const ValveOptions& options, const std::string& data);

}  // namespace ifsi
