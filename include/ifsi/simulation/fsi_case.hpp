#pragma once
/// \file
/// What the drivers of immersed cases share: output of the solids, balances, tip curves against references.

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "ifsi/material/materials.hpp"
#include "ifsi/simulation/balances.hpp"
#include "ifsi/simulation/dispatch.hpp"
#include "ifsi/simulation/flow_case.hpp"
#include "ifsi/simulation/fsi_problem.hpp"
#include "ifsi/simulation/law_choice.hpp"
#include "ifsi/simulation/probe.hpp"
#include "ifsi/simulation/profiles.hpp"
#include "ifsi/simulation/signal.hpp"

namespace ifsi {

/// What the cases of a leaflet in a channel let a user choose.
struct LeafletOptions {
  std::array<int, 2> n,
      n_s;  ///< fluid cells along and across the channel, solid cells through and along the leaflet
  double rho = 100.0, mu = 10.0, density_ratio = 1.0, thickness = 0.0212, picture_every = 0.1;
  std::string element = "quad1";  ///< of the fluid
  LawChoice law;
  TimeOptions time;
  FlowOptions flow;
  FsiOptions fsi;

  LeafletOptions(std::array<int, 2> fluid_cells, std::array<int, 2> solid_cells, double dt)
      : n(fluid_cells), n_s(solid_cells) {
    time.dt = dt, time.end = 3.0, flow.rho_inf = 0.0;
  }
  void declare(Parameters& params) {
    params.add("mesh.nx", n[0], "-", "fluid cells along the channel", {8, 4096});
    params.add("mesh.ny", n[1], "-", "fluid cells across the channel", {4, 1024});
    params.add_choice("mesh.element", element, {"quad1", "quad2"}, "element of the fluid");
    params.add("solid.n_thick", n_s[0], "-", "solid cells through the thickness", {1, 64});
    params.add("solid.n_high", n_s[1], "-", "solid cells along the leaflet", {4, 2000});
    params.add("fluid.rho", rho, "mass/length^3", "density of the fluid", positive);
    params.add("solid.density_ratio", density_ratio, "-", "density of the solid over the fluid's", positive);
    params.add("solid.thickness", thickness, "length", "thickness of the leaflet", positive);
    params.add("fluid.mu", mu, "mass/(length time)", "dynamic viscosity", positive);
    params.add("output.every", picture_every, "time", "time between pictures", positive);
    law.declare(params), time.declare(params), flow.declare(params), fsi.declare(params);
  }
  /// Calls scene<Element>(law) with the fluid's element, and the law as it is or, for solid.law = sheet, that
  /// of an upright sheet of it.
  template <SolidLaw Law, class Scene>
  void with_policies(const Law& volume, Scene&& scene) const {
    dispatch_element<Quad1, Quad2>(element, [&]<class Element>() {
      if (!law.is_sheet()) return scene.template operator()<Element>(volume);
      scene.template operator()<Element>(law.sheet(volume, {1.0, 0.0, 0.0}));
    });
  }
  /// Parameters of a solid that displaces this fluid.
  [[nodiscard]] SolidParameters<2> solid() const {
    return {.rho_s = density_ratio * rho, .rho_f = rho, .mu_f = mu, .mu_s = 0.0, .gravity = {}};
  }
};

/// The deformed bodies as one grid with velocity, det F and the largest principal stress and strain (eq. 30);
/// rank 0 writes all of it.
template <class Body>
[[nodiscard]] VtuPiece solid_piece(const ImmersedSolids<Body>& solids, bool root) {
  using Element = typename Body::Element;
  constexpr int dim = Body::dim;
  VtuPiece piece;
  VtuField velocity{"velocity", "length/time", 3, {}}, det_F{"det_F", "-", 1, {}},
      stress{"principal_stress_1", "force/area", 1, {}}, strain{"principal_strain_1", "-", 1, {}};
  const auto u = solids.displacement(), v = solids.velocity();
  for (std::size_t b = 0; root && b < solids.bodies().size(); ++b) {
    const Body& body = solids.bodies()[b];
    const int first = solids.first_node(static_cast<int>(b));
    const SolidFields fields = body.fields(u.subspan(first * dim, body.n_dofs()));
    for (int a = 0; a < body.n_nodes(); ++a) {
      for (int i = 0; i < 3; ++i) {
        const int k = (first + a) * dim + i;
        piece.points.push_back(i < dim ? body.mesh().points[a][i] + u[k] : 0.0);
        velocity.values.push_back(i < dim ? v[k] : 0.0);
      }
      det_F.values.push_back(fields.det_F[a]);
      stress.values.push_back(fields.principal[3 * a]);
      strain.values.push_back(fields.principal_strain[3 * a]);
    }
    for (const auto& cell : body.mesh().cells) {
      for (int k : Element::vtk_order) piece.connectivity.push_back(first + cell[k]);
      piece.offsets.push_back(static_cast<long>(piece.connectivity.size()));
      piece.types.push_back(static_cast<unsigned char>(Element::vtk_type));
    }
  }
  piece.point_fields = {velocity, det_F, stress, strain};
  return piece;
}

/// fluid.pvd and solid.pvd, a frame whenever `interval` has passed.
class FsiPictures {
 public:
  /// \param walls boundaries whose shear stress is wanted
  FsiPictures(Run& run, double interval, std::vector<std::string> walls = {})
      : fluid_(run.comm(), run.path(""), "fluid"),
        solid_(run.comm(), run.path(""), "solid"),
        walls_(std::move(walls)),
        interval_(interval) {}

