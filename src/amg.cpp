#include "ifsi/linalg/amg.hpp"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <_hypre_parcsr_ls.h>

#include <sstream>
#include <vector>

#include "ifsi/core/error.hpp"

namespace ifsi {
namespace {

/// hypre wants to be told once per process, after MPI has started.
void initialise_hypre() { [[maybe_unused]] static const bool done = (HYPRE_Init(), true); }

void check_hypre(const char* what) {
  const HYPRE_Int error = HYPRE_GetError();
  if (error == 0) return;
  char text[256];
  HYPRE_DescribeError(error, text);
  HYPRE_ClearAllErrors();
  throw Error(ExitCode::linear_solver, std::string("BoomerAMG: ") + what + " failed: " + text);
}

}  // namespace

class Amg::Impl {
 public:
  explicit Impl(AmgOptions options) : options_(options) { initialise_hypre(); }
  ~Impl() { clear(); }

  void setup(const Pattern& pattern, int block, std::span<const double> values) {
    clear();
    block_ = block;
    n_rows_ = pattern.n_rows() * block;
    const long n = pattern.layout.n_global() * block;
    if (n > 2147483647L)
      throw Error(ExitCode::linear_solver,
                  "BoomerAMG: " + std::to_string(n) + " unknowns; this hypre counts up to 2147483647");
    create_matrix(pattern, values);
    create_vectors(pattern.layout);
    create_solver();
    HYPRE_BoomerAMGSetup(solver_, parcsr_, par_b_, par_x_);
    check_hypre("set-up");
  }

  void apply(const double* b, double* x) const {
    HYPRE_IJVectorSetValues(b_, n_rows_, nullptr, b);
    HYPRE_ParVectorSetConstantValues(par_x_, 0.0);
    HYPRE_BoomerAMGSolve(solver_, parcsr_, par_b_, par_x_);
    HYPRE_ClearAllErrors();  // "not converged" is what a fixed number of cycles says
    HYPRE_IJVectorGetValues(x_, n_rows_, nullptr, x);
  }

  [[nodiscard]] bool ready() const { return solver_ != nullptr; }

  [[nodiscard]] std::string description() const {
    if (!ready()) return "BoomerAMG, not set up";
    auto* data = static_cast<hypre_ParAMGData*>(static_cast<void*>(solver_));
    const int n_levels = hypre_ParAMGDataNumLevels(data);
    double sum = 0;
    for (int level = 0; level < n_levels; ++level) {
      hypre_ParCSRMatrix* A = hypre_ParAMGDataAArray(data)[level];
      hypre_ParCSRMatrixSetDNumNonzeros(A);
      sum += hypre_ParCSRMatrixDNumNonzeros(A);
    }
    std::ostringstream text;
    text.precision(3);
    text << "BoomerAMG" << (by_nodes() ? " by nodes, " : ", ") << (options_.w_cycle ? "W-cycle, " : "")
         << n_levels << " levels, operator complexity " << sum / hypre_ParCSRMatrixDNumNonzeros(parcsr_);
    return text.str();
  }

 private:
  void clear() {
    if (solver_) HYPRE_BoomerAMGDestroy(solver_);
    if (matrix_) HYPRE_IJMatrixDestroy(matrix_);
    if (b_) HYPRE_IJVectorDestroy(b_);
    if (x_) HYPRE_IJVectorDestroy(x_);
    solver_ = nullptr;
    matrix_ = nullptr;
    b_ = x_ = nullptr;
  }

  void create_matrix(const Pattern& pattern, std::span<const double> values) {
    const HYPRE_BigInt first = static_cast<HYPRE_BigInt>(pattern.layout.first_global() * block_);
    std::vector<HYPRE_BigInt> rows(n_rows_), columns;
    std::vector<HYPRE_Int> sizes(n_rows_, 0);
    std::vector<double> entries;
    columns.reserve(values.size());
    entries.reserve(values.size());
    for (int row = 0; row < n_rows_; ++row) {
      rows[row] = first + row;
      append_row(pattern, values, row, columns, entries);
      sizes[row] = static_cast<HYPRE_Int>(columns.size());
    }
    for (int row = n_rows_ - 1; row > 0; --row) sizes[row] -= sizes[row - 1];
    const HYPRE_BigInt last = first + n_rows_ - 1;
    HYPRE_IJMatrixCreate(pattern.layout.communicator().handle(), first, last, first, last, &matrix_);
    HYPRE_IJMatrixSetObjectType(matrix_, HYPRE_PARCSR);
    HYPRE_IJMatrixSetRowSizes(matrix_, sizes.data());
    HYPRE_IJMatrixInitialize(matrix_);
    HYPRE_IJMatrixSetValues(matrix_, n_rows_, sizes.data(), rows.data(), columns.data(), entries.data());
    HYPRE_IJMatrixAssemble(matrix_);
    HYPRE_IJMatrixGetObject(matrix_, reinterpret_cast<void**>(&parcsr_));
    check_hypre("matrix assembly");
  }

