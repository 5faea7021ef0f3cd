#pragma once
/// \file
/// Meshes, bodies and time loop of the semilunar valve.

#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ifsi/assembly/membrane_body.hpp"
#include "ifsi/assembly/section.hpp"
#include "ifsi/io/run_gmsh.hpp"
#include "ifsi/mesh/elevate.hpp"
#include "ifsi/mesh/gmsh.hpp"
#include "ifsi/simulation/flow_curve.hpp"
#include "ifsi/simulation/fsi_case.hpp"
#include "ifsi/simulation/semilunar_valve.hpp"
#include "ifsi/simulation/valve_figures.hpp"

namespace ifsi {

/// The straight vessel in cells of order 1 as they are, in cells of order 2 with their nodes on the wall.
template <class Element>
GlobalMesh<Element> in_cells_of(const GlobalMesh<Tet1>& vessel, double radius) {
  if constexpr (Element::order == 1)
    return vessel;
  else
    return elevate<Element>(vessel, [&](int boundary, const Vec<double, 3>& x) {
      const double stretch = radius / std::hypot(x[0], x[1]);
      return vessel.boundary_names[boundary] == "wall" ? Vec<double, 3>{stretch * x[0], stretch * x[1], x[2]}
                                                       : x;
    });
}

/// The vessel of the root: a straight one, or a wedge of it, from Gmsh, its points mapped.
template <class Element>
GlobalMesh<Element> vessel_mesh(const Run& run, const ValveOptions& o, const std::string& script) {
  const std::string file = run_gmsh(run.comm(), script,
                                    {{"radius", o.root.radius},
                                     {"z_inlet", o.z_inlet},
                                     {"z_outlet", o.z_outlet()},
                                     {"angle", o.is_sector() ? o.angle : 360.0},
                                     {"h", o.h},
                                     {"h_band", o.h_valve},
                                     {"z_first", -0.5},
                                     {"z_last", o.root.height + 0.1},
                                     {"growth", o.growth},
                                     {"wall_ratio", o.wall_ratio}},
                                    run.path(""));
  auto mesh = in_cells_of<Element>(read_gmsh<Tet1>(file), o.root.radius);
  for (auto& x : mesh.points) x = o.root.map(x);
  check(mesh);
  return mesh;
}

/// Area of the inlet that the plug flow sees: the rim, where no-slip wins, counts in part.
template <class Element>
double plug_area(const Mesh<Element>& mesh) {
  constexpr int B = Element::dim + 1;
  std::vector<double> u(static_cast<std::size_t>(mesh.n_nodes()) * B, 0.0);
  for (int node : mesh.nodes_on("inlet")) u[static_cast<std::size_t>(node) * B + 2] = 1.0;
  for (int node : mesh.nodes_on("wall")) u[static_cast<std::size_t>(node) * B + 2] = 0.0;
  return -boundary_flux<Cartesian>(mesh, mesh.boundary("inlet"), u);
}

/// \param curve flow or pressure at the inlet; \param area that the plug flow sees
inline FlowBoundary<3> valve_boundary(const ValveOptions& o, const FlowCurve& curve, double area) {
  FlowBoundary<3> boundary;
  if (o.drive == "flow")
    boundary.velocity("inlet", [=](const auto&, double t) {
      return Vec<double, 3>{0.0, 0.0, curve(t) / area};
    });
  else
    boundary.pressure("inlet", curve), boundary.backflow("inlet", o.backflow);
  boundary.traction_free("outlet"), boundary.backflow("outlet", o.backflow);
  if (o.is_sector()) boundary.slip("cut_0"), boundary.slip("cut_1");
  boundary.no_slip("wall");
  return boundary;
}

/// The plane of symmetry between two leaflets; the sector lies on the side of its normal.
inline ContactPlane<3> commissure_plane() {
  const double angle = 0.5 * AorticRoot::third;
  return {{0.0, 0.0, 0.0}, {std::sin(angle), -std::cos(angle), 0.0}, true};
}

/// A valve in motion: what is recorded in every step.
template <class FluidElement, class Problem>
class ValveHistory {
 public:
  ValveHistory(Run& run, const Problem& problem, const ValveOptions& o,
               std::vector<std::vector<std::vector<int>>> lines)
      : run_(run),
        problem_(problem),
        o_(o),
        lines_(std::move(lines)),
        before_(problem.mesh(), 2, o.z_before),
        behind_(problem.mesh(), 2, o.z_behind),
        annulus_(problem.mesh(), 2, -0.05),
        balances_(problem),
        pictures_(run, o.picture_every, {"wall"}) {
    std::vector<Column> columns = ValveCurves::columns();
    for (const Column& c : {Column{"dt", "s"},
                            {"elastic_energy", "erg"},
                            {"lost_nodes", "-"},
                            {"seal_power", "erg/s"},
                            {"tie_power", "erg/s"}})
      columns.push_back(c);
    for (const Column& c : Balances<Problem>::columns()) columns.push_back(c);
    if (run.restarted()) {
      pictures_.resume(problem.time());
      curves_.read(run.path("history.csv"), problem.time());
    } else {
      pictures_.write(problem, true);
    }
    csv_ = run.csv("history.csv", columns, problem.time());
  }