  /// A restarted run keeps the frames up to its time.
  void resume(double t) {
    fluid_.resume(t), solid_.resume(t);
    next_ = (std::floor(t / interval_ + 1e-9) + 1.0) * interval_;
  }

  template <class Problem>
  void write(const Problem& problem, bool always = false) {
    if (!always && problem.time() < next_) return;
    write_fields(fluid_, problem, walls_);
    solid_.write(problem.time(), solid_piece(problem.solids(), problem.mesh().comm.is_root()));
    next_ = (std::floor(problem.time() / interval_ + 1e-9) + 1.0) * interval_;
  }

 private:
  VtuSeries fluid_, solid_;
  std::vector<std::string> walls_;
  double interval_, next_ = 0.0;
};

/// What to tell a user about a ratio of solid to fluid node spacing: empty up to 1. A line of cells that
/// nodes h_s apart run through has nodes in h/h_s of its cells; nothing holds the fluid back in the others.
[[nodiscard]] inline std::string coarse_solid_warning(double ratio) {
  if (ratio <= 1.0) return {};
  char text[240];
  std::snprintf(
      text, sizeof text,
      "warning: solid nodes are up to %.3g fluid spacings apart: %.0f %% of the cells that the solid crosses "
      "there hold none of them and let the fluid through; expected 1 at most, 0.67 to be tight",
      ratio, 100.0 * (1.0 - 1.0 / ratio));
  return text;
}

/// What to tell a user about thick bodies of more nodes than the fluid has in them: empty for bodies thinner
/// than two cells, which take part of the fluid's place in any case, and for those with no more nodes. \param
/// thickness of the bodies in fluid spacings; \param nodes their number per fluid node
[[nodiscard]] inline std::string fine_solid_note(double thickness, double nodes) {
  if (thickness < 2.0 || nodes < 1.1) return {};
  char text[240];
  std::snprintf(text, sizeof text,
                "note: %.2g solid nodes per fluid node in bodies %.2g fluid spacings thick: fluid cells that "
                "their surface enters are held whole; where small forces matter take one solid node per "
                "fluid node",
                nodes, thickness);
  return text;
}
template <class Element, class Body, class Model>
[[nodiscard]] std::string fine_solid_note(const FsiProblem<Element, Body, Model>& problem) {
  if (Body::Coordinates::axisymmetric) return {};
  const auto& solids = problem.solids();
  const double h = problem.fluid_spacing(), volume = solids.totals().reference_volume;
  double nodes = solids.n_nodes(), surface = 0.0;
  for (const auto& point : solids.surface_points()) nodes -= 0.5, surface += point.area;
  return fine_solid_note(2.0 * volume / (surface * h), nodes * std::pow(h, Body::dim) / volume);
}

/// As for any flow; also says which nodes are held outside of the fluid, and when a solid is too coarse.
template <class Element, class Body, class Model>
void attach(Run& run, FsiProblem<Element, Body, Model>& problem) {
  attach<FsiProblem<Element, Body, Model>>(run, problem);  // the one above it in flow_case.hpp
  run.log("LU of the unknowns around the solid: " + problem.linear_solver().patch_method());
  if (const auto n = problem.interpolation().lost().size(); n > 0)
    run.log(std::to_string(n) + " solid nodes lie outside of the fluid mesh and are held at their place");
  if (const auto& contact = problem.solids().contact())
    run.log("contact: surfaces repel from a distance of " + std::to_string(contact->range()) + " on");
  for (const std::string& remark : {coarse_solid_warning(problem.ratio().ratio), fine_solid_note(problem)})
    if (!remark.empty()) run.log(remark);
}

/// The node of a body nearest to a position.
template <class Body>
[[nodiscard]] int nearest_node(const Body& body, const Vec<double, Body::dim>& x) {
  int best = 0;
  const auto distance = [&](int a) { return dot(body.mesh().points[a] - x, body.mesh().points[a] - x); };
  for (int a = 1; a < body.n_nodes(); ++a)
    if (distance(a) < distance(best)) best = a;
  return best;
}

/// Root mean square over [t_0, t_1] of the difference between a signal and a curve in a file, at the curve's
/// points.
[[nodiscard]] inline double rms_difference(const Signal& signal, const std::string& file,
                                           const std::string& column, double t_0, double t_1) {
  const auto curve = read_profile(file, column);
  if (!curve) throw Error(ExitCode::file, file + ": no column \"" + column + "\"");
  double sum = 0.0;
  int n = 0;
  for (const auto& [t, value] : *curve) {
    if (t < t_0 || t > t_1) continue;
    sum += (signal.at(t) - value) * (signal.at(t) - value);
    ++n;
  }
  return n == 0 ? 0.0 : std::sqrt(sum / n);
}

/// Largest difference between the last cycle of a signal and the one before, over the signal's range.
[[nodiscard]] inline double cycle_difference(const Signal& signal, double t_end, double period) {
  double difference = 0.0;
  for (double t = t_end - period; t <= t_end; t += period / 200.0)
    difference = std::max(difference, std::abs(signal.at(t) - signal.at(t - period)));
  return difference / (signal.max(t_end - 2.0 * period).value - signal.min(t_end - 2.0 * period).value);
}

/// Largest nodal speed, over all ranks.
template <class Problem>
[[nodiscard]] double largest_speed(const Problem& problem) {
  double largest = 0.0;
  const auto v = problem.state().velocity();
  for (int node = 0; node < problem.mesh().n_owned_nodes(); ++node) {
    double square = 0.0;
    for (int i = 0; i < Problem::dim; ++i) square += v[node * Problem::B + i] * v[node * Problem::B + i];
    largest = std::max(largest, square);
  }
  return std::sqrt(problem.mesh().comm.max(largest));
}

/// Largest values over a run that every immersed case reports.
struct FsiExtremes {
  double area_change = 0.0, det_F_min = 1.0, mesh_ratio = 0.0;
  double s1_p99 = 0.0;  ///< of the largest principal stress, over 99 % of the volume (eq. 30)
  int lost = 0;
  double contact_gap = std::numeric_limits<double>::infinity();  ///< least distance of surfaces in contact

