#include "ifsi/linalg/linear_solver.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/direct.hpp"
#include "ifsi/linalg/reuse.hpp"

namespace ifsi {
namespace {

/// Most unknowns for which LU beats GMRES.
constexpr long direct_limit(int B) { return B == 3 ? 100'000 : 3'000; }

/// Removes the mean of the last component: the constant pressure.
template <int B>
void project_pressure(const Layout& layout, double* x) {
  double sum = 0;
  for (int i = 0; i < layout.n_owned(); ++i) sum += x[static_cast<long>(i) * B + B - 1];
  const double mean = layout.communicator().sum(sum) / static_cast<double>(layout.n_global());
  for (int i = 0; i < layout.n_owned(); ++i) x[static_cast<long>(i) * B + B - 1] -= mean;
}

/// Mean size of the divergence rows over the mean size of the velocity diagonal: what a velocity correction that
/// cancels a unit momentum residual does to the mass residual.
template <int B>
double mass_per_momentum(const BlockCsr<B>& K) {
  double sums[2] = {0, 0};
  for (int i = 0; i < K.n_rows(); ++i) {
    double divergence = 0;
    for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k)
      for (int c = 0; c + 1 < B; ++c) divergence += std::pow(K.at(k)[(B - 1) * B + c], 2);
    const double* diagonal = K.at(K.find(i, i));
    // Nodes with a prescribed velocity have identity rows, whose size means nothing.
    if (diagonal[B - 1] == 0) continue;
    sums[0] += std::sqrt(divergence);
    sums[1] += std::abs(diagonal[0]);
  }
  K.layout().communicator().sum_in_place(sums, 2);
  return sums[0] > 0 && sums[1] > 0 ? sums[0] / sums[1] : 1.0;
}

}  // namespace

template <int B>
class LinearSolver<B>::Impl {
 public:
  Impl(LinearSolverOptions o, SchurProvider schur) : options_(std::move(o)), schur_(std::move(schur)) {
    if (options_.method != "auto" && options_.method != "direct" && options_.method != "gmres")
      throw Error(ExitCode::configuration,
                  "linear solver: unknown method \"" + options_.method + "\"; expected auto, direct or gmres");
  }

  SolverReport solve(const BlockCsr<B>& K, std::span<const double> rhs, std::span<double> x,
                     const SolveTarget& target) {
    choose(K);
    rhs_.assign(rhs.begin(), rhs.end());
    if (options_.enclosed) project_pressure<B>(K.layout(), rhs_.data());
    const bool fresh = !options_.reuse || reuse_.due();
    if (fresh) renew(K);
    const GmresOptions goal = absolute_target(K, x.data(), target);
    start_.assign(x.begin(), x.end());
    SolverReport report = run(K, x.data(), goal, fresh ? options_.max_iterations : reuse_.patience());
    if (!report.converged && !fresh) {
      std::copy(start_.begin(), start_.end(), x.begin());
      renew(K);
      report = run(K, x.data(), goal, options_.max_iterations);
    }
    reuse_.record(report.iterations);
    if (!report.converged) reuse_.invalidate();
    K.layout().update_ghosts(x.data(), B);
    return report;
  }

  std::string description;
  long total_iterations = 0, total_setups = 0;
  void invalidate() { reuse_.invalidate(); }

 private:
  void choose(const BlockCsr<B>& K) {
    if (!description.empty()) return;
    const long n = K.layout().n_global() * B;
    use_direct_ = options_.method == "direct" ||
                  (options_.method == "auto" && (n <= direct_limit(B) || !schur_));
    if (!use_direct_ && !schur_)
      throw Error(ExitCode::configuration, "linear solver: method gmres needs the parts of the Schur complement");
    const std::string why = options_.method != "auto" ? "as asked for"
                            : !schur_                                 ? "no preconditioner given"
                            : use_direct_                             ? "at most " + std::to_string(direct_limit(B))
                                                                      : "more than " + std::to_string(direct_limit(B));
    description = std::string(use_direct_ ? "direct (UMFPACK, kept as preconditioner of GMRES while it pays)"
                                          : "GMRES with block preconditioner") +
                  ", " + std::to_string(n) + " unknowns in " + std::to_string(B - 1) + "D: " + why;
  }

  void renew(const BlockCsr<B>& K) {
    // With the pressure level free the last unknown of node 0 is pinned; the projection undoes that choice.
    direct_.factor(K, options_.enclosed ? B - 1 : -1);
    const DirectSolver::Cost& cost = direct_.cost();
    reuse_.renewed(std::max(5.0, cost.flops / (20 * cost.lu_entries)));
    mass_per_momentum_ = mass_per_momentum(K);
    ++total_setups;
  }

  /// Relative targets refer to the initial residual of the same block, or to a thousandth of what the other block
  /// would leave behind in this one.
  GmresOptions absolute_target(const BlockCsr<B>& K, double* x, const SolveTarget& target) {
    std::vector<double> residual(rhs_.size());
    K.apply(x, residual.data());
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = rhs_[i] - residual[i];
    const BlockNorms r = block_norms<B>(K.layout(), residual);
    constexpr double floor = 1e-3;
    const double momentum = std::max(r.momentum, floor * r.mass / mass_per_momentum_);
    const double mass = std::max(r.mass, floor * r.momentum * mass_per_momentum_);
    GmresOptions goal;
    goal.target = {std::max(target.relative.momentum * momentum, target.absolute.momentum),
                   std::max(target.relative.mass * mass, target.absolute.mass)};
    return goal;
  }

  SolverReport run(const BlockCsr<B>& K, double* x, GmresOptions gmres, int max_iterations) {
    const Layout& layout = K.layout();
    const LinearMap preconditioner = [&](double* r, double* z) {
      if (options_.enclosed) project_pressure<B>(layout, r);
      direct_.apply(r, z);
      if (options_.enclosed) project_pressure<B>(layout, z);
    };
    gmres.max_iterations = std::min(max_iterations, options_.max_iterations);
    gmres.restart = options_.restart;
    gmres.mass_component = B - 1;
    const SolverReport report = fgmres(layout, B, linear_map(K), preconditioner, rhs_.data(), x, gmres);
    total_iterations += report.iterations;
    return report;
  }

  LinearSolverOptions options_;
  SchurProvider schur_;
  bool use_direct_ = true;
  DirectSolver direct_;
  ReusePolicy reuse_;
  double mass_per_momentum_ = 1;
  std::vector<double> rhs_, start_;
};

template <int B>
LinearSolver<B>::LinearSolver(LinearSolverOptions options, SchurProvider schur)
    : impl_(std::make_unique<Impl>(options, std::move(schur))) {}
template <int B>
LinearSolver<B>::~LinearSolver() = default;
template <int B>
LinearSolver<B>::LinearSolver(LinearSolver&&) noexcept = default;
template <int B>
LinearSolver<B>& LinearSolver<B>::operator=(LinearSolver&&) noexcept = default;
template <int B>
SolverReport LinearSolver<B>::solve(const BlockCsr<B>& K, std::span<const double> rhs, std::span<double> x,
                                    const SolveTarget& target) {
  return impl_->solve(K, rhs, x, target);
}
template <int B>
void LinearSolver<B>::invalidate() {
  impl_->invalidate();
}
template <int B>
std::string LinearSolver<B>::description() const {
  return impl_->description;
}
template <int B>
long LinearSolver<B>::total_iterations() const {
  return impl_->total_iterations;
}
template <int B>
long LinearSolver<B>::total_setups() const {
  return impl_->total_setups;
}

template class LinearSolver<3>;
template class LinearSolver<4>;

}  // namespace ifsi