  void observe(double dt) {
    const auto u = problem_.solution();
    const double copies = o_.copies();
    const auto totals = problem_.solids().totals();
    const ValveCurves::Sample s{problem_.time(),
                                copies * annulus_.integral(u, Problem::B, 2),
                                orifice(),
                                largest_speed(problem_),
                                before_.mean(u, Problem::B, 3) - behind_.mean(u, Problem::B, 3),
                                volume_quantile(problem_.solids().principal_samples().stress, 0.99),
                                totals.deformation.min_det_F,
                                totals.volume / totals.reference_volume - 1.0};
    curves_.add(s);
    std::vector<double> row = ValveCurves::row(s);
    row.insert(row.end(), {dt, copies * totals.elastic_energy,
                           static_cast<double>(problem_.interpolation().lost().size()),
                           copies * problem_.solids().seal_power(), copies * problem_.solids().tie_power()});
    for (double x : balances_.observe(dt)) row.push_back(x);
    csv_.row(row);
    pictures_.write(problem_, s.t >= o_.time.end * (1.0 - 1e-10));
  }
  void report_all() const { report(run_, curves_.figures(o_.rho_f), o_.time.end >= 0.5); }

 private:
  /// Of each leaflet the line that encloses least: the free edge, unless it is turned outwards.
  [[nodiscard]] double orifice() const {
    const auto x = problem_.solids().positions();
    double area = 0.0;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const int first = problem_.solids().first_node(static_cast<int>(k));
      const double middle = AorticRoot::third * static_cast<double>(k), half = 0.5 * AorticRoot::third;
      double smallest = std::numeric_limits<double>::infinity();
      for (const auto& nodes : lines_[k]) {
        std::vector<Vec<double, 3>> line;
        for (int a : nodes) line.push_back(x[first + a]);
        smallest = std::min(smallest, orifice_area(line, o_.is_sector() ? 0.0 : middle - half, middle + half,
                                                   o_.root.radius));
      }
      area += smallest;
    }
    return o_.copies() * area;
  }

  Run& run_;
  const Problem& problem_;
  const ValveOptions& o_;
  std::vector<std::vector<std::vector<int>>> lines_;  ///< of each leaflet
  Section<FluidElement> before_, behind_, annulus_;
  ValveCurves curves_;
  Balances<Problem> balances_;
  FsiPictures pictures_;
  CsvFile csv_;
};

/// Leaflet nodes may lie in the wall, as deep as declared. \throws Error (configuration)
template <class Problem>
void check_protrusion(Run& run, const Problem& problem, double allowed) {
  double deepest = 0.0;
  int outside = 0;
  for (const auto& lost : problem.interpolation().lost_points()) {
    deepest = std::max(deepest, lost.distance);
    outside += lost.distance > allowed ? 1 : 0;
  }
  if (outside > 0)
    throw Error(ExitCode::configuration,
                std::to_string(outside) + " nodes of the leaflets lie outside of the vessel by up to " +
                    std::to_string(deepest) +
                    " cm; expected at most solid.protrusion_max = " + std::to_string(allowed));
  run.metric("protruding_nodes", static_cast<double>(problem.interpolation().lost().size()));
  run.metric("protrusion_max", deepest, "cm");
}

/// The leaflets of a valve, and their lines.
template <class Body>
struct ValveLeaflets {
  std::vector<Body> bodies;
  std::vector<std::vector<std::vector<int>>> lines;
};

