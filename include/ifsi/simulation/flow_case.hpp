#pragma once
/// \file
/// What the drivers of flow cases share: everything a driver includes, reports, fields and convergence
/// tables.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/assembly/integrals.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/io/mesh_output.hpp"
#include "ifsi/io/run.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/dispatch.hpp"
#include "ifsi/simulation/exact_flows.hpp"
#include "ifsi/simulation/flow_problem.hpp"
#include "ifsi/simulation/time_loop.hpp"

namespace ifsi {

/// Ties a problem to its run: Newton iterations go to the detailed log, the number of unknowns to the
/// summary, and a restarted run continues from its checkpoint.
template <class Problem>
void attach(Run& run, Problem& problem) {
  problem.watch([&run](const NewtonReport& r) {
    char line[120];
    std::snprintf(line, sizeof line, "  newton %d  momentum %.2e  mass %.2e  gmres so far %d", r.iterations,
                  r.residual.momentum, r.residual.mass, r.gmres);
    run.detail(line);
  });
  run.totals.dofs = problem.mesh().nodes.n_global() * Problem::B;
  if (!run.restarted()) return;
  problem.restore(Checkpoint(run.comm(), run.restart_file()));
  run.log("continues from t = " + std::to_string(problem.time()));
}

/// Solves for the steady state and logs how Newton got there. \throws Error (nonlinear) when it does not.
template <class Problem>
NewtonReport solve_steady(Run& run, Problem& problem) {
  attach(run, problem);
  const NewtonReport report = problem.solve_steady();
  if (!report.converged) throw Error(ExitCode::nonlinear, "no steady state found: " + report.failure);
  run.totals.newton += report.iterations;
  run.totals.gmres += report.gmres;
  ++run.totals.steps;
  run.log("steady state in " + std::to_string(report.iterations) + " Newton and " +
          std::to_string(report.gmres) + " GMRES iterations, " + problem.solver().description());
  return report;
}

/// One frame of fluid.pvd: velocity and pressure at the present time and, of the boundaries named `walls`,
/// the shear stress of the last step (eq. 31), which Tet2 has not.
template <class Problem>
void write_fields(VtuSeries& series, const Problem& problem, const std::vector<std::string>& walls = {}) {
  const auto u = problem.solution();
  MeshOutput output(problem.mesh());
  output.node_field("velocity", "length/time", u.data(), Problem::B, 0, Problem::dim);
  output.node_field("pressure", "force/area", u.data(), Problem::B, Problem::dim, 1);
  if constexpr (requires { problem.wall_traction(walls); }) {  // not on quadratic tetrahedra
    if (!walls.empty()) {
      const auto shear = problem.wall_traction(walls).shear;
      output.node_field("wall_shear_stress", "force/area", shear[0].data, Problem::dim, 0, Problem::dim);
    }
  }
  series.write(problem.time(), output.piece());
}
template <class Problem>
void write_fields(Run& run, const Problem& problem, const std::vector<std::string>& walls = {}) {
  VtuSeries series(run.comm(), run.path(""), "fluid");
  write_fields(series, problem, walls);
}

/// Errors of a flow against an exact solution at the present time, the mean of the pressure taken out of
/// both.
template <class Problem, class Exact>
FlowErrors exact_errors(const Problem& problem, const Exact& exact, double t) {
  using Point = typename Problem::Point;
  const auto& mesh = problem.mesh();
  auto u = problem.solution();
  const auto x = mesh.node_coordinates();
  const auto volumes = nodal_volumes<Cartesian>(mesh);
  double sums[2] = {};
  for (int node = 0; node < mesh.n_owned_nodes(); ++node) {
    sums[0] += volumes[node] * (u[node * Problem::B + Problem::dim] - exact.p(x[node], t));
    sums[1] += volumes[node];
  }
  mesh.comm.sum_in_place(sums, 2);
  for (int node = 0; node < mesh.n_nodes(); ++node) u[node * Problem::B + Problem::dim] -= sums[0] / sums[1];
  return flow_errors<Cartesian>(
      mesh, u, [&](const Point& y) { return exact.v(y, t); }, [&](const Point& y) { return exact.p(y, t); },
      [&](const Point& y) { return exact.grad_v(y, t); });
}

/// Norms of the difference between a flow and another solution on the same mesh.
template <class Problem>
FlowErrors difference(const Problem& problem, const std::vector<double>& other) {
  using Point = typename Problem::Point;
  auto u = problem.solution();
  for (std::size_t i = 0; i < u.size(); ++i) u[i] -= other[i];
  return flow_errors<Cartesian>(
      problem.mesh(), u, [](const Point&) { return Point::zero(); }, [](const Point&) { return 0.0; },
      [](const Point&) { return Mat<double, Problem::dim>::zero(); });
}

/// Errors over a sequence of mesh sizes or time steps: convergence.csv, metrics of the last row and observed
/// orders.
class ConvergenceTable {
 public:
  /// \param variable "h" or "t", the name of what is refined
  ConvergenceTable(Run& run, std::string variable)
      : run_(run),
        variable_(std::move(variable)),
        csv_(run.csv("convergence.csv", {{variable_, variable_ == "h" ? "length" : "time"},
                                         {"v_l2", "-"},
                                         {"v_h1", "-"},
                                         {"p_l2", "-"},
                                         {"cpu", "s"}})) {}

