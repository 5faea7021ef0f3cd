/// \file
/// PointTree on nanoflann.

#include "ifsi/coupling/point_tree.hpp"

#include <nanoflann.hpp>
#include <utility>

namespace ifsi {
namespace {

/// The points, as nanoflann asks for them.
template <int dim>
struct Cloud {
  std::vector<Vec<double, dim>> points;

  [[nodiscard]] size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(size_t i, size_t axis) const {
    return points[i][static_cast<int>(axis)];
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

}  // namespace

template <int dim>
struct PointTree<dim>::Impl {
  using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud<dim>>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud<dim>, dim, int>;

  explicit Impl(std::vector<Vec<double, dim>> points)
      : cloud{std::move(points)}, tree(dim, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    tree.buildIndex();
  }

  Cloud<dim> cloud;
  Tree tree;
};

template <int dim>
PointTree<dim>::PointTree(std::vector<Vec<double, dim>> points) : impl_(new Impl(std::move(points))) {}

template <int dim>
PointTree<dim>::~PointTree() = default;

template <int dim>
PointTree<dim>::PointTree(PointTree&&) noexcept = default;

template <int dim>
PointTree<dim>& PointTree<dim>::operator=(PointTree&&) noexcept = default;

template <int dim>
std::vector<int> PointTree<dim>::within(const Vec<double, dim>& x, double radius) const {
  std::vector<std::pair<int, double>> found;
  // nanoflann's metric is the squared distance.
  impl_->tree.radiusSearch(x.data, radius * radius, found, nanoflann::SearchParams());
  std::vector<int> numbers;
  numbers.reserve(found.size());
  for (const auto& [number, distance] : found) numbers.push_back(number);
  return numbers;
}

template <int dim>
int PointTree<dim>::nearest(const Vec<double, dim>& x) const {
  int number = -1;
  double distance;
  impl_->tree.knnSearch(x.data, 1, &number, &distance);
  return number;
}

template class PointTree<2>;
template class PointTree<3>;

}  // namespace ifsi
