#pragma once
/// \file
/// Solver for a flow matrix plus the stiff matrix of thin immersed solids.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/direct.hpp"
#include "ifsi/linalg/gmres.hpp"
#include "ifsi/linalg/method_choice.hpp"
#include "ifsi/linalg/reuse.hpp"
#include "ifsi/linalg/saddle_preconditioner.hpp"
#include "ifsi/linalg/schur_parts.hpp"

namespace ifsi {

struct PatchedSolverOptions {
  std::string base =
      "auto";  ///< fluid-only preconditioner: "direct" (kept LU), "gmres" (block preconditioner)
  int max_iterations = 200;
  /// How many times as large as the solid asks for the patch may become by holding, too, the nodes that were
  /// around the solid when the fluid was set up; 1: it does not hold them.
  double growth = 2.0;
  bool enclosed = false;
};

/// Solves (K_f + K_s) x = b, K_s = C K C^T with a layout of its own whose owned nodes are those of K_f.
///
/// A preconditioner of the fluid alone does not know the solid, and multigrid on the sum fails for thin stiff
/// bodies. So the unknowns (v, p) of a patch of nodes around the solid are solved for directly, with the
/// fresh sum of both matrices, multiplicatively after the fluid's preconditioner (and before it too where
/// that is only approximate). The fluid's set-up may be many steps old; the patch is renewed in every solve:
/// it is the solid that changes.
template <int B>
class PatchedSolver {
 public:
  PatchedSolver(PatchedSolverOptions options, SchurProvider schur)
      : options_(std::move(options)), schur_(std::move(schur)), saddle_({.enclosed = options_.enclosed}) {}

  /// Collective. Declares the patch: in_patch per local node of K_f (ghosts included). Call when the patch or
  /// the pattern of K_s has changed. To it come the nodes of the patch at the fluid's set-up, whose rows have
  /// moved on with the solid.
  void set_patch(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s, const std::vector<char>& in_patch) {
    around_solid_.assign(in_patch.begin(), in_patch.begin() + K_f.n_rows());
    std::vector<long> number_f = patch_numbers(K_f, with_patch_of_setup(K_f.layout().communicator()));
    std::vector<long> number_s(K_s.layout().n_local(), -1);
    std::copy_n(number_f.begin(), K_f.n_rows(), number_s.begin());
    K_s.layout().update_ghosts(number_s.data());
    patch_ = pattern_of_patch(K_f, K_s, number_f, number_s);
    patch_matrix_ = BlockCsr<B>(patch_);
    place_f_ = places(K_f, number_f);
    place_s_ = places(K_s, number_s);
  }

  /// Collective. Solves from x = 0 until each block's residual is below target times its initial norm.
  SolverReport solve(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s, std::span<const double> b,
                     std::span<double> x, const SolveTarget& target) {
    gather_patch(K_f, K_s);
    patch_lu_.factor(patch_matrix_);
    const bool fresh = reuse_.due();
    if (fresh) renew(K_f);
    SolverReport report = run(K_f, K_s, b, x, target, fresh);
    if (!report.converged && !fresh) {
      std::fill(x.begin(), x.end(), 0.0);
      renew(K_f);
      report = run(K_f, K_s, b, x, target, true);
    }
    if (!report.converged && may_fall_back(K_f)) {
      std::fill(x.begin(), x.end(), 0.0);
      renew(K_f);
      report = run(K_f, K_s, b, x, target, true);
    }
    if (!report.converged) give_up();
    reuse_.record(report.iterations, report.decades());
    if (!report.converged) reuse_.invalidate();
    K_f.layout().update_ghosts(x.data(), B);
    return report;
  }

  /// Takes back what was decided for systems that led nowhere: LU in place of a block preconditioner that
  /// failed on them. Where Newton's method is far astray, that says nothing of the next step's.
  void give_up() {
    if (std::exchange(fell_back_, false)) options_.base = "auto", invalidate();
  }
  /// The fluid's set-up fits no longer (another time step).
  void invalidate() { reuse_.invalidate(); }
  [[nodiscard]] long patch_unknowns() const { return patch_ ? patch_->layout.n_global() * B : 0; }
  /// Who factors the patch.
  [[nodiscard]] std::string patch_method() const { return patch_lu_.method(); }
  /// Of the last solve.
  [[nodiscard]] const BlockCsr<B>& patch_matrix() const { return patch_matrix_; }
  [[nodiscard]] int setups() const { return n_setups_; }

