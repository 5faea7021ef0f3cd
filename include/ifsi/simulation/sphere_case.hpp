#pragma once
/// \file
/// The falling sphere as its driver sees it: parameters, and what a fall gives.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ifsi/simulation/fsi_case.hpp"
#include "ifsi/simulation/rigid_fsi_problem.hpp"

namespace ifsi {

/// The falling sphere, cgs units: a tank of radius 2 and height 4 cm, a sphere of radius a at height z_0.
struct SphereOptions {
  static constexpr double a = 0.25, tank_radius = 2.0, tank_height = 4.0, g = 981.0;
  static constexpr double volume = 4.0 / 3.0 * std::numbers::pi * a * a * a;
  static constexpr double v_rigid = 0.509767;  ///< of the reference calculation, cm/s

  std::string model = "axisymmetric", body = "rigid", sweep = "none";
  double n = 10.0, phase = 0.0, growth = 1.05, spacing = 0.0, radius_correction = 0.0, offset = 0.0,
         z_0 = 2.5, interior = 1e-2;
  double rho_f = 1.0, rho_s = 1.5, mu = 10.0, C0 = 33550.0, kappa = 3355.0;
  bool steady = false;
  TimeOptions time;
  FlowOptions flow;
  FsiOptions fsi;
  RigidFsiOptions rigid;

  SphereOptions() { time.dt = 2e-3, time.end = 0.1, flow.rho_inf = 0.0; }

  void declare(Parameters& params) {
    params.add_choice("model", model, {"axisymmetric", "quarter3d", "elastic3d", "rigid3d"},
                      "what is computed");
    params.add_choice("body", body, {"rigid", "elastic"}, "of the models axisymmetric and quarter3d");
    params.add_choice("sweep", sweep, {"none", "h", "phase"},
                      "three meshes up to mesh.n, or four shifts of it");
    params.add("steady", steady, "-", "terminal velocity at the initial place without time steps (rigid)");
    params.add("mesh.n", n, "-", "fluid cells along the radius of the sphere", {2.0, 400.0});
    params.add("mesh.phase", phase, "-", "shift of the fluid mesh along z, in cells", {-1.0, 1.0});
    params.add("mesh.growth", growth, "-", "growth of the cells away from the sphere at mesh.n = 10",
               {1.0, 2.0});
    params.add("solid.spacing", spacing, "-",
               "of the points of the sphere's surface, in fluid cells (0: 1 in (r, z), 1.2 in space)",
               {0.0, 10.0});
    params.add("solid.radius_correction", radius_correction, "-",
               "elastic: mesh the sphere smaller by this many fluid cells, its weight kept", {0.0, 1.0});
    params.add("solid.interior", interior, "-", "elastic: part of the fluid's equations kept inside (1: all)",
               {1e-12, 1.0});
    params.add("solid.offset", offset, "cm", "of the sphere from the axis of the tank (elastic3d, rigid3d)",
               {0.0, 0.05});
    params.add("solid.height", z_0, "cm", "of the sphere above the bottom at the start", {0.75, 3.25});
    params.add("solid.rho", rho_s, "g/cm^3", "density of the sphere", positive);
    params.add("solid.C0", C0, "dyn/cm^2", "shear modulus of the elastic sphere", positive);
    params.add("solid.kappa", kappa, "dyn/cm^2", "bulk modulus of the elastic sphere", positive);
    params.add("fluid.rho", rho_f, "g/cm^3", "density of the fluid", positive);
    params.add("fluid.mu", mu, "P", "viscosity of the fluid", positive);
    time.declare(params), flow.declare(params), fsi.declare(params), rigid.declare(params);
  }

  [[nodiscard]] bool is_rigid() const {
    return model == "rigid3d" || (model != "elastic3d" && body == "rigid");
  }
  [[nodiscard]] bool is_cut() const { return model == "axisymmetric" || model == "quarter3d"; }
  [[nodiscard]] double h() const { return a / n; }
  /// Growth per cell, so that meshes of all sizes are refinements of one.
  [[nodiscard]] double growth_per_cell() const { return std::pow(growth, 10.0 / n); }
  /// Distance of the points of the sphere's surface in fluid cells.
  [[nodiscard]] double solid_spacing() const {
    if (spacing > 0.0) return spacing;
    return model == "axisymmetric" ? 1.0 : 1.2;
  }

  /// \throws Error (configuration) for choices that contradict each other.
  void check() const {
    if (is_cut() && offset != 0.0)
      throw Error(ExitCode::configuration,
                  "model = " + model +
                      " cuts through the axis, which is no plane of "
                      "symmetry with solid.offset = " +
                      std::to_string(offset) +
                      "; expected solid.offset = 0, or model = elastic3d or rigid3d");
    if (steady && !is_rigid())
      throw Error(ExitCode::configuration, "steady = true with an elastic sphere; expected a rigid one");
    if (is_rigid() && radius_correction != 0.0)
      throw Error(ExitCode::configuration,
                  "solid.radius_correction = " + std::to_string(radius_correction) +
                      " with a rigid sphere; expected 0: its fluid fractions need no correction");
  }

  /// The runs of a sweep: this one on other meshes.
  [[nodiscard]] std::vector<SphereOptions> runs() const {
    std::vector<SphereOptions> all(sweep == "none" ? 1 : sweep == "h" ? 3 : 4, *this);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (sweep == "h") all[k].n = n * std::pow(0.5, 1.0 - 0.5 * static_cast<double>(k));
      if (sweep == "phase") all[k].phase = 0.25 * static_cast<double>(k);
    }
    return all;
  }
};

/// What one fall gives.
struct FallResult {
  double v = 0.0;  ///< downwards, at the end
  double rms = 0.0, volume_change = 0.0, violation = 0.0, cpu = 0.0;
  long dofs = 0;
  [[nodiscard]] double error() const { return v / SphereOptions::v_rigid - 1.0; }
};

/// The fall in (r, z), and in space. \param curve CSV file of the velocity of a rigid sphere
FallResult fall_axisymmetric(Run& run, const SphereOptions& o, const std::string& curve);
FallResult fall_in_space(Run& run, const SphereOptions& o, const std::string& curve);

/// The fall of the model that the options name.
inline FallResult fall(Run& run, const SphereOptions& o, const std::string& curve) {
  return o.model == "axisymmetric" ? fall_axisymmetric(run, o, curve) : fall_in_space(run, o, curve);
}

}  // namespace ifsi
