#pragma once
/// \file
/// Meshes, bodies and time loop of the sphere case.

#include <array>
#include <cmath>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "ifsi/assembly/rigid_shape.hpp"
#include "ifsi/mesh/ball.hpp"
#include "ifsi/mesh/icosphere.hpp"
#include "ifsi/mesh/octasphere.hpp"
#include "ifsi/simulation/sphere_case.hpp"

namespace ifsi {

/// An axis with cells of size h between `first` and `last`, growing beyond towards `lower` and `upper`.
inline Axis refined_axis(double lower, double first, double last, double upper, double h, double growth) {
  const auto outwards = [&](double from, double to) {
    const double length = to - from, g = std::max(growth, 1.0001);
    const double n = std::ceil(std::log(1.0 + (g - 1.0) * length / h) / std::log(g));
    return axis_from_first_cell(from, to, std::max(2, static_cast<int>(n)), h);
  };
  const int n = static_cast<int>(std::lround((last - first) / h));
  const Axis axis = join(uniform_axis(first, first + n * h, n), outwards(first + n * h, upper));
  return first > lower ? join(reflect(outwards(-first, -lower)), axis) : axis;
}

/// Equal cells around the way of the sphere, larger ones beyond.
inline Axis sphere_heights(const SphereOptions& o) {
  const double reach = 1.4 * o.a, way = o.steady ? 0.0 : 0.25 * o.a;
  const double below = o.z_0 + (o.phase - std::ceil((reach + way) / o.h())) * o.h();
  return refined_axis(0.0, below, o.z_0 + reach, o.tank_height, o.h(), o.growth_per_cell());
}

/// The tank: boundaries surface, bottom, top, and the symmetry planes cut_x, cut_y (cut_x is the axis).
template <class Element>
GlobalMesh<Element> tank_mesh(const SphereOptions& o) {
  const double h = o.h(), reach = std::lround(1.4 * o.n) * h;  // whole cells of just this size
  if constexpr (Element::dim == 2) {
    auto mesh = box<Element>(
        {refined_axis(0.0, 0.0, reach, o.tank_radius, h, o.growth_per_cell()), sphere_heights(o)});
    mesh.boundary_names = {"cut_x", "surface", "bottom", "top"};
    return mesh;
  } else {
    // The rounded square reaches 0.854 of its corner radius along the axes.
    const double corner = reach / 0.854;
    const Axis out = refined_axis(0.0, 0.0, reach, o.tank_radius, h, o.growth_per_cell());
    const int n_core = 2 * static_cast<int>(std::lround(reach / h));
    const int n_shell = static_cast<int>(out.size()) - 1 - n_core / 2;
    const double ratio = (out[out.size() - 1] - out[out.size() - 2]) / h;
    const bool cut = o.is_cut();
    return extrude<Element>(ball<Quad1>({o.tank_radius, corner, n_core, n_shell, ratio}, {cut, cut}),
                            sphere_heights(o), {"bottom", "top"});
  }
}

template <int dim>
FlowBoundary<dim> tank_boundary(const SphereOptions& o) {
  FlowBoundary<dim> boundary;
  boundary.no_slip("surface"), boundary.no_slip("bottom"), boundary.traction_free("top");
  if (o.is_cut()) boundary.slip("cut_x");
  if (o.is_cut() && dim == 3) boundary.slip("cut_y");
  return boundary;
}

/// Layers of a solid this thick, none of them thinner than two fluid cells: points close below the surface
/// bind the cut cells' fluid as those on it do, and lock them.
inline int layers(const SphereOptions& o, double thickness) {
  constexpr double cells = 2.2;
  return std::max(1, static_cast<int>(thickness / (cells * o.h())));
}

/// The sphere's mesh: quads in (r, z); in space tetrahedra, an octasphere, which the planes of symmetry cut
/// along edges.
template <int dim>
auto sphere_mesh(const SphereOptions& o) {
  const double radius = o.a - o.radius_correction * o.h(), spacing = o.solid_spacing() * o.h();
  Vec<double, dim> centre{};
  centre[0] = o.offset, centre[dim - 1] = o.z_0;
  if constexpr (dim == 2) {
    const double core_radius = 0.65 * radius;
    const int n_core =
        2 * std::max(1, static_cast<int>(std::lround(std::numbers::pi * o.a / (4.0 * spacing))));
    return moved(ball<Quad1>({radius, core_radius, n_core, layers(o, radius - core_radius)}, {true, false}),
                 centre);
  } else {
    return moved(octasphere({radius, octasphere_frequency(o.a, spacing), layers(o, radius)},
                            {o.is_cut(), o.is_cut(), false}),
                 centre);
  }
}

template <int dim>
double distance_to_sphere(const SphereOptions& o, const Vec<double, dim>& centre, const Vec<double, dim>& x) {
  return std::sqrt(dot(x - centre, x - centre)) - o.a;
}

/// Points of the surface of a rigid sphere: the nodes of its mesh in (r, z), in space those of an icosphere,
/// in the model quarter3d the ones on this side of the planes.
template <class Element>
std::vector<Vec<double, Element::dim>> surface_points(const SphereOptions& o,
                                                      const GlobalMesh<Element>& sphere,
                                                      const Vec<double, Element::dim>& centre) {
  if constexpr (Element::dim == 2) {
    return boundary_points(sphere, 0);
  } else {
    std::vector<Vec<double, 3>> points;
    for (const auto& x : icosphere_points(o.a, icosphere_frequency(o.a, o.solid_spacing() * o.h())))
      if (!o.is_cut() || std::min(x[0], x[1]) > -1e-9 * o.a) points.push_back(centre + x);
    return points;
  }
}

/// Follows the velocity of the sphere and compares it with a curve.
template <class Problem>
class Fall {
 public:
  /// \param curve CSV file of the velocity of a rigid sphere
  Fall(Run& run, Problem& problem, const SphereOptions& o, std::string curve)
      : run_(run), problem_(problem), o_(o), curve_(std::move(curve)) {}