 private:
  /// The owned nodes around the solid and those that were when the fluid was set up. Where there are too many
  /// of those the set-up is no longer worth keeping.
  std::vector<char> with_patch_of_setup(const Communicator& comm) {
    if (options_.growth <= 1.0 || reuse_.due()) return around_solid_;
    std::vector<char> all = around_solid_;
    double counts[2] = {};
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] |= at_setup_[i];
      counts[0] += around_solid_[i], counts[1] += all[i];
    }
    comm.sum_in_place(counts, 2);
    if (counts[1] <= options_.growth * counts[0]) return all;
    invalidate();
    return around_solid_;
  }

  /// Global number within the patch of each local node of K_f, -1 outside; also fills nodes_.
  std::vector<long> patch_numbers(const BlockCsr<B>& K_f, const std::vector<char>& in_patch) {
    nodes_.clear();
    for (int i = 0; i < K_f.n_rows(); ++i)
      if (in_patch[i]) nodes_.push_back(i);
    const long first = K_f.layout().communicator().exclusive_scan(static_cast<long>(nodes_.size()));
    std::vector<long> number(K_f.layout().n_local(), -1);
    for (std::size_t k = 0; k < nodes_.size(); ++k) number[nodes_[k]] = first + static_cast<long>(k);
    K_f.layout().update_ghosts(number.data());
    return number;
  }

  /// Rows of patch nodes, the union of both patterns within the patch.
  std::shared_ptr<const Pattern> pattern_of_patch(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s,
                                                  const std::vector<long>& number_f,
                                                  const std::vector<long>& number_s) {
    const long first = nodes_.empty() ? 0 : number_f[nodes_[0]];
    const long n_owned = static_cast<long>(nodes_.size());
    std::vector<std::vector<long>> rows;
    std::vector<long> ghosts;
    for (int node : nodes_) {
      std::vector<long>& row = rows.emplace_back();
      collect(K_f, node, number_f, row);
      collect(K_s, node, number_s, row);
      for (long c : row)
        if (c < first || c >= first + n_owned) ghosts.push_back(c);
    }
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    first_ = first, ghosts_ = ghosts;
    auto pattern = std::make_shared<Pattern>(
        Pattern{Layout(K_f.layout().communicator(), static_cast<int>(n_owned), ghosts), {0}, {}});
    for (std::vector<long>& row : rows) {
      std::vector<int> cols;
      for (long c : row) cols.push_back(local(c));
      std::sort(cols.begin(), cols.end());
      cols.erase(std::unique(cols.begin(), cols.end()), cols.end());
      pattern->cols.insert(pattern->cols.end(), cols.begin(), cols.end());
      pattern->row_ptr.push_back(pattern->n_blocks());
    }
    return pattern;
  }
  static void collect(const BlockCsr<B>& K, int node, const std::vector<long>& number,
                      std::vector<long>& row) {
    for (int k = K.row_ptr()[node]; k < K.row_ptr()[node + 1]; ++k)
      if (number[K.cols()[k]] >= 0) row.push_back(number[K.cols()[k]]);
  }
  /// Local index in the patch's layout of a patch number.
  [[nodiscard]] int local(long number) const {
    const long n_owned = static_cast<long>(nodes_.size());
    if (number >= first_ && number < first_ + n_owned) return static_cast<int>(number - first_);
    return static_cast<int>(n_owned +
                            (std::lower_bound(ghosts_.begin(), ghosts_.end(), number) - ghosts_.begin()));
  }

  /// (block of K, block of the patch matrix) for every entry of K within the patch.
  std::vector<std::pair<int, int>> places(const BlockCsr<B>& K, const std::vector<long>& number) const {
    std::vector<std::pair<int, int>> result;
    for (std::size_t r = 0; r < nodes_.size(); ++r)
      for (int k = K.row_ptr()[nodes_[r]]; k < K.row_ptr()[nodes_[r] + 1]; ++k)
        if (number[K.cols()[k]] >= 0)
          result.emplace_back(k, patch_->find(static_cast<int>(r), local(number[K.cols()[k]])));
    return result;
  }

  void gather_patch(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s) {
    patch_matrix_.set_zero();
    for (const auto& [from, to] : place_f_) add(K_f.at(from), patch_matrix_.at(to));
    for (const auto& [from, to] : place_s_) add(K_s.at(from), patch_matrix_.at(to));
  }
  static void add(const double* from, double* to) {
    for (int i = 0; i < B * B; ++i) to[i] += from[i];
  }

  /// Where the block preconditioner fails, LU of the fluid takes over, if the size allows, until it fails too
  /// or give_up() is called.
  bool may_fall_back(const BlockCsr<B>& K_f) {
    if (use_direct_ || options_.base != "auto" || !lu_is_affordable(B - 1, K_f.layout().n_global() * B))
      return false;
    options_.base = "direct";
    return fell_back_ = true;
  }

  void renew(const BlockCsr<B>& K_f) {
    ++n_setups_;
    at_setup_ = around_solid_;
    const SchurParts parts = options_.base == "direct" ? SchurParts{} : schur_();
    use_direct_ =
        options_.base == "direct" || (options_.base == "auto" && choose_method(K_f, parts, true).direct);
    if (use_direct_) {
      fluid_lu_.factor(K_f, options_.enclosed ? B - 1 : -1);
      reuse_.renewed(fluid_lu_.setup_cost());
    } else {
      saddle_.update(K_f, parts);
      reuse_.renewed(saddle_.setup_cost());
    }
  }

  /// y = (K_f + K_s) x.
  void product(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s, double* x, double* y) {
    K_f.apply(x, y);
    wide_.assign(static_cast<std::size_t>(K_s.layout().n_local()) * B, 0.0);
    std::copy_n(x, static_cast<std::size_t>(K_f.n_rows()) * B, wide_.begin());
    sum_.resize(static_cast<std::size_t>(K_f.n_rows()) * B);
    K_s.apply(wide_.data(), sum_.data());
    for (std::size_t i = 0; i < sum_.size(); ++i) y[i] += sum_[i];
  }

  /// z += P^T K_patch^-1 P r.
  void add_patch(const double* r, double* z) {
    const std::size_t n = static_cast<std::size_t>(patch_->layout.n_local()) * B;
    patch_r_.assign(n, 0.0), patch_z_.assign(n, 0.0);
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      std::copy_n(r + static_cast<std::size_t>(nodes_[k]) * B, B, &patch_r_[k * B]);
    patch_lu_.apply(patch_r_.data(), patch_z_.data());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      for (int i = 0; i < B; ++i) z[static_cast<std::size_t>(nodes_[k]) * B + i] += patch_z_[k * B + i];
  }

  /// r - (K_f + K_s) z into rest_.
  const double* remainder(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s, const double* r, double* z) {
    rest_.resize(static_cast<std::size_t>(K_f.layout().n_local()) * B);
    product(K_f, K_s, z, rest_.data());
    for (int i = 0; i < K_f.n_rows() * B; ++i) rest_[i] = r[i] - rest_[i];
    return rest_.data();
  }

  void precondition(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s, double* r, double* z) {
    const std::size_t n = static_cast<std::size_t>(K_f.layout().n_local()) * B;
    if (use_direct_) {
      fluid_lu_.apply(r, z);
    } else {
      std::fill_n(z, n, 0.0);
      add_patch(r, z);
      fluid_z_.assign(n, 0.0);
      saddle_.apply(remainder(K_f, K_s, r, z), fluid_z_.data());
      for (std::size_t i = 0; i < n; ++i) z[i] += fluid_z_[i];
    }
    add_patch(remainder(K_f, K_s, r, z), z);
  }

  SolverReport run(const BlockCsr<B>& K_f, const BlockCsr<B>& K_s, std::span<const double> b,
                   std::span<double> x, const SolveTarget& target, bool fresh) {
    GmresOptions gmres;
    gmres.target = target;
    gmres.max_iterations = fresh ? options_.max_iterations : reuse_.patience(3.0);
    gmres.mass_component = B - 1;
    return fgmres(
        K_f.layout(), B, [&](double* in, double* out) { product(K_f, K_s, in, out); },
        [&](double* r, double* z) { precondition(K_f, K_s, r, z); }, b.data(), x.data(), gmres);
  }

  PatchedSolverOptions options_;
  SchurProvider schur_;
  bool use_direct_ = true, fell_back_ = false;
  int n_setups_ = 0;
  DirectSolver fluid_lu_, patch_lu_{B == 4 ? DirectSolver::Work::shared : DirectSolver::Work::on_root};
  SaddlePreconditioner<B> saddle_;
  ReusePolicy reuse_;
  std::vector<char> around_solid_, at_setup_;  ///< per owned node: now, and when the fluid was set up
  std::vector<int> nodes_;                     ///< owned nodes of the patch
  std::vector<long> ghosts_;                   ///< patch numbers of others' nodes
  long first_ = 0;
  std::shared_ptr<const Pattern> patch_;
  BlockCsr<B> patch_matrix_;
  std::vector<std::pair<int, int>> place_f_, place_s_;
  std::vector<double> wide_, sum_, patch_r_, patch_z_, rest_, fluid_z_;
};

}  // namespace ifsi