  /// The row's `cpu` is what all ranks took since the row before. Collective.
  void add(double size, const FlowErrors& e) {
    rows_.emplace_back(size, e);
    const std::clock_t now = std::clock();
    const double cpu = run_.comm().sum(static_cast<double>(now - last_) / CLOCKS_PER_SEC);
    last_ = now;
    csv_.row({size, e.v_l2, e.v_h1, e.p_l2, cpu});
    char line[160];
    std::snprintf(line, sizeof line, "%s %.4g  v_l2 %.4e  v_h1 %.4e  p_l2 %.4e  order v %.2f p %.2f",
                  variable_.c_str(), size, e.v_l2, e.v_h1, e.p_l2, order_v(), order_p());
    run_.log(line);
  }
  /// Observed orders between the last two rows; 0 with fewer.
  [[nodiscard]] double order_v() const { return order(&FlowErrors::v_l2); }
  [[nodiscard]] double order_p() const { return order(&FlowErrors::p_l2); }

  /// Hands the last errors, and the orders of a sweep, to the summary.
  void report() const {
    const FlowErrors& e = rows_.back().second;
    run_.metric("v_l2", e.v_l2);
    run_.metric("v_h1", e.v_h1);
    run_.metric("p_l2", e.p_l2);
    if (rows_.size() < 2) return;
    run_.metric("order_" + variable_ + "_v", order_v());
    run_.metric("order_" + variable_ + "_p", order_p());
  }

  /// Holds a sweep to what theory promises for shape functions of order k: k + 1 in h for the velocity, 1.5
  /// or more for the pressure, 2 in time for both (eq. 8, eq. 10).
  void check_orders(int k) const {
    if (rows_.size() < 2) return;
    if (variable_ == "h") {
      run_.check_at_least("order_h_v", order_v(), k + 0.9, "optimal order of the element");
      run_.check_at_least("order_h_p", order_p(), 1.5, "expected of equal order");
    } else {
      run_.check("order_t_v", order_v(), 2.0, 0.05, "second-order scheme (eq. 8)");
      run_.check("order_t_p", order_p(), 2.0, 0.05, "second-order scheme (eq. 10)");
    }
  }

 private:
  [[nodiscard]] double order(double FlowErrors::*norm) const {
    if (rows_.size() < 2) return 0.0;
    const auto& [h_0, e_0] = rows_[rows_.size() - 2];
    const auto& [h_1, e_1] = rows_.back();
    return std::log(e_0.*norm / e_1.*norm) / std::log(h_0 / h_1);
  }

  Run& run_;
  std::string variable_;
  CsvFile csv_;
  std::vector<std::pair<double, FlowErrors>> rows_;
  std::clock_t last_ = std::clock();
};

}  // namespace ifsi
