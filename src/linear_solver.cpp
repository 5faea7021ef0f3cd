#include "ifsi/linalg/linear_solver.hpp"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/direct.hpp"
#include "ifsi/linalg/method_choice.hpp"
#include "ifsi/linalg/reuse.hpp"
#include "ifsi/linalg/saddle_preconditioner.hpp"

namespace ifsi {
namespace {

/// Removes the mean of the last component: the constant pressure.
template <int B>
void project_pressure(const Layout& layout, double* x) {
  double sum = 0;
  for (int i = 0; i < layout.n_owned(); ++i) sum += x[static_cast<long>(i) * B + B - 1];
  const double mean = layout.communicator().sum(sum) / static_cast<double>(layout.n_global());
  for (int i = 0; i < layout.n_owned(); ++i) x[static_cast<long>(i) * B + B - 1] -= mean;
}

/// Mean size of the divergence rows over the mean size of the velocity diagonal: what a velocity correction
/// that cancels a unit momentum residual does to the mass residual.
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
  Impl(LinearSolverOptions o, SchurProvider schur)
      : options_(std::move(o)),
        schur_(std::move(schur)),
        saddle_({.velocity = options_.velocity, .enclosed = options_.enclosed}) {
    if (options_.method != "auto" && options_.method != "direct" && options_.method != "gmres")
      throw Error(ExitCode::configuration, "linear solver: unknown method \"" + options_.method +
                                               "\"; expected auto, direct or gmres");
    if (schur_ || options_.method == "direct") return;
    if (options_.method == "gmres")
      throw Error(ExitCode::configuration,
                  "linear solver: method gmres needs the parts of the Schur complement");
    options_.method = "direct";
    reason_ = "no preconditioner given";
  }

  SolverReport solve(const BlockCsr<B>& K, std::span<const double> rhs, std::span<double> x,
                     const SolveTarget& target) {
    rhs_.assign(rhs.begin(), rhs.end());
    if (options_.enclosed) project_pressure<B>(K.layout(), rhs_.data());
    const bool fresh = !options_.reuse || reuse_.due();
    if (fresh) renew(K);
    start_.assign(x.begin(), x.end());
    SolverReport report = run(K, x.data(), target, fresh);
    if (!report.converged && !fresh) {
      std::copy(start_.begin(), start_.end(), x.begin());
      renew(K);
      report = run(K, x.data(), target, true);
    }
    if (!report.converged && may_fall_back(K)) {
      std::copy(start_.begin(), start_.end(), x.begin());
      renew(K);
      report = run(K, x.data(), target, true);
    }
    if (!report.converged && std::exchange(fell_back_, false)) options_.method = "auto";
    reuse_.record(report.iterations, report.decades());
    if (!report.converged) reuse_.invalidate();
    K.layout().update_ghosts(x.data(), B);
    return report;
  }

  std::string description;
  long total_iterations = 0, total_setups = 0;
  void invalidate() { reuse_.invalidate(); }

 private:
  static std::string size_text(const BlockCsr<B>& K) {
    return ", " + std::to_string(K.layout().n_global() * B) + " unknowns in " + std::to_string(B - 1) + "D: ";
  }
  static std::string describe_direct(const BlockCsr<B>& K, const std::string& why) {
    return "direct (UMFPACK, kept as preconditioner of GMRES while it pays)" + size_text(K) + why;
  }

  /// At every set-up, for the matrix as it is: another time step may change the choice.
  void choose(const BlockCsr<B>& K, const SchurParts& parts) {
    MethodChoice choice{options_.method == "direct", reason_};
    if (options_.method == "auto") choice = choose_method(K, parts);
    use_direct_ = choice.direct;
    choice_ = choice.direct ? describe_direct(K, choice.why)
                            : "GMRES with block preconditioner" + size_text(K) + choice.why;
  }

  /// Where the block preconditioner fails, LU takes over, if the size allows, until it fails too: a system
  /// that nobody solves says nothing of the next.
  bool may_fall_back(const BlockCsr<B>& K) {
    if (use_direct_ || options_.method != "auto" || !lu_is_affordable(B - 1, K.layout().n_global() * B))
      return false;
    options_.method = "direct";
    reason_ = "GMRES with block preconditioner did not converge";
    return fell_back_ = true;
  }

  void renew(const BlockCsr<B>& K) {
    mass_per_momentum_ = mass_per_momentum(K);
    ++total_setups;
    const SchurParts parts = options_.method == "direct" ? SchurParts{} : schur_();
    steady_ = parts.steady;
    choose(K, parts);
    if (!use_direct_) {
      saddle_.update(K, parts);
      reuse_.renewed(saddle_.setup_cost());
      description = choice_ + "; " + saddle_.description();
      return;
    }
    description = choice_;
    // With the pressure level free the last unknown of node 0 is pinned; the projection undoes that choice.
    direct_.factor(K, options_.enclosed ? B - 1 : -1);
    reuse_.renewed(direct_.setup_cost());
  }

  /// z = P^-1 r. In steady flow, where S^-1 is crudest, P is applied once more to what is left over: half as
  /// many iterations for about the same time, and half as many vectors of GMRES.
  void apply_saddle(const BlockCsr<B>& K, const double* r, double* z) {
    saddle_.apply(r, z);
    if (!steady_) return;
    const std::size_t n = static_cast<std::size_t>(K.n_rows()) * B;
    left_.resize(static_cast<std::size_t>(K.layout().n_local()) * B), correction_.resize(left_.size());
    linear_map(K)(z, left_.data());
    for (std::size_t k = 0; k < n; ++k) left_[k] = r[k] - left_[k];
    saddle_.apply(left_.data(), correction_.data());
    for (std::size_t k = 0; k < n; ++k) z[k] += correction_[k];
  }

  SolverReport run(const BlockCsr<B>& K, double* x, const SolveTarget& target, bool fresh) {
    const Layout& layout = K.layout();
    const LinearMap preconditioner = [&](double* r, double* z) {
      if (options_.enclosed) project_pressure<B>(layout, r);
      if (use_direct_)
        direct_.apply(r, z);
      else
        apply_saddle(K, r, z);
      if (options_.enclosed) project_pressure<B>(layout, z);
    };
    GmresOptions gmres;
    gmres.target = target;
    gmres.mass_per_momentum = mass_per_momentum_;
    gmres.max_iterations = options_.max_iterations;
    if (!fresh) {
      const double decades = -std::log10(std::min(target.relative.momentum, target.relative.mass));
      gmres.max_iterations = std::min(gmres.max_iterations, reuse_.patience(decades));
    }
    gmres.restart = options_.restart;
    gmres.mass_component = B - 1;
    const SolverReport report =
        fgmres(layout, B, linear_map(K), preconditioner, rhs_.data(), x, gmres, &workspace_);
    total_iterations += report.iterations;
    return report;
  }

  LinearSolverOptions options_;
  SchurProvider schur_;
  std::string choice_, reason_ = "as asked for";
  bool use_direct_ = true, steady_ = false, fell_back_ = false;
  DirectSolver direct_;
  SaddlePreconditioner<B> saddle_;
  ReusePolicy reuse_;
  double mass_per_momentum_ = 1;
  std::vector<double> rhs_, start_, left_, correction_;
  GmresWorkspace workspace_;
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
