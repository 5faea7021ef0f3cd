#pragma once
/// \file
/// Gaps between surfaces that the fluid's mesh cannot resolve: what holds the fluid back in them (eq. 42).

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/coupling/friction.hpp"
#include "ifsi/coupling/point_tree.hpp"
#include "ifsi/coupling/surface_contact.hpp"

namespace ifsi {

/// Part of the full resistance at the gap g = s times the range: all of it up to half of the range, then down
/// to none by a cubic, so that nothing begins or ends with a jump.
[[nodiscard]] inline double seal_taper(double s) {
  const double t = std::clamp(2.0 * (1.0 - s), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Friction between bodies that are close to each other and the fluid between them. Every point of a
/// surface looks for the nearest one of another body, or of its image in a symmetry plane; half way
/// between them lies its gap point, where the fluid is dragged along with the mean velocity of the two.
///
/// Gap points are nodes for which the scene finds the fluid's velocity, as it does for those of the solid:
/// there is one per surface point, numbered in their order. A point with nothing near it keeps its own place
/// and feels nothing. Places and coefficients stay as they are for a step; forces are linear in the
/// velocities.
template <int dim>
class SurfaceSeal {
 public:
  using Point = Vec<double, dim>;
  using Block = Mat<double, dim>;

  /// Friction in one gap: of the nodes involved, and of what part of the velocity.
  struct Link {
    int point;               ///< surface point that found the gap
    int partner;             ///< the one it found, or -1: its image in a plane
    Friction<dim> friction;  ///< on all of the velocity, or on that along the plane
  };
  /// Forces of the fluid and the surfaces on each other at the n nodes of a link, gap point last, as a
  /// residual, and their slopes (n x n blocks, row by row).
  struct Term {
    double power;
    std::array<Point, 3> R;
    std::array<Block, 9> K;
  };

  /// \param range gap from which on there is none. \param resistance full one, force per area and velocity.
  SurfaceSeal(std::vector<SurfacePoint<dim>> points, double range, double resistance)
      : points_(std::move(points)), range_(range), resistance_(resistance) {}

  void add_mirror(const ContactPlane<dim>& plane) { mirrors_.push_back(plane); }
  [[nodiscard]] double range() const { return range_; }
  [[nodiscard]] int n_gap_points() const { return static_cast<int>(points_.size()); }
  /// Links of the last find(), in the order of their points.
  [[nodiscard]] const std::vector<Link>& links() const { return links_; }

  /// Finds the gaps anew. \param x positions of all solid nodes. \return places of the gap points
  std::vector<Point> find(std::span<const Point> x) {
    links_.clear();
    std::vector<Point> at;
    for (const auto& p : points_) at.push_back(x[p.node]);
    const PointTree<dim> tree(at);
    std::vector<Point> places = at;
    for (int i = 0; i < n_gap_points(); ++i) {
      const Gap gap = narrowest(i, at, tree);
      const double taper = seal_taper(gap.width / range_);
      if (taper == 0.0) continue;
      places[i] = gap.middle;
      links_.push_back({i, gap.partner, {0.5 * taper * resistance_ * points_[i].area, gap.direction}});
    }
    return places;
  }
  /// Leaves out the links whose gap points are no places in the fluid.
  template <class InFluid>
  void keep_links(InFluid&& in_fluid) {
    std::erase_if(links_, [&](const Link& link) { return !in_fluid(link.point); });
  }

  /// The nodes that a link couples: of the surfaces, and last the gap point, these numbered from first_gap
  /// on.
  [[nodiscard]] std::vector<int> nodes(const Link& link, int first_gap) const {
    if (link.partner < 0) return {points_[link.point].node, first_gap + link.point};
    return {points_[link.point].node, points_[link.partner].node, first_gap + link.point};
  }
  [[nodiscard]] int node(int point) const { return points_[point].node; }

  /// \param v velocities of the link's nodes, in their order.
  [[nodiscard]] static Term term(const Link& link, std::span<const Point> v) {
    const std::size_t n = v.size();
    std::array<double, 3> weight;
    weight.fill(-1.0 / static_cast<double>(n - 1));  // of the mean velocity of the surfaces
    weight[n - 1] = 1.0;
    Term term{};
    term.power = link.friction.add(std::span(weight).first(n), v, term.R, term.K);
    return term;
  }

 private:
  struct Gap {
    double width;
    int partner = -1;
    Point middle{};
    Block direction = Block::identity();
  };

  /// The narrowest gap beside a point; one as wide as the range when there is none.
  [[nodiscard]] Gap narrowest(int i, const std::vector<Point>& at, const PointTree<dim>& tree) const {
    Gap gap{range_};
    for (int j : tree.within(at[i], range_)) {  // the nearest first
      if (points_[i].body == points_[j].body) continue;
      gap = {std::sqrt(dot(at[j] - at[i], at[j] - at[i])), j, 0.5 * (at[i] + at[j]), Block::identity()};
      break;
    }
    for (const auto& mirror : mirrors_) {
      const double height = dot(at[i] - mirror.point, mirror.normal);
      if (const double width = 2.0 * std::max(height, 0.0); width < gap.width)
        gap = {width, -1, at[i] - height * mirror.normal,
               Block::identity() - outer(mirror.normal, mirror.normal)};
    }
    return gap;
  }

  std::vector<SurfacePoint<dim>> points_;
  double range_, resistance_;
  std::vector<ContactPlane<dim>> mirrors_;
  std::vector<Link> links_;
};

}  // namespace ifsi
