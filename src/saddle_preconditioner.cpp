#include "ifsi/linalg/saddle_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <variant>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/amg.hpp"
#include "ifsi/linalg/extract.hpp"
#include "ifsi/linalg/flush_denormals.hpp"
#include "ifsi/linalg/gauss_seidel.hpp"
#include "ifsi/linalg/ilu.hpp"

namespace ifsi {

FlowNumbers flow_numbers(const SchurParts& parts) {
  FlowNumbers numbers{.viscous = parts.viscous_number, .bulk = parts.bulk_number, .order = parts.order};
  if (!parts.convection.shared_pattern()) return numbers;
  double sums[2] = {0, 0};
  for (double value : parts.convection.values) sums[0] += std::abs(value);
  for (double value : parts.mass.values) sums[1] += value;
  parts.mass.layout().communicator().sum_in_place(sums, 2);
  numbers.transport = sums[0] / sums[1];
  return numbers;
}

template <int B>
class SaddlePreconditioner<B>::Impl {
 public:
  explicit Impl(SaddleOptions options) : options_(std::move(options)) {
    for (const char* known : {"auto", "ilu", "gauss_seidel", "amg"})
      if (options_.velocity == known) return;
    throw Error(ExitCode::configuration, "preconditioner: unknown velocity solver \"" + options_.velocity +
                                             "\"; expected auto, ilu, gauss_seidel or amg");
  }

  void update(const BlockCsr<B>& K, const SchurParts& parts) {
    if (parts.laplacian.shared_pattern() != K.shared_pattern() ||
        parts.mass.shared_pattern() != K.shared_pattern())
      throw Error(ExitCode::linear_solver,
                  "preconditioner: the Schur parts do not have the pattern of the matrix");
    pattern_ = K.shared_pattern();
    flow_ = flow_numbers(parts);
    steady_ = parts.steady;
    convection_ = parts.convection;
    has_convection_ = convection_.shared_pattern() != nullptr;
    crosses_cells_ = flow_.transport > 1;
    update_velocity(K);
    update_gradient(K);
    update_schur(K, parts);
    z_p_.assign(pattern_->layout.n_local(), 0.0);
    potential_ = z_p_;
    r_p_.resize(K.n_rows());
    local_.resize(pattern_->layout.n_local());
    transported_.assign(K.n_rows(), 0.0);
    r_v_.resize(static_cast<std::size_t>(pattern_->layout.n_local()) * dim);
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
    if (const auto* refined = std::get_if<RefinedIlu<dim>>(&velocity_))
      text += "ILU(0) " + std::to_string(refined->passes()) + " times";
    if (const auto* sweeps = std::get_if<GaussSeidel<dim>>(&velocity_))
      text += "Gauss-Seidel, passes: " + std::to_string(sweeps->passes());
    text += " (viscous number " + std::to_string(flow_.viscous) + "); pressure: ILU(0) of mass and PSPG";
    if (inertia_.ready()) text += ", inertia by " + inertia_.description();
    if (transport_.ready()) text += ", transport by " + transport_.description();
    return text;
  }

  /// Measured with Q1 cells in the plane and in space: 10 to 17 iterations with AMG, 7 to 12 with ILU(0).
  [[nodiscard]] double setup_cost() const { return std::holds_alternative<Amg>(velocity_) ? 12 : 8; }

 private:
  static AmgOptions amg_options() { return {.strong_threshold = dim == 2 ? 0.25 : 0.5}; }
  /// Aggressive coarsening doubles the iterations where grad-div couples the components. One V-cycle
  /// is what would limit the iterations: in the plane a second one pays, in space with time steps a W-cycle.
  /// Coarsening by nodes saves a quarter of the time with multilinear cells; the nodes of a cell of order 2
  /// differ too much: quad2, Re 1, steady takes 27 iterations with it and 16 without.
  [[nodiscard]] AmgOptions velocity_amg_options() const {
    return {.strong_threshold = dim == 2 ? 0.25 : 0.5,
            .aggressive_levels = 0,
            .cycles = dim == 2 ? 2 : 1,
            .w_cycle = dim == 3 && !steady_,
            .nodal = flow_.order == 1};
  }

