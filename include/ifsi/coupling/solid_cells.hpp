#pragma once
/// \file
/// The solid's cells as C sees them: which solid nodes each of them couples.

#include <array>
#include <span>
#include <vector>

namespace ifsi {

/// Cells of any kinds, bodies and sizes in one list; each is a list of solid nodes, the numbers of
/// Interpolation.
class SolidCells {
 public:
  /// Appends cells of one kind. \param first_node added to every node number: where this body's nodes begin.
  template <std::size_t n>
  void append(const std::vector<std::array<int, n>>& cells, int first_node = 0) {
    for (const auto& cell : cells) {
      for (int a : cell) nodes_.push_back(first_node + a);
      offsets_.push_back(static_cast<int>(nodes_.size()));
    }
  }
  void append(std::span<const int> cell) {
    nodes_.insert(nodes_.end(), cell.begin(), cell.end());
    offsets_.push_back(static_cast<int>(nodes_.size()));
  }
  /// Keeps the first n cells.
  void truncate(int n) {
    offsets_.resize(n + 1);
    nodes_.resize(offsets_.back());
  }
  bool operator==(const SolidCells&) const = default;
  [[nodiscard]] int size() const { return static_cast<int>(offsets_.size()) - 1; }
  [[nodiscard]] std::span<const int> operator[](int cell) const {
    return {nodes_.data() + offsets_[cell], nodes_.data() + offsets_[cell + 1]};
  }

 private:
  std::vector<int> offsets_{0}, nodes_;
};

}  // namespace ifsi
