#include "ifsi/linalg/gmres.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "ifsi/core/error.hpp"

namespace ifsi {
namespace {

using Array = AlignedVector<double>;

/// Entries worked on together, so that a vector stays in the first-level cache while all basis vectors pass.
constexpr long chunk = 1024;

double dot(const double* x, const double* y, long n) {
  constexpr int lanes = 32;  // enough that no addition waits for another
  double sum[lanes] = {};
  long i = 0;
  for (; i + lanes <= n; i += lanes)
    for (int l = 0; l < lanes; ++l) sum[l] += x[i + l] * y[i + l];
  for (; i < n; ++i) sum[0] += x[i] * y[i];
  for (int half = lanes / 2; half > 0; half /= 2)
    for (int l = 0; l < half; ++l) sum[l] += sum[l + half];
  return sum[0];
}

/// One solve: Krylov basis V, preconditioned directions Z, and the small least-squares problem R y = g.
/// B is the number of unknowns per node where that is known to the compiler, else 0.
template <int B>
class Fgmres {
 public:
  Fgmres(const Layout& layout, int block, const LinearMap& A, const LinearMap& P, const GmresOptions& options,
         GmresWorkspace& space)
      : comm_(layout.communicator()),
        A_(A),
        P_(P),
        options_(options),
        block_(block),
        n_(static_cast<long>(layout.n_owned()) * block),
        n_local_(static_cast<long>(layout.n_local()) * block),
        residual_(space.residual),
        work_(space.work),
        V_(space.basis),
        Z_(space.directions) {
    residual_.resize(n_local_);
    work_.resize(n_local_);
  }

  SolverReport solve(const double* b, double* x) {
    if (is_zero(x))
      std::copy_n(b, n_, residual_.begin());
    else
      compute_residual(b, x);
    report_.initial = norms(residual_.data());
    set_target();
    update_report(report_.initial);
    while (!report_.converged && report_.iterations < options_.max_iterations) {
      const bool stuck = cycle(x);
      compute_residual(b, x);
      update_report(norms(residual_.data()));
      if (stuck) break;
    }
    if (!report_.converged) explain();
    return report_;
  }

 private:
  [[nodiscard]] int block() const { return B > 0 ? B : block_; }

  /// visit(i, c) for every owned number i, which is component c of its node.
  template <class Visit>
  void for_each_entry(Visit&& visit) const {
    for (long i = 0; i < n_; i += block())
      for (int c = 0; c < block(); ++c) visit(i + c, c);
  }

  void compute_residual(const double* b, double* x) {
    A_(x, residual_.data());
    for (long i = 0; i < n_; ++i) residual_[i] = b[i] - residual_[i];
  }

  [[nodiscard]] BlockNorms norms(const double* r) const {
    std::vector<double> squares(block(), 0.0);
    for_each_entry([&](long i, int c) { squares[c] += r[i] * r[i]; });
    double sums[2] = {0, 0};
    for (int c = 0; c < block(); ++c) sums[c == options_.mass_component] += squares[c];
    comm_.sum_in_place(sums, 2);
    if (!std::isfinite(sums[0] + sums[1]))
      throw Error(
          ExitCode::linear_solver,
          "GMRES: NaN or infinity in the residual; expected finite numbers in matrix, right-hand side "
          "and start");
    return {std::sqrt(sums[0]), std::sqrt(sums[1])};
  }

  [[nodiscard]] bool is_zero(const double* x) const {
    return !comm_.any(std::any_of(x, x + n_, [](double value) { return value != 0; }));
  }

  /// A target of zero is never met; the smallest number keeps the division by it defined.
  void set_target() {
    constexpr double floor = 1e-3, tiny = 1e-300;
    const SolveTarget& goal = options_.target;
    const BlockNorms& r = report_.initial;
    const double momentum = std::max(r.momentum, floor * r.mass / options_.mass_per_momentum);
    const double mass = std::max(r.mass, floor * r.momentum * options_.mass_per_momentum);
    report_.target = {std::max(goal.relative.momentum * momentum, goal.absolute.momentum),
                      std::max(goal.relative.mass * mass, goal.absolute.mass)};
    reference_.assign(block(), std::max(report_.target.momentum, tiny));
    if (options_.mass_component >= 0)
      reference_[options_.mass_component] = std::max(report_.target.mass, tiny);
  }

  void update_report(BlockNorms r) {
    report_.residual = r;
    report_.converged = r.momentum <= report_.target.momentum && r.mass <= report_.target.mass;
  }

