#pragma once
/// \file
/// LU factorisations of a sparse matrix that one rank holds, behind DirectSolver.

#include <memory>
#include <span>
#include <string>

#include "ifsi/core/communicator.hpp"
#include "ifsi/linalg/direct.hpp"

namespace ifsi {

/// Scalar rows with ascending columns, made of dense blocks; empty but on root.
struct LuMatrix {
  int block = 1;
  std::span<const long> row_ptr, cols;
  [[nodiscard]] long n() const { return static_cast<long>(row_ptr.size()) - 1; }
};

/// All calls are collective; arguments count on root, where vectors have n numbers. analyse and factor return
/// what went wrong, on root at least, or nothing. The matrix stays alive and in place between them.
class Lu {
 public:
  virtual ~Lu() = default;
  virtual std::string analyse(const LuMatrix& matrix) = 0;
  virtual std::string factor(std::span<const double> values) = 0;
  virtual void solve(const double* b, double* x) = 0;
  /// Of the last factorisation, on root.
  [[nodiscard]] const DirectSolver::Cost& cost() const { return cost_; }

 protected:
  DirectSolver::Cost cost_;
};

std::unique_ptr<Lu> make_umfpack(const Communicator& comm);
/// Whether MUMPS was found when ifsi was built; make_mumps() is null without.
bool has_mumps();
std::unique_ptr<Lu> make_mumps(const Communicator& comm);

}  // namespace ifsi
