#pragma once
/// \file
/// The few MPI calls ifsi needs, with values in and values out.

#include <mpi.h>

#include <type_traits>
#include <vector>

namespace ifsi {

/// A non-owning view of an MPI communicator.
class Communicator {
 public:
  explicit Communicator(MPI_Comm comm = MPI_COMM_WORLD) : comm_(comm) {
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
  }
  [[nodiscard]] MPI_Comm handle() const { return comm_; }
  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] bool is_root() const { return rank_ == 0; }

  [[nodiscard]] double sum(double x) const { return reduce(x, MPI_DOUBLE, MPI_SUM); }
  [[nodiscard]] double max(double x) const { return reduce(x, MPI_DOUBLE, MPI_MAX); }
  [[nodiscard]] double min(double x) const { return reduce(x, MPI_DOUBLE, MPI_MIN); }
  [[nodiscard]] long sum(long x) const { return reduce(x, MPI_LONG, MPI_SUM); }
  [[nodiscard]] long max(long x) const { return reduce(x, MPI_LONG, MPI_MAX); }
  [[nodiscard]] bool any(bool x) const { return max(long{x}) != 0; }
  /// Sums n numbers in place, one message for all of them.
  void sum_in_place(double* x, int n) const {
    if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, x, n, MPI_DOUBLE, MPI_SUM, comm_);
  }
  /// Sum over the ranks before this one.
  [[nodiscard]] long exclusive_scan(long x) const {
    long before = 0;
    MPI_Exscan(&x, &before, 1, MPI_LONG, MPI_SUM, comm_);
    return rank_ == 0 ? 0 : before;
  }
  /// The numbers of all ranks one after the other, on every rank.
  template <class T>
  [[nodiscard]] std::vector<T> all_gather(const std::vector<T>& mine) const {
    static_assert(std::is_trivially_copyable_v<T>);
    int bytes = static_cast<int>(mine.size() * sizeof(T));
    std::vector<int> counts(size_), offsets(size_ + 1, 0);
    MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
    for (int r = 0; r < size_; ++r) offsets[r + 1] = offsets[r] + counts[r];
    std::vector<T> all(offsets[size_] / sizeof(T));
    MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, comm_);
    return all;
  }
  void barrier() const { MPI_Barrier(comm_); }

 private:
  template <class T>
  [[nodiscard]] T reduce(T x, MPI_Datatype type, MPI_Op op) const {
    if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, &x, 1, type, op, comm_);
    return x;
  }
  MPI_Comm comm_;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace ifsi