  void update_velocity(const BlockCsr<B>& K) {
    const std::string solver = options_.velocity == "auto" ? suitable_velocity_solver() : options_.velocity;
    if (solver == "amg") {
      velocity_.template emplace<Amg>(velocity_amg_options()).setup(extract_diagonal_part<dim>(K, 0));
    } else if (solver == "gauss_seidel") {
      velocity_.template emplace<GaussSeidel<dim>>(sweep_weights()).update(K);
    } else if (const int passes = ilu_passes(flow_.viscous, crosses_cells_); passes > 1) {
      velocity_.template emplace<RefinedIlu<dim>>(passes, flow_.order == 1 ? 1.0f : 0.7f).update(K);
    } else {
      velocity_.template emplace<BlockIlu<dim>>().update(K);
    }
  }

  [[nodiscard]] std::string suitable_velocity_solver() const {
    const int ranks = pattern_->layout.communicator().size();
    if (gauss_seidel_serves(flow_, ranks)) return "gauss_seidel";
    return needs_amg(flow_, ranks) ? "amg" : "ilu";
  }

  /// Of the sweeps of Gauss-Seidel. The lowest eigenvalue falls as diffusion over a time step grows; so many
  /// passes that a twentieth is left of all errors, 60 at most. Where fluid crosses cells the spectrum is
  /// wider.
  [[nodiscard]] std::vector<float> sweep_weights() const {
    const double lowest = 1 / (1 + 3 * flow_.viscous);
    return chebyshev_weights(std::clamp(lowest, 1e-3, crosses_cells_ ? 0.5 : 0.95), 0.05);
  }

  void update_gradient(const BlockCsr<B>& K) {
    gradient_.resize(static_cast<std::size_t>(pattern_->n_blocks()) * dim + 4 - dim);  // read four at a time
    for (int k = 0; k < pattern_->n_blocks(); ++k)
      for (int c = 0; c < dim; ++c)
        gradient_[k * std::size_t{dim} + c] = static_cast<float>(K.at(k)[c * B + dim]);
  }

  void update_schur(const BlockCsr<B>& K, const SchurParts& parts) {
    inertia_ = Amg(amg_options());
    transport_ = Amg(amg_options());
    update_local_part(K, parts);
    if (!steady_) {
      BlockCsr<1> N = parts.laplacian;
      add_outlet_terms(K, N);
      setup_laplacian(N, inertia_);
    }
    if (!has_convection_ || !(steady_ || crosses_cells_)) return;
    BlockCsr<1> N = parts.laplacian;
    if (!add_inflow_terms(N)) add_outlet_terms(K, N);
    setup_laplacian(N, transport_);
  }

  void setup_laplacian(BlockCsr<1>& N, Amg& solver) const {
    // A spring on one pressure makes N regular and changes its solution by a constant only.
    if (options_.enclosed && pattern_->layout.first_global() == 0 && N.n_rows() > 0) *N.at(N.find(0, 0)) *= 2;
    solver.setup(N);
  }

  /// M + L and 1 - tau_M c. L, the PSPG block, is tau_M / rho times the Laplacian, N is 1 / (rho c) times:
  /// tau_M c is the ratio of their diagonals.
  void update_local_part(const BlockCsr<B>& K, const SchurParts& parts) {
    BlockCsr<1> local = extract_diagonal_part<1>(K, dim);
    local_factor_.assign(K.n_rows(), 1.0);
    for (int i = 0; i < K.n_rows() && !steady_; ++i) {
      const int diagonal = K.find(i, i);
      local_factor_[i] = std::max(0.0, 1 - *local.at(diagonal) / *parts.laplacian.at(diagonal));
    }
    for (std::size_t k = 0; k < local.values.size(); ++k) local.values[k] += parts.mass.values[k];
    local_part_.update(local);
  }

