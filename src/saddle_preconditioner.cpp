#include "ifsi/linalg/saddle_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <variant>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/amg.hpp"
#include "ifsi/linalg/direct.hpp"
#include "ifsi/linalg/extract.hpp"
#include "ifsi/linalg/flush_denormals.hpp"
#include "ifsi/linalg/ilu.hpp"
static double env(const char* n, double d) {
  const char* e = getenv(n);
  return e ? atof(e) : d;
}

namespace ifsi {

template <int B>
class SaddlePreconditioner<B>::Impl {
 public:
  explicit Impl(SaddleOptions options) : options_(std::move(options)), schur_(amg_options()) {
    for (const char* known : {"auto", "ilu", "gauss_seidel", "amg"})
      if (options_.velocity == known) return;
    throw Error(ExitCode::configuration, "preconditioner: unknown velocity solver \"" + options_.velocity +
                                             "\"; expected auto, ilu, gauss_seidel or amg");
  }

  void update(const BlockCsr<B>& K, const SchurParts& parts) {
    if (parts.laplacian.shared_pattern() != K.shared_pattern() ||
        parts.mass.size() != static_cast<std::size_t>(K.n_rows()))
      throw Error(ExitCode::linear_solver,
                  "preconditioner: the Schur parts do not have the pattern of the matrix");
    pattern_ = K.shared_pattern();
    viscous_number_ = parts.viscous_number;
    if (env("XV", 0) > 0) {
      A_ = extract_diagonal_part<dim>(K, 0);
      exact_.factor(A_);
    }
    update_velocity(K);
    update_gradient(K);
    update_schur(K, parts);
    z_p_.assign(pattern_->layout.n_local(), 0.0);
    r_p_.resize(K.n_rows());
    r_v_.resize(static_cast<std::size_t>(K.n_rows()) * dim);
    z_v_.resize(r_v_.size());
  }

  void apply(const double* r, double* z) {
    const FlushDenormals guard;
    apply_schur(r);
    subtract_gradient(r);
    apply_velocity();
    for (int i = 0; i < pattern_->n_rows(); ++i) {
      for (int c = 0; c < dim; ++c) z[i * long{B} + c] = z_v_[i * long{dim} + c];
      z[i * long{B} + dim] = z_p_[i];
    }
  }

  [[nodiscard]] std::string description() const {
    std::string text = "velocity: ";
    if (const auto* amg = std::get_if<Amg>(&velocity_)) text += amg->description();
    if (std::holds_alternative<BlockIlu<dim>>(velocity_)) text += "ILU(0)";
    if (std::holds_alternative<BlockGaussSeidel<dim>>(velocity_)) text += "Gauss-Seidel";
    return text + " (viscous number " + std::to_string(viscous_number_) +
           "); pressure: " + (has_inertia_ ? schur_.description() : "mass matrix");
  }

  /// Measured on Q1 meshes: AMG on the velocity block costs about as much to build as twelve iterations.
  [[nodiscard]] double setup_cost() const { return std::holds_alternative<Amg>(velocity_) ? 12 : 6; }

 private:
  static AmgOptions amg_options() { return {.strong_threshold = dim == 2 ? 0.25 : 0.5}; }

  void update_velocity(const BlockCsr<B>& K) {
    const bool mass_dominates = viscous_number_ <= options_.viscous_limit;
    if (options_.velocity == "amg" || (options_.velocity == "auto" && !mass_dominates)) {
      velocity_.template emplace<Amg>(amg_options()).setup(extract_diagonal_part<dim>(K, 0));
    } else if (options_.velocity == "gauss_seidel") {
      velocity_.template emplace<BlockGaussSeidel<dim>>().update(K);
    } else {
      velocity_.template emplace<BlockIlu<dim>>().update(K);
    }
  }

