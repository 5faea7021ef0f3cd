#include "lu.hpp"

#ifdef IFSI_HAS_MUMPS
#include <dmumps_c.h>
#include <metis.h>

#include <algorithm>
#include <exception>
#include <numeric>
#include <vector>
#endif

namespace ifsi {

#ifdef IFSI_HAS_MUMPS
namespace {

/// MUMPS spreads factors and work over all ranks; matrix and vectors are root's. Ordered by nested dissection
/// of the graph of the blocks, which Debian's MUMPS has no METIS for.
class Mumps final : public Lu {
 public:
  explicit Mumps(const Communicator& comm) : root_(comm.is_root()) {
    id_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm.handle()));
    id_.par = 1;
    call(-1);
    for (int stream : {1, 2, 3, 4}) icntl(stream) = 0;  // no output
    icntl(6) = 0;                                       // no permutation to a large diagonal
    icntl(7) = 1;                                       // the ordering is given
    icntl(10) = 0;                                      // GMRES around it does the refinement
    icntl(14) = 50;                                     // per cent of memory beyond the estimate
    id_.cntl[0] = 1e-3;                                 // threshold of pivots
  }
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;
  ~Mumps() override {
    // Collective: where one rank alone fails it must not wait for the others, and all end soon.
    if (std::uncaught_exceptions() == 0) call(-2);
  }

  std::string analyse(const LuMatrix& matrix) override {
    if (root_) {
      set_pattern(matrix);
      order(matrix);
    }
    call(1);
    return reason();
  }

  std::string factor(std::span<const double> values) override {
    id_.a = const_cast<double*>(values.data());  // MUMPS does not write to it
    for (int attempt = 0; attempt < 3; ++attempt) {
      call(2);
      const bool memory_too_small = id_.infog[0] == -8 || id_.infog[0] == -9;
      if (!memory_too_small) break;
      icntl(14) *= 2;
    }
    const double entries = id_.infog[28] >= 0 ? id_.infog[28] : -1e6 * id_.infog[28];
    cost_ = {id_.rinfog[2], entries, 1e6 * id_.infog[21]};
    return reason();
  }

  void solve(const double* b, double* x) override {
    if (root_) std::copy_n(b, id_.n, x);
    id_.rhs = x;
    call(3);
  }

 private:
  MUMPS_INT& icntl(int number) { return id_.icntl[number - 1]; }
  void call(int job) {
    id_.job = job;
    dmumps_c(&id_);
  }

  void set_pattern(const LuMatrix& matrix) {
    rows_.clear(), cols_.clear();
    for (long i = 0; i < matrix.n(); ++i)
      for (long k = matrix.row_ptr[i]; k < matrix.row_ptr[i + 1]; ++k) {
        rows_.push_back(static_cast<MUMPS_INT>(i + 1));
        cols_.push_back(static_cast<MUMPS_INT>(matrix.cols[k] + 1));
      }
    id_.n = static_cast<MUMPS_INT>(matrix.n());
    id_.nnz = static_cast<MUMPS_INT8>(rows_.size());
    id_.irn = rows_.data(), id_.jcn = cols_.data();
    icntl(15) = matrix.block > 1 ? -matrix.block : 0;  // the analysis works on blocks
  }

  /// The position of every unknown in the order of elimination.
  void order(const LuMatrix& matrix) {
    const int block = matrix.block;
    idx_t n = static_cast<idx_t>(matrix.n() / block);
    std::vector<idx_t> begin{0}, adjacency, order(n), position(n);
    for (idx_t i = 0; i < n; ++i) {
      for (long k = matrix.row_ptr[i * block]; k < matrix.row_ptr[i * block + 1]; k += block)
        if (matrix.cols[k] / block != i) adjacency.push_back(static_cast<idx_t>(matrix.cols[k] / block));
      begin.push_back(static_cast<idx_t>(adjacency.size()));
    }
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    const int status =
        METIS_NodeND(&n, begin.data(), adjacency.data(), nullptr, options, order.data(), position.data());
    if (status != METIS_OK) std::iota(position.begin(), position.end(), 0);
    position_.resize(matrix.n());
    for (idx_t i = 0; i < n; ++i)
      for (int c = 0; c < block; ++c) position_[i * block + c] = position[i] * block + c + 1;
    id_.perm_in = position_.data();
  }

  [[nodiscard]] std::string reason() const {
    switch (id_.infog[0]) {
      case -6:
      case -10:
        return "the matrix is singular";
      case -7:
      case -13:
        return "out of memory";
      default:
        return id_.infog[0] >= 0 ? "" : "MUMPS status " + std::to_string(id_.infog[0]);
    }
  }

  bool root_;
  DMUMPS_STRUC_C id_{};
  std::vector<MUMPS_INT> rows_, cols_, position_;
};

}  // namespace

bool has_mumps() { return true; }
std::unique_ptr<Lu> make_mumps(const Communicator& comm) { return std::make_unique<Mumps>(comm); }
#else
bool has_mumps() { return false; }
std::unique_ptr<Lu> make_mumps(const Communicator&) { return nullptr; }
#endif

}  // namespace ifsi