/// \param make name, spacing of the nodes and angle to a body and its lines
template <class FluidElement, class Make>
auto valve_leaflets(const ValveOptions& o, Make&& make) {
  using Body = decltype(make(std::string(), 0.0, 0.0).first);
  ValveLeaflets<Body> leaflets;
  for (int k = 0; k < (o.is_sector() ? 1 : 3); ++k) {
    auto [body, lines] = make("leaflet " + std::to_string(k + 1), o.spacing * o.h_valve / FluidElement::order,
                              k * AorticRoot::third);
    leaflets.bodies.push_back(std::move(body)), leaflets.lines.push_back(std::move(lines));
  }
  return leaflets;
}

template <class FluidElement, class Body>
void run_semilunar_valve(Run& run, const ValveOptions& o, const std::string& data,
                         ValveLeaflets<Body> leaflets) {
  using Problem = FsiProblem<FluidElement, Body>;
  const FlowCurve curve(o.curve_file(data));
  if (curve.begin() > 0.0 || curve.end() < o.time.end)
    throw Error(ExitCode::configuration, "inlet.curve covers " + std::to_string(curve.begin()) + " to " +
                                             std::to_string(curve.end()) +
                                             " s; expected 0 to time.end = " + std::to_string(o.time.end));
  const auto mesh = distribute(vessel_mesh<FluidElement>(run, o, data + "/geometry/vessel.geo"), run.comm());
  constexpr bool may_protrude = true;
  Problem problem(mesh, valve_boundary(o, curve, o.copies() * plug_area(mesh)), o.rho_f, Newtonian{o.mu},
                  std::move(leaflets.bodies), o.flow, o.fsi, may_protrude);
  check_protrusion(run, problem, o.protrusion_max);
  if (o.fsi.seal > 0.0 && o.is_sector()) problem.add_seal_mirror(commissure_plane());
  if (o.fsi.contact_range > 0.0 && o.is_sector()) problem.add_contact_plane(commissure_plane());
  attach(run, problem);
  ValveHistory<FluidElement, Problem> history(run, problem, o, std::move(leaflets.lines));
  march(run, problem, o.time, [&](double dt) { history.observe(dt); });
  history.report_all();
}

/// The valve in a fluid of these cells, its leaflets by the law of the options.
template <class FluidElement>
void run_semilunar_valve_in(Run& run, const ValveOptions& o, const std::string& data) {
  const NeoHookean law(Lame::from_young(o.E, o.nu));
  const SolidParameters<3> solid{
      .rho_s = o.rho_s, .rho_f = o.rho_f, .mu_f = o.mu, .mu_s = 0.0, .gravity = {}};
  const Vec<double, 3> unused = {0.0, 0.0, 1.0};  // each point has its own directions
  const auto with_fibres = [&](const auto& matrix) {
    return TensionFibres(matrix, o.fibres, unused, o.fibres_stiffening, o.fibres_across);
  };
  const auto run_with = [&](auto&& make) {
    run_semilunar_valve<FluidElement>(run, o, data, valve_leaflets<FluidElement>(o, make));
  };
  const auto run_volumes = [&]<class Formulation>(const auto& fibred) {
    using Body = SolidBody<Hex2, std::remove_cvref_t<decltype(fibred)>, Formulation>;
    run_with([&](const std::string& name, double spacing, double angle) {
      auto l = leaflet_mesh<Hex2>(o.root, o.leaflet, spacing, o.layers, o.is_sector(), angle);
      return std::pair(Body(name, std::move(l.mesh), fibred, solid), std::move(l.lines));
    });
  };
  if (o.law.law == "volume") return run_volumes.template operator()<Fibred>(with_fibres(law));
  if (o.law.is_sheet())
    return run_volumes.template operator()<FibredSheet>(with_fibres(o.law.sheet(law, unused)));
  const auto membrane = with_fibres(PlaneStress(law));
  run_with([&](const std::string& name, double spacing, double angle) {
    auto l = leaflet_membrane<Quad2>(o.root, o.leaflet, spacing, o.is_sector(), angle);
    return std::pair(MembraneBody(name, std::move(l.mesh), membrane, solid, o.leaflet.thickness, o.bending),
                     std::move(l.lines));
  });
}

extern template void run_semilunar_valve_in<Tet1>(Run&, const ValveOptions&, const std::string&);
extern template void run_semilunar_valve_in<Tet2>(Run&, const ValveOptions&, const std::string&);

}  // namespace ifsi
