#pragma once
/// \file
/// What the flow assembly knows about the pressure Schur complement and the matrix alone does not say.

#include <functional>
#include <vector>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Parts of the pressure Schur complement S = L - D A^-1 G of K = [A G; D L], A ~ rho c M + convection +
/// viscous + grad-div. For waves of wave number k and velocity v, with m = 2 mu + rho tau_C, its inverse is
/// close to
///
///     rho c / k^2  +  m (1 - tau_M c)  +  i rho v.k / k^2
///
/// (stabilisation included: PSPG and SUPG cancel where inertia or convection dominate). The three terms are
/// N^-1, the weighted inverse mass matrix and M^-1 C N^-1 below. Where the unknowns or equations of K carry
/// factors (A = a (rho c M + ..), G = g grad, D = d div), mass and laplacian carry d g / a.
struct SchurParts {
  std::vector<double> mass;  ///< M per owned node: lumped pressure mass / m
  /// N: int grad q . 1/(rho c [+ k_s]) grad p, same nodes as K; no boundary conditions. In steady flow 1/rho
  /// stands for 1/(rho c), a scale that the product C N^-1 does not show.
  BlockCsr<1> laplacian;
  /// max over the cells of max(mu, mu_s) dt / (rho h^2): how far the velocity block is from a mass
  /// matrix. h is the distance of neighbouring nodes.
  double viscous_number = 0;
  /// C: int q rho/(m rho c) v . grad p, with the same 1/(rho c) as in N. Left empty: no convection.
  BlockCsr<1> convection{};
  bool steady = false;  ///< no inertia: N^-1 alone is not part of S^-1
};

/// Called when a preconditioner is renewed, and only then.
using SchurProvider = std::function<SchurParts()>;

}  // namespace ifsi
