#pragma once
/// \file
/// How the entries of a distributed vector are spread over the ranks, and the exchange of ghost entries.

#include <algorithm>
#include <string>
#include <vector>

#include "ifsi/core/communicator.hpp"
#include "ifsi/core/error.hpp"

namespace ifsi {

/// Distribution of indices (nodes) over ranks. Each index has one owner. Locally the owned indices come
/// first, [0, n_owned), then the ghosts, [n_owned, n_local), in the order given. Global numbers are
/// contiguous per rank. A vector with `block` numbers per index holds n_local * block numbers, those of one
/// index side by side.
class Layout {
 public:
  /// An empty layout, to be assigned to.
  Layout() = default;

  /// Collective. \param ghost_global global numbers of this rank's ghosts, each owned by another rank.
  /// Throws Error on all ranks when a ghost does not exist or belongs to the rank that asks for it.
  Layout(Communicator comm, int n_owned, std::vector<long> ghost_global = {})
      : comm_(comm), n_owned_(n_owned), ghost_global_(std::move(ghost_global)) {
    for (int n : comm_.all_gather(std::vector<int>{n_owned})) first_.push_back(first_.back() + n);
    check_ghosts();
    find_owners();
  }

  [[nodiscard]] const Communicator& communicator() const { return comm_; }
  [[nodiscard]] int n_owned() const { return n_owned_; }
  [[nodiscard]] int n_ghost() const { return static_cast<int>(ghost_global_.size()); }
  [[nodiscard]] int n_local() const { return n_owned_ + n_ghost(); }
  [[nodiscard]] long first_global() const { return first_[comm_.rank()]; }
  [[nodiscard]] long n_global() const { return first_.back(); }
  /// Global number of a local index, owned or ghost.
  [[nodiscard]] long global(int local) const {
    return local < n_owned_ ? first_global() + local : ghost_global_[local - n_owned_];
  }
  /// Rank that owns a global number.
  [[nodiscard]] int owner(long global) const {
    return static_cast<int>(std::upper_bound(first_.begin(), first_.end(), global) - first_.begin()) - 1;
  }
  /// First global number of each rank, then n_global: size() + 1 numbers.
  [[nodiscard]] const std::vector<long>& rank_offsets() const { return first_; }

  /// Copies the owners' entries to the ghosts. \param x n_local * block numbers. Collective among neighbours.
  template <class T>
  void update_ghosts(T* x, int block = 1) const {
    exchange(x, block, send_, receive_, [](T& to, const T& from) { to = from; });
  }

  /// Adds the ghosts' entries to the owners' (the transpose of update_ghosts); ghosts stay as they are.
  template <class T>
  void add_to_owners(T* x, int block = 1) const {
    exchange(x, block, receive_, send_, [](T& to, const T& from) { to += from; });
  }

  /// Sum over all ranks of x_i y_i over owned entries.
  [[nodiscard]] double dot(const double* x, const double* y, int block = 1) const {
    double sum = 0;
    const long n = static_cast<long>(n_owned_) * block;
    for (long i = 0; i < n; ++i) sum += x[i] * y[i];
    return comm_.sum(sum);
  }

 private:
  /// What is exchanged with one neighbour: local indices, in the order both sides agreed on.
  struct Neighbour {
    int rank;
    std::vector<int> indices;
  };

  void check_ghosts() const {
    std::string wrong;
    for (long g : ghost_global_)
      if (g < 0 || g >= n_global() || owner(g) == comm_.rank()) wrong = std::to_string(g);
    if (!comm_.any(!wrong.empty())) return;
    throw Error(ExitCode::configuration, "Layout: ghost number " +
                                             (wrong.empty() ? "(on another rank)" : wrong) +
                                             " is not owned by another rank; expected numbers in [0, " +
                                             std::to_string(n_global()) + ") outside those of this rank");
  }

  /// Each rank tells the owners of its ghosts which entries it wants.
  void find_owners() {
    const int n_ranks = comm_.size();
    std::vector<std::vector<long>> wanted(n_ranks);
    std::vector<std::vector<int>> place(n_ranks);
    for (int g = 0; g < n_ghost(); ++g) {
      const int rank = owner(ghost_global_[g]);
      wanted[rank].push_back(ghost_global_[g]);
      place[rank].push_back(n_owned_ + g);
    }
    std::vector<int> n_wanted(n_ranks), n_asked(n_ranks);
    for (int r = 0; r < n_ranks; ++r) n_wanted[r] = static_cast<int>(wanted[r].size());
    MPI_Alltoall(n_wanted.data(), 1, MPI_INT, n_asked.data(), 1, MPI_INT, comm_.handle());
    std::vector<std::vector<long>> asked(n_ranks);
    std::vector<MPI_Request> requests;
    for (int r = 0; r < n_ranks; ++r) {
      asked[r].resize(n_asked[r]);
      if (n_asked[r] > 0)
        MPI_Irecv(asked[r].data(), n_asked[r], MPI_LONG, r, tag, comm_.handle(), &requests.emplace_back());
      if (n_wanted[r] > 0)
        MPI_Isend(wanted[r].data(), n_wanted[r], MPI_LONG, r, tag, comm_.handle(), &requests.emplace_back());
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    for (int r = 0; r < n_ranks; ++r) {
      if (n_wanted[r] > 0) receive_.push_back({r, place[r]});
      if (n_asked[r] == 0) continue;
      Neighbour& to = send_.emplace_back(Neighbour{r, {}});
      for (long g : asked[r]) to.indices.push_back(static_cast<int>(g - first_global()));
    }
  }

  template <class T, class Combine>
  void exchange(T* x, int block, const std::vector<Neighbour>& from, const std::vector<Neighbour>& to,
                Combine combine) const {
    static_assert(std::is_trivially_copyable_v<T>);
    if (from.empty() && to.empty()) return;
    std::vector<MPI_Request> requests(from.size() + to.size());
    std::vector<std::vector<T>> out(from.size()), in(to.size());
    for (size_t k = 0; k < to.size(); ++k) {
      in[k].resize(to[k].indices.size() * block);
      MPI_Irecv(in[k].data(), static_cast<int>(in[k].size() * sizeof(T)), MPI_BYTE, to[k].rank, tag,
                comm_.handle(), &requests[k]);
    }
    for (size_t k = 0; k < from.size(); ++k) {
      out[k].reserve(from[k].indices.size() * block);
      for (int i : from[k].indices)
        for (int c = 0; c < block; ++c) out[k].push_back(x[static_cast<long>(i) * block + c]);
      MPI_Isend(out[k].data(), static_cast<int>(out[k].size() * sizeof(T)), MPI_BYTE, from[k].rank, tag,
                comm_.handle(), &requests[to.size() + k]);
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    for (size_t k = 0; k < to.size(); ++k) {
      const T* value = in[k].data();
      for (int i : to[k].indices)
        for (int c = 0; c < block; ++c) combine(x[static_cast<long>(i) * block + c], *value++);
    }
  }

  static constexpr int tag = 7101;
  Communicator comm_;
  int n_owned_ = 0;
  std::vector<long> ghost_global_;
  std::vector<long> first_{0};
  std::vector<Neighbour> send_, receive_;
};

}  // namespace ifsi
