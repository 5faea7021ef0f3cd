#include "ifsi/linalg/direct.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "lu.hpp"

namespace ifsi {
namespace {

/// Root's copy of numbers that all ranks hold parts of, in rank order; and the way back.
class Gatherer {
 public:
  Gatherer() = default;
  Gatherer(const Communicator& comm, std::size_t n_mine) : comm_(comm) {
    const std::vector<long> sizes = comm.all_gather(std::vector<long>{static_cast<long>(n_mine)});
    for (long n : sizes) {
      offsets_.push_back(total_);
      counts_.push_back(static_cast<int>(n));
      total_ += n;
    }
    // MPI-3 counts are int: 2^31 numbers on root is beyond what a direct solve can do anyway.
    if (total_ > 2147483647L)
      throw Error(ExitCode::linear_solver, "direct solver: matrix too large to gather on one rank (" +
                                               std::to_string(total_) + " numbers); use linear.method=gmres");
  }
  [[nodiscard]] long total() const { return comm_.is_root() ? total_ : 0; }

  template <class T>
  [[nodiscard]] std::vector<T> gather(std::span<const T> mine) const {
    std::vector<T> all(total());
    MPI_Gatherv(mine.data(), static_cast<int>(mine.size()), type(T{}), all.data(), counts_.data(),
                offsets_.data(), type(T{}), 0, comm_.handle());
    return all;
  }
  void scatter(const std::vector<double>& all, double* mine) const {
    MPI_Scatterv(all.data(), counts_.data(), offsets_.data(), MPI_DOUBLE, mine, counts_[comm_.rank()],
                 MPI_DOUBLE, 0, comm_.handle());
  }

 private:
  static MPI_Datatype type(double) { return MPI_DOUBLE; }
  static MPI_Datatype type(long) { return MPI_LONG; }
  Communicator comm_;
  std::vector<int> counts_, offsets_;
  long total_ = 0;
};

}  // namespace

class DirectSolver::Impl {
 public:
  explicit Impl(Work work) : work_(work) {}

  void factor(std::shared_ptr<const Pattern> pattern, int block, std::span<const double> values,
              long pinned) {
    if (pattern != pattern_ || block != block_) analyse(std::move(pattern), block);
    const std::vector<double> blocks = block_values_.gather<double>(values);
    pinned_ = pinned;
    if (is_root()) fill(blocks);
    check(lu_->factor(entries_), "factorisation");
    ready_ = true;
  }

  void apply(const double* b, double* x) const {
    const std::size_t n_mine = static_cast<std::size_t>(pattern_->n_rows()) * block_;
    if (comm_.size() == 1 && pinned_ < 0) return lu_->solve(b, x);
    std::vector<double> all_b = vector_.gather<double>({b, n_mine});
    std::vector<double> all_x(all_b.size());
    if (is_root() && pinned_ >= 0) all_b[pinned_] = 0;
    lu_->solve(all_b.data(), all_x.data());
    vector_.scatter(all_x, x);
  }

  [[nodiscard]] bool ready() const { return ready_; }
  [[nodiscard]] const Cost& cost() const { return cost_; }
  [[nodiscard]] bool is_shared() const { return work_ == Work::shared && has_mumps(); }

 private:
  [[nodiscard]] bool is_root() const { return comm_.is_root(); }

  void analyse(std::shared_ptr<const Pattern> pattern, int block) {
    pattern_ = std::move(pattern);
    block_ = block;
    comm_ = pattern_->layout.communicator();
    block_values_ = Gatherer(comm_, pattern_->cols.size() * block * block);
    vector_ = Gatherer(comm_, static_cast<std::size_t>(pattern_->n_rows()) * block);
    gather_pattern();
    if (!lu_) lu_ = make_lu();
    check(lu_->analyse({block_, row_ptr_, cols_}), "analysis");
  }

