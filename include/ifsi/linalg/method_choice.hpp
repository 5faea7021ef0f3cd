#pragma once
/// \file
/// LU or the block preconditioner: which of them a flow system is given to.

#include <string>

#include "ifsi/linalg/saddle_preconditioner.hpp"

namespace ifsi {

/// What the choice depends on.
struct SystemTraits {
  int dim = 2;
  long unknowns = 0;
  int ranks = 1;
  /// Whether the velocity block needs AMG (SaddlePreconditioner::needs_amg): a solve then costs three times
  /// what it does with ILU(0).
  bool needs_amg = false;
  /// Whether diffusion reaches beyond a cell in a time step (viscous number above 1.5): iterations of GMRES
  /// cost up to twice what they do below.
  bool diffusive = false;
  /// Whether a patch around solids is solved for beside it (PatchedSolver): each iteration costs more, and
  /// GMRES takes two to four times as many as with LU.
  bool immersed = false;
};

struct MethodChoice {
  bool direct = true;
  std::string why;
};

/// LU up to a number of unknowns: 3,000 in space. In the plane, while one rank does all the work, 400,000
/// with immersed solids, 150,000 where AMG is needed and 40,000 where Gauss-Seidel takes many passes; 5,000
/// otherwise (docs/solver-studies.md has the measurements).
[[nodiscard]] MethodChoice choose_method(const SystemTraits& system);

/// Whether LU may take over where GMRES fails.
[[nodiscard]] constexpr bool lu_is_affordable(int dim, long unknowns) {
  return unknowns <= (dim == 2 ? 400'000 : 40'000);
}

template <int B>
[[nodiscard]] MethodChoice choose_method(const BlockCsr<B>& K, const SchurParts& parts,
                                         bool immersed = false) {
  const int ranks = K.layout().communicator().size();
  const FlowNumbers flow = flow_numbers(parts);
  return choose_method({.dim = B - 1,
                        .unknowns = K.layout().n_global() * B,
                        .ranks = ranks,
                        .needs_amg = SaddlePreconditioner<B>::needs_amg(flow, ranks),
                        .diffusive = flow.viscous > 1.5,
                        .immersed = immersed});
}

}  // namespace ifsi
