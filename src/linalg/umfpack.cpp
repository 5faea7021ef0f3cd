#include <umfpack.h>

#include "lu.hpp"

namespace ifsi {
namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(long));

std::string reason(int status) {
  switch (status) {
    case UMFPACK_OK:
      return {};
    case UMFPACK_WARNING_singular_matrix:
      return "the matrix is singular";
    case UMFPACK_ERROR_out_of_memory:
      return "out of memory";
    case UMFPACK_ERROR_invalid_matrix:
      return "the matrix has an invalid pattern";
    default:
      return "UMFPACK status " + std::to_string(status);
  }
}

/// Works on root alone. UMFPACK stores by columns; our rows are the columns of the transpose, so the
/// transpose is factored and solved with UMFPACK_At.
class Umfpack final : public Lu {
 public:
  explicit Umfpack(bool root) : root_(root) {}
  Umfpack(const Umfpack&) = delete;
  Umfpack& operator=(const Umfpack&) = delete;
  ~Umfpack() override {
    umfpack_dl_free_numeric(&numeric_);
    umfpack_dl_free_symbolic(&symbolic_);
  }

  std::string analyse(const LuMatrix& matrix) override {
    if (!root_) return {};
    matrix_ = matrix;
    umfpack_dl_defaults(control_);
    control_[UMFPACK_IRSTEP] = 0;  // GMRES around it does the refinement
    // The pattern is symmetric and the diagonal is no zero (stabilisation), so pivots may be taken from it:
    // that halves the fill. CHOLMOD's ordering is AMD in the plane and METIS where AMD would fill in.
    control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_CHOLMOD;
    umfpack_dl_free_symbolic(&symbolic_);
    return reason(static_cast<int>(umfpack_dl_symbolic(matrix.n(), matrix.n(), row_ptr(), cols(), nullptr,
                                                       &symbolic_, control_, nullptr)));
  }

  std::string factor(std::span<const double> values) override {
    if (!root_) return {};
    values_ = values;
    double info[UMFPACK_INFO];
    umfpack_dl_free_numeric(&numeric_);
    const auto status =
        umfpack_dl_numeric(row_ptr(), cols(), values.data(), symbolic_, &numeric_, control_, info);
    cost_ = {info[UMFPACK_FLOPS], info[UMFPACK_LNZ] + info[UMFPACK_UNZ],
             info[UMFPACK_PEAK_MEMORY] * info[UMFPACK_SIZE_OF_UNIT]};
    return reason(static_cast<int>(status));
  }

  void solve(const double* b, double* x) override {
    if (!root_) return;
    umfpack_dl_solve(UMFPACK_At, row_ptr(), cols(), values_.data(), x, b, numeric_, control_, nullptr);
  }

 private:
  [[nodiscard]] const SuiteSparse_long* row_ptr() const { return matrix_.row_ptr.data(); }
  [[nodiscard]] const SuiteSparse_long* cols() const { return matrix_.cols.data(); }

  bool root_;
  LuMatrix matrix_;
  std::span<const double> values_;
  double control_[UMFPACK_CONTROL];
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
};

}  // namespace

std::unique_ptr<Lu> make_umfpack(const Communicator& comm) {
  return std::make_unique<Umfpack>(comm.is_root());
}

}  // namespace ifsi
