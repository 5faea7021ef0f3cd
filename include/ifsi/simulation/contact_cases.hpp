#pragma once
/// \file
/// Scenes in which solids touch: leaflets of a valve that a reversed pressure closes, discs that collide.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/fsi_problem.hpp"
#include "ifsi/simulation/time_loop.hpp"

namespace ifsi {

struct ContactOptions {
  std::string scene = "valve";
  int n = 32, n_s = 32;  ///< fluid cells per cm, solid cells along a leaflet or along a quarter of a disc
  double rho = 1.0, mu = 0.1, density_ratio = 1.0, E = 4e5, nu = 0.4;
  double load = 100.0, ramp = 0.05, longer = 0.0, slant = 1.6, offset = 0.03, picture_every = 0.02;
  bool symmetry = false;
  TimeOptions time;
  FlowOptions flow;
  FsiOptions fsi;

  void declare(Parameters& params) {
    params.add_choice("scene", scene, {"valve", "discs"}, "what touches");
    params.add("symmetry", symmetry, "-",
               "valve: half of the channel with a symmetry line, no leaflet longer");
    params.add("mesh.n", n, "-", "fluid cells per cm", {8, 1024});
    params.add("solid.n", n_s, "-", "solid cells along a leaflet, or along a quarter of a disc", {2, 1024});
    params.add("solid.E", E, "dyn/cm^2", "Young's modulus", positive);
    params.add("solid.nu", nu, "-", "Poisson's ratio", {-0.99, 0.4999});
    params.add("solid.density_ratio", density_ratio, "-", "density of the solids over the fluid's", positive);
    params.add("solid.slant", slant, "-", "leaflets: distance downstream per height", non_negative);
    params.add("solid.longer", longer, "cm", "by how much the lower leaflet is higher", {0.0, 0.5});
    params.add("solid.offset", offset, "cm", "by how much the upper disc is to the side", {0.0, 0.3});
    params.add("fluid.rho", rho, "g/cm^3", "density of the fluid", positive);
    params.add("fluid.mu", mu, "g/(cm s)", "dynamic viscosity", positive);
    params.add("load.pressure", load, "dyn/cm^2",
               "pressure on the valve, or of the weight of a disc over its width; also default of "
               "contact.pressure",
               positive);
    params.add("load.ramp", ramp, "s", "valve: length of the ramp", positive);
    params.add("output.every", picture_every, "s", "time between pictures", positive);
    time.declare(params), flow.declare(params), fsi.declare(params);
  }
};

/// Fluid, boundary conditions and bodies of a scene.
struct ContactScene {
  using Body = SolidBody<Quad1, NeoHookean>;
  GlobalMesh<Quad1> fluid;
  FlowBoundary<2> boundary;
  std::vector<Body> bodies;
  std::vector<ContactPlane<2>> planes;

  void add(const std::string& name, GlobalMesh<Quad1> mesh, const ContactOptions& o, double gravity = 0.0) {
    bodies.emplace_back(name, std::move(mesh), NeoHookean(Lame::from_young(o.E, o.nu)),
                        Body::Parameters{.rho_s = o.density_ratio * o.rho,
                                         .rho_f = o.rho,
                                         .mu_f = o.mu,
                                         .mu_s = 0.0,
                                         .gravity = {0.0, gravity}});
  }
};

/// A channel of 3 x 1 cm with two straight leaflets, clamped 1 cm from its left end, 0.42 high and slanted.
[[nodiscard]] inline ContactScene closing_valve(const ContactOptions& o) {
  ContactScene scene;
  const auto leaflet = [&](double y, double height) {
    auto mesh = box<Quad1>({1.0, std::min(y, y + height)}, {1.03, std::max(y, y + height)}, {2, o.n_s});
    for (auto& p : mesh.points) p[0] += o.slant * std::abs(p[1] - y);
    return mesh;
  };
  scene.fluid = box<Quad1>({0.0, o.symmetry ? 0.5 : 0.0}, {3.0, 1.0}, {3 * o.n, o.symmetry ? o.n / 2 : o.n});
  FlowBoundary<2>& boundary = scene.boundary;
  boundary.pressure("right",
                    [load = o.load, ramp = o.ramp](double t) { return load * std::min(1.0, t / ramp); });
  boundary.traction_free("left"), boundary.backflow("left", 0.5), boundary.backflow("right", 0.5);
  boundary.no_slip("top");
  scene.add("top leaflet", leaflet(1.0, -0.42), o);
  if (o.symmetry) {
    boundary.slip("bottom");
    scene.planes.push_back({{0.0, 0.5}, {0.0, 1.0}, true});
  } else {
    boundary.no_slip("bottom");
    scene.add("bottom leaflet", leaflet(0.0, 0.42 + o.longer), o);
  }
  return scene;
}

/// A closed box of 1 x 1 cm with two discs of radius 0.15 cm that opposite weights drive together.
[[nodiscard]] inline ContactScene colliding_discs(const ContactOptions& o) {
  ContactScene scene;
  constexpr double radius = 0.15;
  scene.fluid = box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {o.n, o.n});
  for (const std::string& side : scene.fluid.boundary_names) scene.boundary.no_slip(side);
  if (o.density_ratio == 1.0)
    throw Error(ExitCode::configuration,
                "solid.density_ratio = 1: the discs weigh nothing; expected another");
  const double weight = 2.0 * o.load / (std::numbers::pi * radius * (o.density_ratio - 1.0) * o.rho);
  for (const bool upper : {true, false}) {
    auto section = disc<Quad1>({radius, 0.07, o.n_s, std::max(1, o.n_s / 2), 1.0});
    for (auto& x : section.points) x += Vec<double, 2>{upper ? 0.5 + o.offset : 0.5, upper ? 0.72 : 0.28};
    scene.add(upper ? "upper disc" : "lower disc", std::move(section), o, upper ? -weight : weight);
  }
  return scene;
}

}  // namespace ifsi