  [[nodiscard]] std::unique_ptr<Lu> make_lu() const {
    return is_shared() ? make_mumps(comm_) : make_umfpack(comm_);
  }

  /// Root builds the scalar rows of the whole matrix; source_ says where in the gathered blocks each entry
  /// is.
  void gather_pattern() {
    const Layout& layout = pattern_->layout;
    std::vector<long> sizes, columns;
    for (int i = 0; i < pattern_->n_rows(); ++i)
      sizes.push_back(pattern_->row_ptr[i + 1] - pattern_->row_ptr[i]);
    for (int j : pattern_->cols) columns.push_back(layout.global(j));
    sizes = Gatherer(comm_, sizes.size()).gather<long>(sizes);
    columns = Gatherer(comm_, columns.size()).gather<long>(columns);
    row_ptr_.assign(1, 0);
    cols_.clear();
    source_.clear();
    long first = 0;
    for (long size : sizes) {
      append_block_row(&columns[first], size, first);
      first += size;
    }
    entries_.resize(cols_.size());
  }

  /// Within a row LU wants ascending columns; local numbering has the ghosts last.
  void append_block_row(const long* columns, long size, long first) {
    std::vector<long> order(size);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](long a, long b) { return columns[a] < columns[b]; });
    for (int r = 0; r < block_; ++r) {
      for (long k : order)
        for (int c = 0; c < block_; ++c) {
          cols_.push_back(columns[k] * block_ + c);
          source_.push_back(((first + k) * block_ + r) * block_ + c);
        }
      row_ptr_.push_back(static_cast<long>(cols_.size()));
    }
  }

  void fill(const std::vector<double>& blocks) {
    for (std::size_t e = 0; e < entries_.size(); ++e) entries_[e] = blocks[source_[e]];
    if (pinned_ < 0) return;
    for (long e = row_ptr_[pinned_]; e < row_ptr_[pinned_ + 1]; ++e)
      entries_[e] = cols_[e] == pinned_ ? 1 : 0;
  }

  /// Throws on all ranks what root says.
  void check(const std::string& reason, const std::string& what) {
    cost_ = lu_->cost();
    MPI_Bcast(&cost_, 3, MPI_DOUBLE, 0, comm_.handle());
    const std::vector<char> said =
        comm_.all_gather(is_root() ? std::vector<char>(reason.begin(), reason.end()) : std::vector<char>{});
    if (said.empty()) return;
    ready_ = false;
    pattern_.reset();
    throw Error(ExitCode::linear_solver, "direct solver: " + what +
                                             " failed: " + std::string(said.begin(), said.end()) +
                                             "; expected a regular matrix that fits into memory");
  }

  Work work_;
  std::unique_ptr<Lu> lu_;
  std::shared_ptr<const Pattern> pattern_;
  Communicator comm_;
  int block_ = 0;
  long pinned_ = -1;
  bool ready_ = false;
  Gatherer block_values_, vector_;
  std::vector<long> row_ptr_, cols_, source_;
  std::vector<double> entries_;
  Cost cost_;
};

DirectSolver::DirectSolver(Work work) : impl_(std::make_unique<Impl>(work)) {}
DirectSolver::~DirectSolver() = default;
DirectSolver::DirectSolver(DirectSolver&&) noexcept = default;
DirectSolver& DirectSolver::operator=(DirectSolver&&) noexcept = default;

void DirectSolver::factor(std::shared_ptr<const Pattern> pattern, int block, std::span<const double> values,
                          long pinned) {
  impl_->factor(std::move(pattern), block, values, pinned);
}
void DirectSolver::apply(const double* b, double* x) const { impl_->apply(b, x); }
bool DirectSolver::ready() const { return impl_->ready(); }
std::string DirectSolver::method() const {
  return impl_->is_shared() ? "MUMPS, shared by all ranks" : "UMFPACK, on one rank";
}
const DirectSolver::Cost& DirectSolver::cost() const { return impl_->cost(); }

}  // namespace ifsi