  /// Marches to the end. \param v_z velocity of the sphere upwards, \param volume_change relative
  template <class Velocity, class Volume>
  FallResult march_to_end(const Velocity& v_z, const Volume& volume_change) {
    const std::clock_t start = std::clock();
    CsvFile csv =
        run_.csv("history.csv", {{"t", "s"}, {"v_z", "cm/s"}, {"volume_change", "-"}}, problem_.time());
    Signal signal;
    march(run_, problem_, o_.time, [&](double) {
      signal.add(problem_.time(), v_z());
      result_.volume_change = std::max(result_.volume_change, std::abs(volume_change()));
      result_.violation = std::max(result_.violation, problem_.constraint_violation());
      csv.row({problem_.time(), v_z(), volume_change()});
    });
    if (o_.time.end > 0.01)
      result_.rms = rms_difference(signal, curve_, "v_z_cm_s", 0.01, o_.time.end) / o_.v_rigid;
    return finish(-signal.last(), start);
  }
  FallResult steady(const std::function<double()>& v_z) {
    const std::clock_t start = std::clock();
    const NewtonReport report = problem_.solve_steady();
    if (!report.converged) throw Error(ExitCode::nonlinear, "no steady fall found: " + report.failure);
    run_.totals.newton += report.iterations, run_.totals.gmres += report.gmres, ++run_.totals.steps;
    result_.violation = problem_.constraint_violation();
    return finish(-v_z(), start);
  }

