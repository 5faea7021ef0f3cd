#pragma once
/// \file
/// Elimination of prescribed unknowns, and of prescribed directions, from a distributed block system.

#include <algorithm>
#include <span>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Which unknowns of each local node are free: per node a symmetric projector P onto the values that they may
/// take (eq. 28). It is diagonal, of ones and zeros, where single unknowns are prescribed.
template <int B>
class Constraints {
 public:
  using Projector = Mat<double, B>;

  Constraints() = default;
  explicit Constraints(int n_nodes) : index_(n_nodes, -1) {}

  void set(int node, const Projector& P) {
    if (!constrained(node)) {
      index_[node] = static_cast<int>(projectors_.size());
      projectors_.emplace_back();
    }
    projectors_[index_[node]] = P;
  }
  /// Constrains velocity alone, the first B - 1 unknowns.
  void set_velocity(int node, const Mat<double, B - 1>& P) {
    Projector whole = Projector::identity();
    for (int i = 0; i < B - 1; ++i)
      for (int j = 0; j < B - 1; ++j) whole(i, j) = P(i, j);
    set(node, whole);
  }
  [[nodiscard]] bool constrained(int node) const { return index_[node] >= 0; }
  [[nodiscard]] Projector operator[](int node) const {
    return constrained(node) ? projectors_[index_[node]] : Projector::identity();
  }
  /// P of the velocity of a node.
  [[nodiscard]] Mat<double, B - 1> velocity(int node) const {
    const Projector whole = (*this)[node];
    Mat<double, B - 1> P;
    for (int i = 0; i < B - 1; ++i)
      for (int j = 0; j < B - 1; ++j) P(i, j) = whole(i, j);
    return P;
  }

  /// x_i <- P_i x_i for the first n_nodes nodes: residuals and updates lose what is prescribed.
  void project(int n_nodes, std::span<double> x) const {
    for (int node = 0; node < n_nodes; ++node) {
      if (!constrained(node)) continue;
      Vec<double, B> value;
      for (int i = 0; i < B; ++i) value[i] = x[node * B + i];
      value = projectors_[index_[node]] * value;
      for (int i = 0; i < B; ++i) x[node * B + i] = value[i];
    }
  }

  /// K_ij <- P_i K_ij P_j, and on the diagonal + Q D Q with D the diagonal of K_ii and Q = I - P: what is
  /// prescribed keeps the size of its neighbours, which leaves multigrid and norms undisturbed.
  /// Without `keep_diagonal` that goes too: for a matrix that is added to one that has it.
  void eliminate(BlockCsr<B>& K, bool keep_diagonal = true) const {
    for (int row = 0; row < K.n_rows(); ++row)
      for (int k = K.row_ptr()[row]; k < K.row_ptr()[row + 1]; ++k) {
        const int col = K.cols()[k];
        if (!constrained(row) && !constrained(col)) continue;
        Projector block;
        std::copy_n(K.at(k), B * B, block.data);
        Projector rest = (*this)[row] * block * (*this)[col];
        if (keep_diagonal && row == col) rest += prescribed_diagonal(row, block);
        std::copy_n(rest.data, B * B, K.at(k));
      }
  }

  /// The constraints of another layout whose first n_owned nodes are these, with more owned nodes perhaps and
  /// other ghosts. Call update_ghosts() once all its nodes are set.
  [[nodiscard]] Constraints carried_to(const Layout& layout, int n_owned) const {
    Constraints other(layout.n_local());
    for (int node = 0; node < n_owned; ++node)
      if (constrained(node)) other.set(node, (*this)[node]);
    return other;
  }
  /// Collective. Ghosts take over the projectors of their owners.
  void update_ghosts(const Layout& layout) {
    std::vector<Projector> all(layout.n_local());
    for (int node = 0; node < layout.n_owned(); ++node) all[node] = (*this)[node];
    layout.update_ghosts(all.data());
    for (int node = layout.n_owned(); node < layout.n_local(); ++node)
      if (!(all[node] == Projector::identity())) set(node, all[node]);
  }

 private:
  [[nodiscard]] Projector prescribed_diagonal(int node, const Projector& block) const {
    const Projector Q = Projector::identity() - (*this)[node];
    Projector D = Projector::zero();
    for (int i = 0; i < B; ++i) D(i, i) = block(i, i);
    return Q * D * Q;
  }

  std::vector<int> index_;  ///< of a node's projector, -1 when all of it is free
  std::vector<Projector> projectors_;
};

}  // namespace ifsi