  void append_row(const Pattern& pattern, std::span<const double> values, int row,
                  std::vector<HYPRE_BigInt>& columns, std::vector<double>& entries) const {
    const int node = row / block_, r = row % block_;
    for (int k = pattern.row_ptr[node]; k < pattern.row_ptr[node + 1]; ++k)
      for (int c = 0; c < block_; ++c) {
        const double value = values[(static_cast<std::size_t>(k) * block_ + r) * block_ + c];
        if (value == 0 && !(pattern.cols[k] == node && c == r)) continue;
        columns.push_back(static_cast<HYPRE_BigInt>(pattern.layout.global(pattern.cols[k]) * block_ + c));
        entries.push_back(value);
      }
  }

  void create_vectors(const Layout& layout) {
    const HYPRE_BigInt first = static_cast<HYPRE_BigInt>(layout.first_global() * block_);
    for (HYPRE_IJVector* v : {&b_, &x_}) {
      HYPRE_IJVectorCreate(layout.communicator().handle(), first, first + n_rows_ - 1, v);
      HYPRE_IJVectorSetObjectType(*v, HYPRE_PARCSR);
      HYPRE_IJVectorInitialize(*v);
      HYPRE_IJVectorAssemble(*v);
    }
    HYPRE_IJVectorGetObject(b_, reinterpret_cast<void**>(&par_b_));
    HYPRE_IJVectorGetObject(x_, reinterpret_cast<void**>(&par_x_));
    check_hypre("vector assembly");
  }

  void create_solver() {
    constexpr HYPRE_Int hmis = 10, extended_plus_i = 6, l1_forward = 13, l1_backward = 14, gauss = 9;
    HYPRE_BoomerAMGCreate(&solver_);
    HYPRE_BoomerAMGSetPrintLevel(solver_, 0);
    HYPRE_BoomerAMGSetTol(solver_, 0.0);
    HYPRE_BoomerAMGSetMaxIter(solver_, options_.cycles);
    HYPRE_BoomerAMGSetCycleType(solver_, options_.w_cycle ? 2 : 1);
    HYPRE_BoomerAMGSetCoarsenType(solver_, hmis);
    HYPRE_BoomerAMGSetInterpType(solver_, extended_plus_i);
    HYPRE_BoomerAMGSetPMaxElmts(solver_, options_.max_per_row);
    HYPRE_BoomerAMGSetAggNumLevels(solver_, options_.aggressive_levels);
    HYPRE_BoomerAMGSetStrongThreshold(solver_, options_.strong_threshold);
    HYPRE_BoomerAMGSetNumSweeps(solver_, 1);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, l1_forward, 1);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, l1_backward, 2);
    HYPRE_BoomerAMGSetCycleRelaxType(solver_, gauss, 3);
    HYPRE_BoomerAMGSetMaxCoarseSize(solver_, 40);
    HYPRE_BoomerAMGSetNumFunctions(solver_, block_);
    if (by_nodes()) HYPRE_BoomerAMGSetNodal(solver_, 1);
  }

  [[nodiscard]] bool by_nodes() const { return block_ > 1 && options_.nodal; }

  AmgOptions options_;
  int block_ = 1;
  int n_rows_ = 0;
  HYPRE_Solver solver_ = nullptr;
  HYPRE_IJMatrix matrix_ = nullptr;
  HYPRE_IJVector b_ = nullptr, x_ = nullptr;
  HYPRE_ParCSRMatrix parcsr_ = nullptr;
  HYPRE_ParVector par_b_ = nullptr, par_x_ = nullptr;
};

Amg::Amg(AmgOptions options) : impl_(std::make_unique<Impl>(options)) {}
Amg::~Amg() = default;
Amg::Amg(Amg&&) noexcept = default;
Amg& Amg::operator=(Amg&&) noexcept = default;
void Amg::setup(const Pattern& pattern, int block, std::span<const double> values) {
  impl_->setup(pattern, block, values);
}
void Amg::apply(const double* b, double* x) const { impl_->apply(b, x); }
bool Amg::ready() const { return impl_->ready(); }
std::string Amg::description() const { return impl_->description(); }

}  // namespace ifsi