  template <class Problem>
  SolidTotals<Problem::dim> observe(const Problem& problem) {
    const auto totals = problem.solids().totals();
    area_change = std::max(area_change, std::abs(totals.volume / totals.reference_volume - 1.0));
    det_F_min = std::min(det_F_min, totals.deformation.min_det_F);
    s1_p99 = std::max(s1_p99, volume_quantile(problem.solids().principal_samples().stress, 0.99));
    mesh_ratio = std::max(mesh_ratio, problem.ratio().ratio);
    lost = std::max(lost, static_cast<int>(problem.interpolation().lost().size()));
    if (problem.solids().contact())
      contact_gap = std::min(contact_gap, problem.solids().contact_totals().gap);
    return totals;
  }
  void report(Run& run) const {
    run.metric("area_change_max", area_change);
    run.metric("det_f_min", det_F_min);
    run.metric("s1_p99", s1_p99, "force/area");
    run.metric("mesh_ratio_max", mesh_ratio);
    run.metric("lost_nodes_max", lost);
    if (std::isfinite(contact_gap)) run.metric("contact_gap_min", contact_gap, "length");
    if (mesh_ratio > 1.0) run.log(coarse_solid_warning(mesh_ratio));
  }
};

/// What every case in time records: the displacement of one node, balances, pictures, and the figures of the
/// summary.
template <class Problem>
class TipHistory {
 public:
  /// \param node whose displacement is followed; \param more further columns of history.csv
  TipHistory(Run& run, const Problem& problem, double t_end, double picture_every, int node,
             const std::string& length, const std::vector<Column>& more = {})
      : run_(run),
        problem_(problem),
        node_(node),
        length_(length),
        t_end_(t_end),
        balances_(problem),
        pictures_(run, picture_every) {
    if (run.restarted()) pictures_.resume(problem.time());
    if (!problem.advice().empty()) run.log(problem.advice());
    std::vector<Column> columns = {{"t", "s"},
                                   {"tip_dx", length},
                                   {"tip_dy", length},
                                   {"area", length + "^2"},
                                   {"elastic_energy", "energy/length"},
                                   {"kinetic_energy", "energy/length"},
                                   {"det_f_min", "-"},
                                   {"dt", "s"}};
    if (problem.solids().contact()) columns.push_back({"contact_energy", "energy/length"});
    for (const auto& further : {Balances<Problem>::columns(), more})
      columns.insert(columns.end(), further.begin(), further.end());
    csv_ = run.csv("history.csv", columns, problem.time());
  }