  void explain() {
    const auto part = [](double now, double start, double target) {
      std::ostringstream text;
      text << start << " -> " << now << " (target " << target << ')';
      return text.str();
    };
    report_.message = "GMRES stopped after " + std::to_string(report_.iterations) + " iterations, momentum " +
                      part(report_.residual.momentum, report_.initial.momentum, report_.target.momentum) +
                      ", mass " + part(report_.residual.mass, report_.initial.mass, report_.target.mass);
    if (not_finite_) report_.message += ": NaN or infinity from the preconditioner or the matrix";
  }

  /// One restart cycle: improves x from residual_. True when the Krylov space cannot grow any further.
  bool cycle(double* x) {
    const int m = std::min(options_.restart, options_.max_iterations - report_.iterations);
    R_.clear();
    rotations_.clear();
    for_each_entry([&](long i, int c) { residual_[i] /= reference_[c]; });
    g_.assign(1, std::sqrt(sum_of_squares(residual_)));
    Array& v = entry(V_, 0);
    for (long i = 0; i < n_; ++i) v[i] = residual_[i] / g_[0];
    bool stuck = false, done = false;
    while (static_cast<int>(R_.size()) < m && !done && !stuck) {
      stuck = !extend();
      done = on_target();
    }
    add_correction(x);
    return stuck;
  }

  [[nodiscard]] double sum_of_squares(const Array& x) const { return comm_.sum(dot(x.data(), x.data(), n_)); }

  /// Vector k of a list that grows by one.
  Array& entry(std::vector<Array>& list, int k) const {
    if (static_cast<int>(list.size()) <= k) list.emplace_back();
    list[k].resize(n_local_);
    return list[k];
  }

  /// One step of the Arnoldi process: direction z = P v, new basis vector from A z. False on breakdown. A
  /// direction with numbers that are not finite is left out: the caller may have a better preconditioner.
  bool extend() {
    const int k = static_cast<int>(R_.size());
    Array &z = entry(Z_, k), &next = entry(V_, k + 1);
    const Array& v = V_[k];
    // Any scale of z_k will do; numbers near one suit preconditioners in single precision.
    const double largest = *std::max_element(reference_.begin(), reference_.end());
    std::vector<double> in(reference_), out(reference_);
    for (double& factor : in) factor /= largest;
    for (double& factor : out) factor = 1 / factor;
    for_each_entry([&](long i, int c) { work_[i] = v[i] * in[c]; });
    P_(work_.data(), z.data());
    A_(z.data(), work_.data());
    for_each_entry([&](long i, int c) { work_[i] *= out[c]; });
    ++report_.iterations;
    std::vector<double> h(k + 2, 0.0);
    const bool independent = orthogonalise(k + 1, h, next);
    if (not_finite_) return false;
    rotate(h);
    R_.push_back(std::move(h));
    return independent;
  }

  /// Removes the parts of work_ along V_0 .. V_{m-1}, collected in h; h[m] is what remains of its norm, and
  /// `next` is work_ over that. A pass that loses more than half the length is repeated ("twice is enough").
  /// False when nothing remains, or when work_ is not finite.
  bool orthogonalise(int m, std::vector<double>& h, Array& next) {
    std::vector<double> part(m + 1);
    double before = 0;
    for (int pass = 0; pass < 3; ++pass) {
      project(m, part);
      comm_.sum_in_place(part.data(), m + 1);
      const double squared = part[m];
      not_finite_ = !std::isfinite(squared);
      if (not_finite_) return false;
      double left = squared;
      for (int j = 0; j < m; ++j) {
        left -= part[j] * part[j];
        h[j] += part[j];
      }
      h[m] = std::sqrt(std::max(left, 0.0));
      if (pass == 0) before = std::sqrt(squared);
      if (left > 0.25 * squared || squared == 0 || pass == 2) break;
      subtract(m, part, 1, work_);
    }
    const bool independent = h[m] > 1e-14 * before;
    if (!independent) h[m] = 0;
    subtract(m, part, independent ? 1 / h[m] : 0.0, next);
    return independent;
  }

  /// part[j] = V_j . work_ for j < m, part[m] = work_ . work_, on this rank.
  void project(int m, std::vector<double>& part) const {
    std::fill(part.begin(), part.end(), 0.0);
    for (long i = 0; i < n_; i += chunk) {
      const long size = std::min(chunk, n_ - i);
      for (int j = 0; j < m; ++j) part[j] += dot(&V_[j][i], &work_[i], size);
      part[m] += dot(&work_[i], &work_[i], size);
    }
  }