  /// Robin terms of the Laplacian within C N^-1 where fluid flows in: the columns of C sum up to the flux v.n
  /// of their functions through the boundary (Elman, Tuminaro 2009). False when fluid flows in nowhere.
  bool add_inflow_terms(BlockCsr<1>& N) const {
    const Layout& layout = pattern_->layout;
    std::vector<double> flux(layout.n_local(), 0.0), size(layout.n_local(), 0.0);
    for (int k = 0; k < pattern_->n_blocks(); ++k) {
      flux[pattern_->cols[k]] += *convection_.at(k);
      size[pattern_->cols[k]] += std::abs(*convection_.at(k));
    }
    layout.add_to_owners(flux.data());
    layout.add_to_owners(size.data());
    bool found = false;
    for (int i = 0; i < N.n_rows(); ++i)
      if (flux[i] < -0.1 * size[i]) *N.at(N.find(i, i)) *= 2, found = true;
    return layout.communicator().any(found);
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
    if (!steady_) inertia_.apply(r_p_.data(), z_p_.data());
    if (has_convection_) {
      if (transport_.ready()) transport_.apply(r_p_.data(), potential_.data());
      convection_.apply(transport_.ready() ? potential_.data() : z_p_.data(), transported_.data());
    }
    for (int i = 0; i < n; ++i) local_[i] = static_cast<float>(local_factor_[i] * r_p_[i] + transported_[i]);
    local_part_.apply(local_.data(), local_.data());
    for (int i = 0; i < n; ++i) z_p_[i] = (steady_ ? 0.0 : z_p_[i]) + local_[i];
    pattern_->layout.update_ghosts(z_p_.data());
  }

  /// r_v = r_v - G z_p. The components of G fill a register; the compiler, left alone, takes eight columns at
  /// a time and gathers, which is slower than all the rest.
  void subtract_gradient(const double* r) {
    typedef float Register __attribute__((vector_size(16)));
    for (int i = 0; i < pattern_->n_rows(); ++i) {
      Register sum = {};
      for (int k = pattern_->row_ptr[i]; k < pattern_->row_ptr[i + 1]; ++k) {
        Register G;
        std::memcpy(&G, &gradient_[k * std::size_t{dim}], sizeof G);
        sum += G * static_cast<float>(z_p_[pattern_->cols[k]]);
      }
      for (int c = 0; c < dim; ++c)
        r_v_[i * std::size_t{dim} + c] = static_cast<float>(r[i * long{B} + c]) - sum[c];
    }
  }

  /// z_v = A^-1 r_v
  void apply_velocity() {
    if (const auto* amg = std::get_if<Amg>(&velocity_)) {
      wide_b_.assign(r_v_.begin(), r_v_.begin() + pattern_->n_rows() * long{dim});
      wide_x_.resize(wide_b_.size());
      amg->apply(wide_b_.data(), wide_x_.data());
      for (std::size_t i = 0; i < wide_x_.size(); ++i) z_v_[i] = static_cast<float>(wide_x_[i]);
    } else if (const auto* ilu = std::get_if<BlockIlu<dim>>(&velocity_)) {
      ilu->apply(r_v_.data(), z_v_.data());
    } else if (auto* refined = std::get_if<RefinedIlu<dim>>(&velocity_)) {
      refined->apply(r_v_.data(), z_v_.data());
    } else {
      std::get<GaussSeidel<dim>>(velocity_).apply(r_v_.data(), z_v_.data());
    }
  }

  SaddleOptions options_;
  std::shared_ptr<const Pattern> pattern_;
  FlowNumbers flow_;
  std::variant<BlockIlu<dim>, RefinedIlu<dim>, GaussSeidel<dim>, Amg> velocity_;
  AlignedVector<float> gradient_;  ///< G: dim numbers per block of the pattern
  bool steady_ = false, has_convection_ = false;
  bool crosses_cells_ = false;  ///< the flow, about one or more within 1 / c
  Amg inertia_;                 ///< N^-1 of its own
  Amg transport_;               ///< N^-1 within C N^-1, where that is not the same
  BlockCsr<1> convection_;
  BlockIlu<1> local_part_;  ///< (M + L)^-1
  std::vector<double> local_factor_, r_p_, z_p_, potential_, transported_, wide_b_, wide_x_;
  AlignedVector<float> r_v_, z_v_, local_;
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
