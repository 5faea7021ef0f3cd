#pragma once
/// \file
/// What the drivers of immersed cases share: output of the solids, balances, tip curves against references.

#include <cmath>
#include <string>
#include <vector>

#include "ifsi/material/materials.hpp"
#include "ifsi/simulation/flow_case.hpp"
#include "ifsi/simulation/fsi_problem.hpp"
#include "ifsi/simulation/probe.hpp"
#include "ifsi/simulation/profiles.hpp"
#include "ifsi/simulation/signal.hpp"

namespace ifsi {

/// The deformed bodies as one grid with velocity, det F and largest principal stress; rank 0 writes all of
/// it.
template <class Body>
[[nodiscard]] VtuPiece solid_piece(const ImmersedSolids<Body>& solids, bool root) {
  using Element = typename Body::Element;
  constexpr int dim = Element::dim;
  VtuPiece piece;
  VtuField velocity{"velocity", "length/time", 3, {}}, det_F{"det_F", "-", 1, {}},
      stress{"principal_stress_1", "force/area", 1, {}};
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
    }
    for (const auto& cell : body.mesh().cells) {
      for (int k : Element::vtk_order) piece.connectivity.push_back(first + cell[k]);
      piece.offsets.push_back(static_cast<long>(piece.connectivity.size()));
      piece.types.push_back(static_cast<unsigned char>(Element::vtk_type));
    }
  }
  piece.point_fields = {velocity, det_F, stress};
  return piece;
}

/// fluid.pvd and solid.pvd, a frame whenever `interval` has passed.
class FsiPictures {
 public:
  FsiPictures(Run& run, double interval)
      : fluid_(run.comm(), run.path(""), "fluid"),
        solid_(run.comm(), run.path(""), "solid"),
        interval_(interval) {}

  template <class Problem>
  void write(const Problem& problem, bool always = false) {
    if (!always && problem.time() < next_) return;
    write_fields(fluid_, problem);
    solid_.write(problem.time(), solid_piece(problem.solids(), problem.mesh().comm.is_root()));
    next_ = (std::floor(problem.time() / interval_ + 1e-9) + 1.0) * interval_;
  }

 private:
  VtuSeries fluid_, solid_;
  double interval_, next_ = 0.0;
};

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
  int lost = 0;

  template <class Problem>
  SolidTotals<Problem::dim> observe(const Problem& problem) {
    const auto totals = problem.solids().totals();
    area_change = std::max(area_change, std::abs(totals.volume / totals.reference_volume - 1.0));
    det_F_min = std::min(det_F_min, totals.deformation.min_det_F);
    mesh_ratio = std::max(mesh_ratio, problem.ratio().ratio);
    lost = std::max(lost, static_cast<int>(problem.interpolation().lost().size()));
    return totals;
  }
  void report(Run& run) const {
    run.metric("area_change_max", area_change);
    run.metric("det_f_min", det_F_min);
    run.metric("mesh_ratio_max", mesh_ratio);
    run.metric("lost_nodes_max", lost);
    if (mesh_ratio > 1.0)
      run.log("warning: solid nodes are up to " + std::to_string(mesh_ratio) +
              " fluid spacings apart; above 1 the fluid leaks between them");
  }
};

}  // namespace ifsi
