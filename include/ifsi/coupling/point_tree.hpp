#pragma once
/// \file
/// A k-d tree over points in the plane or in space: the neighbours of a position without looking at every
/// point.

#include <memory>
#include <vector>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// The tree keeps its own copy of the points, numbered in the order given.
template <int dim>
class PointTree {
 public:
  explicit PointTree(std::vector<Vec<double, dim>> points);
  ~PointTree();
  PointTree(PointTree&&) noexcept;
  PointTree& operator=(PointTree&&) noexcept;

  /// Numbers of all points closer to x than `radius`, the nearest first.
  [[nodiscard]] std::vector<int> within(const Vec<double, dim>& x, double radius) const;
  /// Number of the point nearest to x, -1 in an empty tree.
  [[nodiscard]] int nearest(const Vec<double, dim>& x) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class PointTree<2>;
extern template class PointTree<3>;

}  // namespace ifsi
