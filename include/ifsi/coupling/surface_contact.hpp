#pragma once
/// \file
/// Contact of solids with each other, with themselves and with rigid planes: repulsion between the points of
/// their surfaces.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/coupling/point_tree.hpp"
#include "ifsi/solid/contact_potential.hpp"

namespace ifsi {

/// A solid node on a surface.
template <int dim>
struct SurfacePoint {
  int node, body;
  double area;         ///< its part of the reference surface
  Vec<double, dim> X;  ///< where it is undeformed
};

/// A plane that surfaces may not pass.
template <int dim>
struct ContactPlane {
  Vec<double, dim> point, normal;  ///< the unit normal points to where the solids are
  bool mirror = false;             ///< of symmetry: what touches is the mirror image, twice as far away
};

/// Sum of the repulsion of all pairs of surface points (eq. 32) and of points and planes (eq. 34). Points of
/// one body that are neighbours on its surface, no further apart than the range undeformed, do not repel; the
/// range of points of two bodies is no longer than their distance undeformed, so that nothing is under load
/// at first.
///
/// Pairs within the range and a margin are listed; the list serves until points have moved by half of the
/// margin. Everything is a function of the positions of all nodes, which all ranks hold.
template <int dim>
class SurfaceContact {
 public:
  using Point = Vec<double, dim>;
  using Block = Mat<double, dim>;

  /// Energy of one contact, its gradient R and second derivatives K (n x n blocks, row by row) at its n
  /// nodes.
  struct Term {
    double energy = 0.0, distance;
    std::array<Point, 2> R;
    std::array<Block, 4> K;
  };
  struct Totals {
    double energy = 0.0;
    double gap;  ///< smallest distance of a contact, at most the range
  };

  /// \param range where repulsion begins. \param pressure of flat surfaces half of the range apart.
  SurfaceContact(std::vector<SurfacePoint<dim>> points, double range, double pressure)
      : points_(std::move(points)), range_(range), pressure_(pressure) {}

  void add_plane(const ContactPlane<dim>& plane) { planes_.push_back(plane), listed_at_.clear(); }
  [[nodiscard]] double range() const { return range_; }

  /// Lists the contacts anew if points have moved too far for the old list, and says whether it is another.
  /// \param x positions of all solid nodes.
  bool update(std::span<const Point> x) {
    if (is_listed(x)) return false;
    listed_at_ = at(x);
    const List old = std::exchange(list_, find(x));
    return list_ != old;
  }
  /// The nodes of the listed contacts: pairs of nodes first, then nodes near planes.
  [[nodiscard]] std::vector<std::array<int, 2>> pairs() const {
    std::vector<std::array<int, 2>> nodes;
    for (const Pair& p : list_.pairs) nodes.push_back({points_[p.i].node, points_[p.j].node});
    return nodes;
  }
  [[nodiscard]] std::vector<std::array<int, 1>> singles() const {
    std::vector<std::array<int, 1>> nodes;
    for (const Single& s : list_.singles) nodes.push_back({points_[s.i].node});
    return nodes;
  }

  /// Contact k of the list: pairs first, then singles.
  [[nodiscard]] Term term(int k, std::span<const Point> x) const {
    const int n_pairs = static_cast<int>(list_.pairs.size());
    return k < n_pairs ? term(list_.pairs[k], x) : term(list_.singles[k - n_pairs], x);
  }

  /// At any positions, listed or not.
  [[nodiscard]] Totals totals(std::span<const Point> x) const {
    Totals sum{0.0, range_};
    const auto add = [&](const Term& t) { sum.energy += t.energy, sum.gap = std::min(sum.gap, t.distance); };
    const List list = is_listed(x) ? list_ : find(x);
    for (const Pair& p : list.pairs) add(term(p, x));
    for (const Single& s : list.singles) add(term(s, x));
    return sum;
  }

 private:
  struct Pair {
    int i, j;  ///< points
    double range;
    bool operator==(const Pair&) const = default;
  };
  struct Single {
    int i, plane;
    bool operator==(const Single&) const = default;
  };
  struct List {
    std::vector<Pair> pairs;
    std::vector<Single> singles;
    bool operator==(const List&) const = default;
  };

  [[nodiscard]] double margin() const { return 0.5 * range_; }
  [[nodiscard]] static double distance(const Point& a, const Point& b) {
    return std::sqrt(dot(a - b, a - b));
  }
  [[nodiscard]] static double height(const Point& x, const ContactPlane<dim>& plane) {
    return (plane.mirror ? 2.0 : 1.0) * dot(x - plane.point, plane.normal);
  }

  [[nodiscard]] std::vector<Point> at(std::span<const Point> x) const {
    std::vector<Point> positions;
    for (const auto& p : points_) positions.push_back(x[p.node]);
    return positions;
  }
  [[nodiscard]] bool is_listed(std::span<const Point> x) const {
    if (listed_at_.size() != points_.size()) return false;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!(distance(x[points_[i].node], listed_at_[i]) <= 0.5 * margin())) return false;
    return true;
  }

  [[nodiscard]] List find(std::span<const Point> x) const {
    List list;
    const double reach = range_ + margin();
    const std::vector<Point> positions = at(x);
    const PointTree<dim> tree(positions);
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      std::vector<int> near = tree.within(positions[i], reach);
      std::sort(near.begin(), near.end());
      for (int j : near)
        if (const double range = j > i ? range_of(points_[i], points_[j]) : 0.0; range > 0.0)
          list.pairs.push_back({i, j, range});
      for (int k = 0; k < static_cast<int>(planes_.size()); ++k)
        if (height(points_[i].X, planes_[k]) > range_ && height(positions[i], planes_[k]) < reach)
          list.singles.push_back({i, k});
    }
    return list;
  }
  /// 0 for points that do not repel.
  [[nodiscard]] double range_of(const SurfacePoint<dim>& a, const SurfacePoint<dim>& b) const {
    const double apart = distance(a.X, b.X);
    if (a.body == b.body) return apart > range_ ? range_ : 0.0;
    return std::min(apart, range_);
  }

  [[nodiscard]] Term term(const Pair& p, std::span<const Point> x) const {
    const auto &a = points_[p.i], &b = points_[p.j];
    const Point d = x[a.node] - x[b.node];
    const double r = std::sqrt(dot(d, d)), w = a.area * b.area;
    const Potential phi = point_repulsion<dim>(r, p.range, pressure_);
    const Point n = (1.0 / r) * d;
    const Block H =
        (w * (phi.curvature - phi.slope / r)) * outer(n, n) + (w * phi.slope / r) * Block::identity();
    const Point R = (w * phi.slope) * n;
    return {w * phi.value, r, {R, -1.0 * R}, {H, -1.0 * H, -1.0 * H, H}};
  }
  /// Of a mirror image: half of the energy of both.
  [[nodiscard]] Term term(const Single& s, std::span<const Point> x) const {
    const auto& plane = planes_[s.plane];
    const double d = height(x[points_[s.i].node], plane), w = points_[s.i].area;
    const double image = plane.mirror ? 2.0 : 1.0;
    const Potential psi = plane_repulsion(d, range_, pressure_);
    return {w / image * psi.value,
            d,
            {(w * psi.slope) * plane.normal, Point::zero()},
            {(w * image * psi.curvature) * outer(plane.normal, plane.normal)}};
  }

  std::vector<SurfacePoint<dim>> points_;
  double range_, pressure_;
  std::vector<ContactPlane<dim>> planes_;
  List list_;
  std::vector<Point> listed_at_;  ///< the points when the list was made
};

}  // namespace ifsi
