#include "ifsi/linalg/saddle_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/amg.hpp"
#include "ifsi/linalg/extract.hpp"
#include "ifsi/linalg/flush_denormals.hpp"
#include "ifsi/linalg/ilu.hpp"

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
    update_velocity(K);
    update_gradient(K);
    update_schur(K, parts);
    z_p_.assign(pattern_->layout.n_local(), 0.0);
    r_p_.resize(K.n_rows());
    transported_.assign(K.n_rows(), 0.0);
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
           "); pressure: " + (schur_.ready() ? schur_.description() : "mass matrix");
  }

  /// Measured on Q1 meshes: AMG on the velocity block costs about as much to build as twelve iterations.
  [[nodiscard]] double setup_cost() const { return std::holds_alternative<Amg>(velocity_) ? 12 : 6; }

 private:
  /// Largest viscous number at which ILU(0) is the faster solver and stays within 25 iterations.
  static constexpr double viscous_limit = dim == 2 ? 0.7 : 1.0;
  static AmgOptions amg_options() { return {.strong_threshold = dim == 2 ? 0.25 : 0.5}; }
  /// Aggressive coarsening doubles the iterations where grad-div couples the components.
  static AmgOptions velocity_amg_options() {
    return {.strong_threshold = dim == 2 ? 0.25 : 0.5, .aggressive_levels = 0, .nodal = true};
  }

  void update_velocity(const BlockCsr<B>& K) {
    const bool mass_dominates = viscous_number_ <= viscous_limit;
    if (options_.velocity == "amg" || (options_.velocity == "auto" && !mass_dominates)) {
      velocity_.template emplace<Amg>(velocity_amg_options()).setup(extract_diagonal_part<dim>(K, 0));
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
    convection_ = parts.convection;
    has_convection_ = convection_.shared_pattern() != nullptr;
    BlockCsr<1> N = parts.laplacian;
    set_local_factors(K, parts);
    if (steady_ && !has_convection_) return;
    add_outlet_terms(K, N);
    // A spring on one pressure makes N regular and changes its solution by a constant only.
    if (options_.enclosed && pattern_->layout.first_global() == 0 && N.n_rows() > 0) *N.at(N.find(0, 0)) *= 2;
    schur_.setup(N);
  }

  /// M^-1 and (1 - tau_M c) M^-1. The PSPG block is tau_M / rho times the Laplacian, N is 1 / (rho c) times:
  /// tau_M c is the ratio of their diagonals.
  void set_local_factors(const BlockCsr<B>& K, const SchurParts& parts) {
    inverse_mass_.resize(parts.mass.size());
    local_factor_.resize(parts.mass.size());
    for (int i = 0; i < K.n_rows(); ++i) {
      const int diagonal = K.find(i, i);
      const double tau_c = steady_ ? 0.0 : K.at(diagonal)[B * B - 1] / *parts.laplacian.at(diagonal);
      inverse_mass_[i] = 1 / parts.mass[i];
      local_factor_[i] = inverse_mass_[i] * std::max(0.0, 1 - tau_c);
    }
  }

  /// D A^-1 G of the constant pressure is not zero where velocity is free on a boundary: (G 1)_i = -int N_i n
  /// dA there. The Laplacian alone would let constants float, which costs an iteration count that grows with
  /// the mesh. A Robin term as large as the Laplacian's own diagonal has the same scaling, 1 / (rho c h) dA.
  void add_outlet_terms(const BlockCsr<B>& K, BlockCsr<1>& N) const {
    for (int i = 0; i < K.n_rows(); ++i) {
      double constant[dim] = {}, size = 0;
      for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k)
        for (int c = 0; c < dim; ++c) {
          constant[c] += K.at(k)[c * B + dim];
          size += std::abs(K.at(k)[c * B + dim]);
        }
      double outflow = 0;
      for (double t : constant) outflow += std::abs(t);
      if (outflow > 1e-6 * size) *N.at(N.find(i, i)) *= 2;
    }
  }

  /// z_p = S^-1 r_p, ghosts included.
  void apply_schur(const double* r) {
    const int n = pattern_->n_rows();
    for (int i = 0; i < n; ++i) r_p_[i] = r[i * long{B} + dim];
    if (!steady_ || has_convection_) schur_.apply(r_p_.data(), z_p_.data());
    if (has_convection_) convection_.apply(z_p_.data(), transported_.data());
    if (steady_) std::fill(z_p_.begin(), z_p_.end(), 0.0);
    for (int i = 0; i < n; ++i) z_p_[i] += local_factor_[i] * r_p_[i] + inverse_mass_[i] * transported_[i];
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
  std::shared_ptr<const Pattern> pattern_;
  double viscous_number_ = 0;
  std::variant<BlockIlu<dim>, BlockGaussSeidel<dim>, Amg> velocity_;
  AlignedVector<float> gradient_;  ///< G: dim numbers per block of the pattern
  Amg schur_;
  BlockCsr<1> convection_;
  bool steady_ = false, has_convection_ = false;
  std::vector<double> inverse_mass_, local_factor_;
  std::vector<double> r_p_, z_p_, transported_, wide_b_, wide_x_;
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
