#pragma once
/// \file
/// How the entries of a distributed vector are spread over the ranks, and the exchange of ghost entries.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "ifsi/core/communicator.hpp"

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
  Layout(Communicator comm, int n_owned, std::vector<long> ghost_global = {});

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
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t size = block * sizeof(T);
    const std::vector<std::byte> values = transfer(x, size, send_, receive_);
    const std::byte* value = values.data();
    for (const Neighbour& neighbour : receive_)
      for (int i : neighbour.indices) {
        std::memcpy(x + static_cast<long>(i) * block, value, size);
        value += size;
      }
  }

  /// Adds the ghosts' entries to the owners' (the transpose of update_ghosts); ghosts stay as they are.
  template <class T>
  void add_to_owners(T* x, int block = 1) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<std::byte> values = transfer(x, block * sizeof(T), receive_, send_);
    const std::byte* value = values.data();
    for (const Neighbour& neighbour : send_)
      for (int i : neighbour.indices)
        for (int c = 0; c < block; ++c, value += sizeof(T)) {
          T part;
          std::memcpy(&part, value, sizeof(T));
          x[static_cast<long>(i) * block + c] += part;
        }
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

  void check_ghosts() const;
  /// Each rank tells the owners of its ghosts which entries it wants.
  void find_owners();
  /// Sends the entries of x, `size` bytes each, to the neighbours `to`; returns what comes from `from`, in
  /// the order of its indices.
  [[nodiscard]] std::vector<std::byte> transfer(const void* x, std::size_t size,
                                                const std::vector<Neighbour>& to,
                                                const std::vector<Neighbour>& from) const;

  Communicator comm_;
  int n_owned_ = 0;
  std::vector<long> ghost_global_;
  std::vector<long> first_{0};
  std::vector<Neighbour> send_, receive_;
};

}  // namespace ifsi
