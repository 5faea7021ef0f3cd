#pragma once
/// \file
/// What the flow assembly knows about the pressure Schur complement and the matrix alone does not say.

#include <functional>
#include <vector>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Two ends of the pressure Schur complement S = L - D A^-1 G of K = [A G; D L]: where viscosity dominates
/// S ~ M_p / (mu + tau_C), where mass dominates S ~ L - div(1/(rho c) grad), with A ~ rho c M + viscous +
/// grad-div. Where the unknowns or equations of K carry factors (A = a (rho c M + ..), G = g grad, D = d
/// div), both parts carry d g / a.
struct SchurParts {
  std::vector<double> mass;  ///< per owned node: lumped pressure mass / (mu + tau_C)
  /// int grad q . 1/(rho c [+ k_s]) grad p, same nodes as K; no boundary conditions. All zero in steady flow,
  /// where 1/(rho c) is infinite: that end of the complement is then left out.
  BlockCsr<1> laplacian;
  /// max over the cells of max(mu, mu_s) dt / (rho h^2): how far the velocity block is from a mass matrix.
  double viscous_number = 0;
  BlockCsr<1> convection{};
  bool steady = false;
};

/// Called when a preconditioner is renewed, and only then.
using SchurProvider = std::function<SchurParts()>;

}  // namespace ifsi