  /// Call after each step; `more` fills the further columns.
  void observe(double dt, const std::vector<double>& more = {}) {
    const double t = problem_.time();
    const auto u = problem_.solids().displacement(node_);
    const auto totals = extremes_.observe(problem_);
    constraint_ = std::max(constraint_, problem_.constraint_violation());
    dx_.add(t, u[0]), dy_.add(t, u[1]);
    std::vector<double> row = {t,
                               u[0],
                               u[1],
                               totals.volume,
                               totals.elastic_energy,
                               totals.kinetic_energy,
                               totals.deformation.min_det_F,
                               dt};
    if (problem_.solids().contact()) row.push_back(problem_.solids().contact_totals().energy);
    for (const auto& further : {balances_.observe(dt), more})
      row.insert(row.end(), further.begin(), further.end());
    csv_.row(row);
    pictures_.write(problem_, t >= t_end_ * (1.0 - 1e-10));
  }
  [[nodiscard]] const Signal& dx() const { return dx_; }
  [[nodiscard]] const Signal& dy() const { return dy_; }

  /// Extremes of the tip from t_from on, and those of the body over the whole run.
  void report(double t_from) const {
    run_.metric("tip_dx_max", dx_.max(t_from).value, length_);
    run_.metric("tip_dx_min", dx_.min(t_from).value, length_);
    run_.metric("tip_dy_max", dy_.max(t_from).value, length_);
    run_.metric("tip_dx_peak", dx_.max().value, length_);
    run_.metric("tip_dx_end", dx_.at(t_end_), length_);
    run_.metric("constraint_max", constraint_, length_ + "/s");
    run_.metric("energy_lost", balances_.lost_part());
    extremes_.report(run_);
  }
  /// Root mean square differences to the curves `<file>_dx_<curve>.csv` and `<file>_dy_<curve>.csv`.
  void compare(const std::string& file, const std::string& curve) const {
    const double rms_x = rms_difference(dx_, file + "_dx_" + curve + ".csv", "dx_cm", 0.0, t_end_);
    const double rms_y = rms_difference(dy_, file + "_dy_" + curve + ".csv", "dy_cm", 0.0, t_end_);
    run_.metric("rms_dx_" + curve, rms_x, length_);
    run_.metric("rms_dy_" + curve, rms_y, length_);
  }

 private:
  Run& run_;
  const Problem& problem_;
  int node_;
  std::string length_;
  double t_end_, constraint_ = 0.0;
  Signal dx_, dy_;
  FsiExtremes extremes_;
  Balances<Problem> balances_;
  FsiPictures pictures_;
  CsvFile csv_;
};

}  // namespace ifsi
