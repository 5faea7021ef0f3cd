#pragma once
/// \file
/// Block triangular preconditioner of the coupled velocity-pressure system.

#include <algorithm>
#include <memory>
#include <string>

#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/schur_parts.hpp"

namespace ifsi {

struct SaddleOptions {
  /// Approximate inverse of the velocity block: "ilu" (once, or several times where that pays),
  /// "gauss_seidel" (as many passes as diffusion asks for), "amg", or "auto": Gauss-Seidel in the plane up to
  /// a viscous number (SchurParts) of 50 while the flow crosses few cells in a step; otherwise ILU(0) up to
  /// a number between 1.5 and three, AMG beyond. See gauss_seidel_serves, needs_amg.
  std::string velocity = "auto";
  bool enclosed = false;  ///< the pressure is known up to a constant
};

/// For K = [A G; D L] with (v, p) of a node side by side:
///
///     z_p = S^-1 r_p,              S^-1 = N^-1 + (M + L)^-1 ((1 - tau_M c) + C N^-1)        (eq. 14)
///     z_v = A^-1 (r_v - G z_p)
///
/// with M, N, C of SchurParts, N^-1 by one V-cycle and (M + L)^-1 by ILU(0); in steady flow S^-1 = (M + L)^-1
/// (1 + C N^-1). N needs boundary terms, different ones beside C than alone (add_outlet_terms,
/// add_inflow_terms): it is set up twice where transport matters. B = dim + 1. Rows of prescribed unknowns
/// are diagonal rows.
template <int B>
class SaddlePreconditioner {
 public:
  static constexpr int dim = B - 1;

  /// Whether "auto" takes Gauss-Seidel for the velocity. Where the flow crosses cells, and diffusion does not
  /// outdo it, the eigenvalues leave the real axis, and its polynomial, made for that, amplifies; in space it
  /// does so at CFL 16 in any case. A grad-div term beyond the four times viscous that it
  /// has by itself (s = 1e5) is not reckoned with. Several ranks: no further than the overlap.
  [[nodiscard]] static constexpr bool gauss_seidel_serves(const FlowNumbers& flow, int ranks) {
    return dim == 2 && flow.viscous <= (ranks == 1 ? 50.0 : 1.5) &&
           flow.bulk <= std::max(20.0, 5.0 * flow.viscous) &&
           (flow.transport <= 1.0 || flow.transport <= std::min(3.0 * flow.order, 2.0 * flow.viscous));
  }
  /// Whether "auto" takes AMG for the velocity: ILU(0) stays within 25 iterations, or nearly, up to this
  /// viscous number. Triangles beyond 1.5 and cells of order 2 beyond 2.4 let it diverge; so do, in the
  /// plane, grad-div terms of a bulk number of 50 (s = 1e5). In space those have not been measured.
  [[nodiscard]] static constexpr bool needs_amg(const FlowNumbers& flow, int ranks) {
    if (gauss_seidel_serves(flow, ranks)) return false;
    return flow.viscous > (dim == 2 ? 1.5 : flow.order == 1 ? 3.0 : 2.0) || (dim == 2 && flow.bulk > 20.0);
  }
  /// How many times in a row ILU(0) is applied.
  [[nodiscard]] static constexpr int ilu_passes(double viscous_number, bool crosses_cells) {
    if (viscous_number > (dim == 2 ? 0.8 : 1.5)) return 4;
    return crosses_cells || viscous_number > 0.3 ? 2 : 1;
  }

  /// Throws Error(configuration) for an unknown velocity solver.
  explicit SaddlePreconditioner(SaddleOptions options = {});
  ~SaddlePreconditioner();
  SaddlePreconditioner(SaddlePreconditioner&&) noexcept;
  SaddlePreconditioner& operator=(SaddlePreconditioner&&) noexcept;

  /// Collective. Sets everything up for K; nothing of K or parts is referred to afterwards.
  /// Throws Error(linear_solver) when a part is singular or does not have K's pattern.
  void update(const BlockCsr<B>& K, const SchurParts& parts);

  /// Collective. z = P^-1 r on owned nodes; both hold n_local * B numbers.
  void apply(const double* r, double* z);

  /// What update chose and built, in one line. Collective.
  [[nodiscard]] std::string description() const;
  /// Cost of update in applications, a rough constant per velocity solver.
  [[nodiscard]] double setup_cost() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class SaddlePreconditioner<3>;
extern template class SaddlePreconditioner<4>;

}  // namespace ifsi