 private:
  FallResult finish(double v, std::clock_t start) {
    result_.v = v;
    result_.cpu = run_.comm().sum(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    result_.dofs = run_.totals.dofs;
    write_fields(run_, problem_);
    return result_;
  }

  Run& run_;
  Problem& problem_;
  const SphereOptions& o_;
  std::string curve_;
  FallResult result_;
};

/// A rigid sphere; its weight and inertia are those of the true sphere (of a quarter in the model quarter3d).
template <class Element, class Model>
FallResult fall_rigid(Run& run, const SphereOptions& o, const std::string& curve) {
  constexpr int dim = Element::dim;
  using Coordinates = typename Model::Coordinates;
  using Problem = RigidFsiProblem<Element, Model>;
  using Motion = typename Problem::Motion;
  const auto mesh = distribute(tank_mesh<Element>(o), run.comm());
  const auto sphere = sphere_mesh<dim>(o);
  auto shape = rigid_shape<Coordinates>(sphere);
  shape.volume = o.volume / (o.model == "quarter3d" ? 4.0 : 1.0);
  shape.centre = Vec<double, dim>::zero();
  shape.centre[0] = o.offset, shape.centre[dim - 1] = o.z_0;
  Vec<double, dim> weight{};
  weight[dim - 1] = -(o.rho_s - o.rho_f) * shape.volume * o.g;
  constexpr int along_z = Motion::axial ? 0 : dim - 1;
  std::array<bool, Motion::n> free{};
  free[along_z] = true;
  if (!o.is_cut()) free.fill(true);
  typename Problem::Immersed body{{shape, o.rho_s - o.rigid.interior * o.rho_f, weight, free},
                                  surface_points(o, sphere, shape.centre),
                                  [&](const auto& x) { return distance_to_sphere(o, shape.centre, x); }};
  Problem problem(mesh, tank_boundary<dim>(o), o.rho_f, Newtonian{o.mu}, {body}, o.flow, o.rigid);
  attach(run, problem);
  Fall<Problem> fall(run, problem, o, curve);
  const auto v_z = [&] { return problem.body(0).velocity()[along_z]; };
  if (o.steady) return fall.steady(v_z);
  if (!run.restarted() && !problem.start_step(1e-4 * o.time.dt).converged)
    throw Error(ExitCode::nonlinear, "no acceleration found for the start of the fall");
  return fall.march_to_end(v_z, [] { return 0.0; });
}

/// An elastic sphere with the weight of the true one, whatever the volume of its mesh. The fluid fractions
/// are those of a ball that moves with the mean of the nodes: this sphere deforms by less than one per cent.
template <class Element, class Model, class Body>
FallResult fall_elastic(Run& run, const SphereOptions& o, const std::string& curve) {
  constexpr int dim = Element::dim;
  using Problem = FsiProblem<Element, Body, Model>;
  const auto mesh = distribute(tank_mesh<Element>(o), run.comm());
  auto sphere = sphere_mesh<dim>(o);
  const double volume = rigid_shape<typename Model::Coordinates>(sphere).volume;
  const double true_volume = o.volume / (o.model == "quarter3d" ? 4.0 : 1.0);
  SolidParameters<dim> solid{
      .rho_s = o.rho_s, .rho_f = o.interior * o.rho_f, .mu_f = o.interior * o.mu, .mu_s = 0.0, .gravity = {}};
  solid.gravity[dim - 1] = -o.g * (o.rho_s - o.rho_f) / (o.rho_s - solid.rho_f) * true_volume / volume;
  std::vector<Body> bodies;
  bodies.emplace_back("sphere", std::move(sphere), UncoupledNeoHookean(o.C0, o.kappa), solid);
  Problem problem(mesh, tank_boundary<dim>(o), o.rho_f, Newtonian{o.mu}, std::move(bodies), o.flow, o.fsi);
  if (o.interior < 1.0)
    problem.set_fraction([&, X = problem.solids().positions()](const auto& x) {
      Vec<double, dim> centre{};
      centre[0] = o.offset, centre[dim - 1] = o.z_0;
      for (std::size_t k = 0; k < X.size(); ++k)
        centre += (1.0 / static_cast<double>(X.size())) * (x[k] - X[k]);
      return fluid_weights<typename Model::Coordinates>(
          mesh, [&](const auto& y) { return distance_to_sphere(o, centre, y); }, o.interior);
    });
  attach(run, problem);
  return Fall<Problem>(run, problem, o, curve)
      .march_to_end([&] { return problem.solids().totals().momentum[dim - 1] / (o.rho_s * volume); },
                    [&] { return problem.solids().totals().volume / volume - 1.0; });
}

}  // namespace ifsi
