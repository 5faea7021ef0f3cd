#pragma once
/// \file
/// Newton's method for a solid alone: assembly into one sparse matrix, constraints, direct solve.

#include <algorithm>
#include <cmath>
#include <string>

#include "ifsi/assembly/solid_body.hpp"
#include "ifsi/linalg/direct.hpp"

namespace ifsi {

struct SolidNewtonOptions {
  double rtol = 1e-8;  ///< of the residual, relative to the element forces that cancel in it
  int max_iterations = 25;
  int max_halvings = 10;  ///< of an update that turns a cell inside out
};

struct SolidNewtonReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;    ///< last residual relative to the forces that cancel in it
  std::string diagnosis;  ///< what went wrong and where; empty when converged
};

/// Tangent and residual of a body with some of its displacement components prescribed. The unknown is the
/// displacement at the end of a step; the residual R collects elastic, inertial and external forces.
template <class Body>
class SolidSystem {
  static constexpr int dim = Body::dim, n = Body::n;

 public:
  explicit SolidSystem(const Body& body)
      : body_(body),
        cells_(body.all_cells()),
        K_(build_pattern(Layout(Communicator(MPI_COMM_SELF), body.n_nodes(), {}), body.mesh().cells)),
        blocks_(cell_block_map(K_.pattern(), body.mesh().cells)),
        R_(body.n_dofs()),
        scale_(body.n_dofs()),
        prescribed_(body.n_dofs()) {}

  [[nodiscard]] const Body& body() const { return body_; }
  /// Prescribes or frees one displacement component; `value` is what a full load asks for.
  void prescribe(int dof, double value) { prescribed_[dof] = {true, value}; }
  [[nodiscard]] bool is_prescribed(int dof) const { return prescribed_[dof].first; }
  [[nodiscard]] double prescribed(int dof) const { return prescribed_[dof].second; }
  /// Residual of the last assembly, reactions included.
  [[nodiscard]] const std::vector<double>& residual() const { return R_; }

  /// Residual and tangent of the body. `u_before` is the displacement (at its level) of the Newton iteration
  /// before this one.
  DeformationReport assemble(const SolidState& state, std::span<const double> u_before,
                             const StateSlopes& slopes) {
    std::fill(R_.begin(), R_.end(), 0.0);
    std::fill(scale_.begin(), scale_.end(), 0.0);
    K_.set_zero();
    const auto sink = [&](int c, std::span<const double> R, std::span<const double> K) {
      add_residual(body_.mesh().cells[c], R);
      for (int k = 0; k < n * n; ++k) add_block(blocks_[c][k], &K[k * dim * dim]);
    };
    if constexpr (Body::Formulation::mean_dilatation)
      return body_.residual_and_robust_tangent(state, u_before, slopes, cells_, sink);
    else
      return body_.residual_and_tangent(state, slopes, cells_, sink);
  }
  /// Adds the residual of a face or cell with these nodes.
  void add_residual(std::span<const int> nodes, std::span<const double> R) {
    for (std::size_t k = 0; k < R.size(); ++k) {
      const int dof = nodes[k / dim] * dim + static_cast<int>(k % dim);
      R_[dof] += R[k];
      scale_[dof] += std::abs(R[k]);
    }
  }
  void add_tangent(std::span<const int> nodes, std::span<const double> K) {
    const int m = static_cast<int>(nodes.size());
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b) add_block(K_.find(nodes[a], nodes[b]), &K[(a * m + b) * dim * dim]);
  }

  /// Norms over the nodes: of the free residual, and of the element forces that cancel in it.
  struct Norms {
    double residual = 0, forces = 0;
    int worst_node = 0;
  };
  [[nodiscard]] Norms norms() const {
    Norms r;
    double worst = -1;
    for (int i = 0; i < body_.n_dofs(); ++i) {
      r.forces += scale_[i] * scale_[i];
      if (is_prescribed(i)) continue;
      r.residual += R_[i] * R_[i];
      if (std::abs(R_[i]) > worst) worst = std::abs(R_[i]), r.worst_node = i / dim;
    }
    r.residual = std::sqrt(r.residual);
    r.forces = std::sqrt(r.forces);
    return r;
  }

  /// The displacement update that cancels the residual; prescribed components get `gap`.
  [[nodiscard]] std::vector<double> solve(const std::vector<double>& gap) {
    std::vector<double> b(R_.size()), du(R_.size());
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = prescribed_[i].first ? gap[i] : -R_[i];
    for (int i = 0; i < body_.n_dofs(); ++i)
      if (is_prescribed(i)) set_identity_row(i);
    solver_.factor(K_);
    solver_.apply(b.data(), du.data());
    return du;
  }

 private:
  void add_block(int block, const double* values) {
    double* to = K_.at(block);
    for (int k = 0; k < dim * dim; ++k) to[k] += values[k];
  }
  void set_identity_row(int dof) {
    const int node = dof / dim, i = dof % dim;
    for (int k = K_.row_ptr()[node]; k < K_.row_ptr()[node + 1]; ++k)
      std::fill_n(K_.at(k) + i * dim, dim, 0.0);
    K_.at(K_.find(node, node))[i * dim + i] = 1.0;
  }

  const Body& body_;
  std::vector<int> cells_;
  BlockCsr<dim> K_;
  std::vector<std::array<int, n * n>> blocks_;
  std::vector<double> R_, scale_;
  std::vector<std::pair<bool, double>> prescribed_;
  DirectSolver solver_;
};

/// Runs Newton on the displacement u of a step. `evaluate(u, u_before)` assembles residual and tangent and
/// returns a DeformationReport; `target(dof)` is the prescribed displacement.
template <class System, class Evaluate, class Target>
SolidNewtonReport solid_newton(System& system, std::vector<double>& u, const SolidNewtonOptions& options,
                               const Evaluate& evaluate, const Target& target) {
  SolidNewtonReport report;
  std::vector<double> du, gap(u.size()), u_before = u;
  double first_forces = 0;  // in free fall nothing is left to compare with at the end
  int halvings = 0;
  for (;;) {
    const DeformationReport deformation = evaluate(u, u_before);
    if (deformation.inverted()) {
      report.diagnosis = "cell " + std::to_string(deformation.cell) +
                         " turns inside out (det F = " + std::to_string(deformation.min_det_F) + ")";
      if (du.empty() || ++halvings > options.max_halvings) return report;
      for (std::size_t i = 0; i < u.size(); ++i) u[i] -= (du[i] *= 0.5);
      continue;
    }
    bool at_target = true;
    for (std::size_t i = 0; i < u.size(); ++i) {
      gap[i] = system.is_prescribed(static_cast<int>(i)) ? target(static_cast<int>(i)) - u[i] : 0.0;
      at_target &= std::abs(gap[i]) <= 1e-12 * std::abs(u[i]);
    }
    const auto norms = system.norms();
    if (report.iterations == 0) first_forces = norms.forces;
    const double forces = std::max(norms.forces, first_forces);
    report.residual = forces > 0 ? norms.residual / forces : 0;
    if (at_target && report.residual <= options.rtol) {
      report.converged = true;
      report.diagnosis.clear();
      return report;
    }
    report.diagnosis = "the residual stays at " + std::to_string(report.residual) +
                       " of the forces, worst at node " + std::to_string(norms.worst_node);
    if (report.iterations == options.max_iterations || !std::isfinite(report.residual)) return report;
    du = system.solve(gap);
    u_before = u;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += du[i];
    halvings = 0;
    ++report.iterations;
  }
}

}  // namespace ifsi
