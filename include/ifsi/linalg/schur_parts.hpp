#pragma once
/// \file
/// What the flow assembly knows about the pressure Schur complement and the matrix alone does not say.

#include <functional>
#include <vector>

#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Parts of the pressure Schur complement S of K = [A G; D L] (eq. 14): A is rho c times the mass matrix plus
/// convection, viscous and grad-div terms, L the PSPG block. All matrices have the nodes of K and no boundary
/// conditions. m = 2 mu + rho tau_C.
struct SchurParts {
  BlockCsr<1> mass;  ///< M: int q p / m
  /// N: int grad q . grad p / (rho c). In steady flow 1 / rho stands for 1 / (rho c), a scale that the
  /// product C N^-1 does not show.
  BlockCsr<1> laplacian;
  /// C: int q rho v . grad p / (m rho c), with the same 1 / (rho c) as in N. Left empty: no convection.
  BlockCsr<1> convection{};
  /// Max over the cells of mu / (rho c h^2): how far the velocity block is from a mass matrix. h is the
  /// distance of neighbouring nodes, half of it in cells of order 2. Infinite in steady flow.
  double viscous_number = 0;
  /// Max over the cells of rho tau_C / (rho c h^2) = 1 / (4 dim c tau_M), h the edge of a cell: the same for
  /// the grad-div term, which s raises around solids (eq. 4, 5).
  double bulk_number = 0;
  int order = 1;        ///< of the shape functions
  bool steady = false;  ///< no inertia: N^-1 alone is not part of S^-1
};

/// What the velocity block is like, without its size.
struct FlowNumbers {
  double viscous = 0, bulk = 0;  ///< see SchurParts
  double transport = 0;  ///< how many cells the flow crosses within 1 / c, |v| / (c h): sum |C| / sum M
  int order = 1;
};

/// Collective.
[[nodiscard]] FlowNumbers flow_numbers(const SchurParts& parts);

/// Called when a preconditioner is renewed, and only then.
using SchurProvider = std::function<SchurParts()>;

}  // namespace ifsi