  /// y = scale (work_ - sum_j part[j] V_j); y may be work_.
  void subtract(int m, const std::vector<double>& part, double scale, Array& y) {
    for (long i = 0; i < n_; i += chunk) {
      const long end = std::min(i + chunk, n_);
      for (int j = 0; j < m; ++j)
        for (long l = i; l < end; ++l) work_[l] -= part[j] * V_[j][l];
      for (long l = i; l < end; ++l) y[l] = scale * work_[l];
    }
  }

  /// Applies the old Givens rotations to column h, and a new one that clears its last entry.
  void rotate(std::vector<double>& h) {
    const int k = static_cast<int>(rotations_.size());
    for (int j = 0; j < k; ++j) {
      const auto [c, s] = rotations_[j];
      const double t = c * h[j] + s * h[j + 1];
      h[j + 1] = -s * h[j] + c * h[j + 1];
      h[j] = t;
    }
    const double length = std::hypot(h[k], h[k + 1]);
    const Rotation r = length > 0 ? Rotation{h[k] / length, h[k + 1] / length} : Rotation{0, 1};
    h[k] = length;
    g_.push_back(-r.s * g_[k]);
    g_[k] *= r.c;
    rotations_.push_back(r);
  }

  /// Whether both blocks of equations are. Divided by their targets they make |g_{k+1}| together, so that
  /// they need to be told apart only while that is between 1 and sqrt 2.
  [[nodiscard]] bool on_target() {
    const double g = std::abs(g_.back());
    if (g <= 1 || g * g > 2) return g <= 1;
    const BlockNorms q = direction_norms();
    const bool one_block = options_.mass_component < 0;
    return g * q.momentum <= 1 && (one_block || g * q.mass <= 1);
  }

  /// Block norms of the direction of the residual, q_{k+1} with q_0 = v_0, q_{k+1} = -s_k q_k + c_k v_{k+1}.
  [[nodiscard]] BlockNorms direction_norms() {
    const int m = static_cast<int>(rotations_.size());
    std::vector<double> factors(m + 1, 1.0);
    for (int k = 0; k < m; ++k) {
      for (int j = 0; j <= k; ++j) factors[j] *= -rotations_[k].s;
      factors[k + 1] = rotations_[k].c;
    }
    std::fill_n(residual_.begin(), n_, 0.0);
    for (int j = 0; j <= m; ++j)
      for (long i = 0; i < n_; ++i) residual_[i] += factors[j] * V_[j][i];
    return norms(residual_.data());
  }

  /// x += Z y with R y = g. A zero pivot (singular A on the space) contributes nothing.
  void add_correction(double* x) {
    const int k = static_cast<int>(R_.size());
    std::vector<double> y(k);
    for (int i = k - 1; i >= 0; --i) {
      double sum = g_[i];
      for (int j = i + 1; j < k; ++j) sum -= R_[j][i] * y[j];
      y[i] = R_[i][i] != 0 ? sum / R_[i][i] : 0.0;
    }
    for (long i = 0; i < n_; i += chunk)
      for (int j = 0; j < k; ++j)
        for (long l = i, end = std::min(i + chunk, n_); l < end; ++l) x[l] += y[j] * Z_[j][l];
  }

  struct Rotation {
    double c, s;
  };

  Communicator comm_;
  const LinearMap& A_;
  const LinearMap& P_;
  GmresOptions options_;
  int block_;
  long n_, n_local_;
  Array& residual_;  ///< b - A x between cycles
  Array& work_;
  std::vector<Array>&V_, &Z_;
  std::vector<std::vector<double>> R_;  ///< columns of the Hessenberg matrix, rotated to triangular form
  std::vector<double> g_;
  std::vector<Rotation> rotations_;
  std::vector<double> reference_;  ///< per component of the block
  bool not_finite_ = false;        ///< the last direction
  SolverReport report_;
};

}  // namespace

double SolverReport::decades() const {
  const auto distance = [](double start, double goal) {
    return start > goal ? std::log10(start / goal) : 0.0;
  };
  return std::max(distance(initial.momentum, target.momentum), distance(initial.mass, target.mass));
}

SolverReport fgmres(const Layout& layout, int block, const LinearMap& A, const LinearMap& preconditioner,
                    const double* b, double* x, const GmresOptions& options, GmresWorkspace* workspace) {
  GmresWorkspace own;
  GmresWorkspace& space = workspace ? *workspace : own;
  switch (block) {
    case 3:
      return Fgmres<3>(layout, block, A, preconditioner, options, space).solve(b, x);
    case 4:
      return Fgmres<4>(layout, block, A, preconditioner, options, space).solve(b, x);
    default:
      return Fgmres<0>(layout, block, A, preconditioner, options, space).solve(b, x);
  }
}

}  // namespace ifsi