  void update_gradient(const BlockCsr<B>& K) {
    gradient_.resize(static_cast<std::size_t>(pattern_->n_blocks()) * dim);
    for (int k = 0; k < pattern_->n_blocks(); ++k)
      for (int c = 0; c < dim; ++c)
        gradient_[k * std::size_t{dim} + c] = static_cast<float>(K.at(k)[c * B + dim]);
  }

  void update_schur(const BlockCsr<B>& K, const SchurParts& parts) {
    steady_ = parts.steady;
    C_ = parts.convection;
    W_ = extract_diagonal_part<1>(K, dim);
    const double mode = env("XS", 1);
    BlockCsr<1> S = W_;
    if (mode >= 2 || steady_) S.set_zero();
    keep_.assign(K.n_rows(), 1.0);
    std::vector<double> theta(pattern_->layout.n_local(), 1.0);
    for (int i = 0; i < K.n_rows(); ++i) {
      const double l = *W_.at(W_.find(i, i)), n = *parts.laplacian.at(W_.find(i, i));
      const double sigma = steady_ ? 0.0 : l / n;
      theta[i] = 1 + sigma;
      if (mode == 2) keep_[i] = std::max(0.05, 1 - sigma);
    }
    pattern_->layout.update_ghosts(theta.data());
    for (int i = 0; i < K.n_rows(); ++i) {
      if (mode == 0) {
        for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k) *W_.at(k) = 0;
      }
      if (mode == 1) {
        for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k)
          *W_.at(k) *= std::sqrt(theta[i] * theta[K.cols()[k]]);
      }
      *W_.at(W_.find(i, i)) += parts.mass[i] * (mode == 1 ? theta[i] * theta[i] : 1.0);
    }
    local_.update(W_);
    has_inertia_ = true;
    for (std::size_t k = 0; k < S.values.size(); ++k) S.values[k] += parts.laplacian.values[k];
    add_outlet_terms(K, parts, S);
    if (options_.enclosed && pattern_->layout.first_global() == 0 && S.n_rows() > 0) *S.at(S.find(0, 0)) *= 2;
    schur_.setup(S);
  }

  /// D A^-1 G of the constant pressure is not zero where velocity is free on a boundary: (G 1)_i = -int N_i n
  /// dA there. The Laplacian alone would let constants float, which costs an iteration count that grows with
  /// the mesh. A Robin term as large as the Laplacian's own diagonal has the same scaling, 1 / (rho c h) dA.
  void add_outlet_terms(const BlockCsr<B>& K, const SchurParts& parts, BlockCsr<1>& S) const {
    for (int i = 0; i < K.n_rows(); ++i) {
      double constant[dim] = {}, size = 0;
      for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k)
        for (int c = 0; c < dim; ++c) {
          constant[c] += K.at(k)[c * B + dim];
          size += std::abs(K.at(k)[c * B + dim]);
        }
      double outflow = 0;
      for (double t : constant) outflow += std::abs(t);
      if (outflow > 1e-6 * size) *S.at(S.find(i, i)) += *parts.laplacian.at(S.find(i, i));
    }
  }

  /// z_p = M^-1 r_p + [L + N]^-1 r_p, ghosts included.
  void apply_schur(const double* r) {
    const int n = pattern_->n_rows();
    const double convect = env("XC", 0);
    for (int i = 0; i < n; ++i) r_p_[i] = r[i * long{B} + dim];
    schur_.apply(r_p_.data(), z_p_.data());
    cz_.assign(z_p_.size(), 0.0);
    f_.resize(n);
    if (convect > 0) C_.apply(z_p_.data(), cz_.data());
    for (int i = 0; i < n; ++i) f_[i] = static_cast<float>(keep_[i] * r_p_[i] + convect * cz_[i]);
    local_.apply(f_.data(), f_.data());
    if (steady_) std::fill(z_p_.begin(), z_p_.end(), 0.0);
    for (int i = 0; i < n; ++i) z_p_[i] += f_[i];
    pattern_->layout.update_ghosts(z_p_.data());
  }

  /// r_v = r_v - G z_p
  void subtract_gradient(const double* r) {
    for (int i = 0; i < pattern_->n_rows(); ++i) {
      float sum[dim] = {};
      for (int k = pattern_->row_ptr[i]; k < pattern_->row_ptr[i + 1]; ++k) {
        const float p = static_cast<float>(z_p_[pattern_->cols[k]]);
        for (int c = 0; c < dim; ++c) sum[c] += gradient_[k * std::size_t{dim} + c] * p;
      }
      for (int c = 0; c < dim; ++c)
        r_v_[i * std::size_t{dim} + c] = static_cast<float>(r[i * long{B} + c]) - sum[c];
    }
  }

  /// z_v = A^-1 r_v
  void apply_velocity() {
    if (env("XV", 0) > 0) {
      wide_b_.assign(r_v_.begin(), r_v_.end());
      wide_x_.resize(wide_b_.size());
      exact_.apply(wide_b_.data(), wide_x_.data());
      for (std::size_t i = 0; i < wide_x_.size(); ++i) z_v_[i] = static_cast<float>(wide_x_[i]);
      return;
    }
    if (const auto* amg = std::get_if<Amg>(&velocity_)) {
      wide_b_.assign(r_v_.begin(), r_v_.end());
      wide_x_.resize(wide_b_.size());
      amg->apply(wide_b_.data(), wide_x_.data());
      for (std::size_t i = 0; i < wide_x_.size(); ++i) z_v_[i] = static_cast<float>(wide_x_[i]);
    } else if (const auto* ilu = std::get_if<BlockIlu<dim>>(&velocity_)) {
      ilu->apply(r_v_.data(), z_v_.data());
    } else {
      std::get<BlockGaussSeidel<dim>>(velocity_).apply(r_v_.data(), z_v_.data());
    }
  }

  SaddleOptions options_;
  BlockCsr<dim> A_;
  DirectSolver exact_;
  BlockCsr<1> C_, W_;
  BlockIlu<1> local_;
  std::vector<float> f_;
  std::vector<double> cz_, keep_;
  bool steady_ = false;
  std::shared_ptr<const Pattern> pattern_;
  double viscous_number_ = 0;
  std::variant<BlockIlu<dim>, BlockGaussSeidel<dim>, Amg> velocity_;
  AlignedVector<float> gradient_;  ///< G: dim numbers per block of the pattern
  Amg schur_;
  bool has_inertia_ = true;  ///< false in steady flow: no Laplacian part
  std::vector<double> inverse_mass_;
  std::vector<double> r_p_, z_p_, wide_b_, wide_x_;
  AlignedVector<float> r_v_, z_v_;
};

template <int B>
SaddlePreconditioner<B>::SaddlePreconditioner(SaddleOptions options)
    : impl_(std::make_unique<Impl>(std::move(options))) {}
template <int B>
SaddlePreconditioner<B>::~SaddlePreconditioner() = default;
template <int B>
SaddlePreconditioner<B>::SaddlePreconditioner(SaddlePreconditioner&&) noexcept = default;
template <int B>
SaddlePreconditioner<B>& SaddlePreconditioner<B>::operator=(SaddlePreconditioner&&) noexcept = default;
template <int B>
void SaddlePreconditioner<B>::update(const BlockCsr<B>& K, const SchurParts& parts) {
  impl_->update(K, parts);
}
template <int B>
void SaddlePreconditioner<B>::apply(const double* r, double* z) {
  impl_->apply(r, z);
}
template <int B>
std::string SaddlePreconditioner<B>::description() const {
  return impl_->description();
}
template <int B>
double SaddlePreconditioner<B>::setup_cost() const {
  return impl_->setup_cost();
}

template class SaddlePreconditioner<3>;
template class SaddlePreconditioner<4>;

}  // namespace ifsi
