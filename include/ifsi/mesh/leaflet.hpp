#pragma once
/// \file
/// Leaflets of a semilunar valve: thin sheets of tensor cells.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/mesh/aortic_root.hpp"
#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/surface_mesh.hpp"

namespace ifsi {

/// One leaflet in its unloaded, nearly closed shape: a surface over (a, b), symmetric about its mid-leaflet
/// plane a = 0. b runs from the attachment (0) to the free edge (1), a from -1 to 1 between the commissures.
/// The free edge is a hyperbola along the planes of the commissures, rounded in the middle. Attachment and
/// commissural edges lie outside of the vessel by `protrusion`: their nodes are held there.
struct Leaflet {
  double height = 1.6;       ///< of the commissures' top over the nadir
  double dip = 0.8;          ///< of the free edge in the middle below the commissures' top
  double thickness = 0.015;  ///<
  double gap = 0.03;         ///< distance of the free edge from the planes of the commissures
  double rounding = 0.04;    ///< of the free edge: half the width of the hyperbola's middle
  double coaptation = 0.35;  ///< height from which on the middle runs up to the free edge
  double protrusion = 0.05;  ///< of the attached edges into the wall
};

/// The surface in the middle of a leaflet.
class LeafletSurface {
 public:
  using Point = Vec<double, 3>;

  /// \throws Error (configuration) for numbers that make no leaflet in this root.
  LeafletSurface(const AorticRoot& root, const Leaflet& leaflet) : root_(root), leaflet_(leaflet) {
    root.check();
    check();
    rim_ = root.radius + leaflet.protrusion;
    double low = 0.0, high = rim_;  // the free edge leaves the cylinder of this radius between them
    for (int k = 0; k < 60; ++k) {
      const double y = 0.5 * (low + high);
      (std::hypot(free_edge_x(y), y) < rim_ ? low : high) = y;
    }
    y_end_ = low;
    angle_end_ = std::atan2(y_end_, free_edge_x(y_end_));
    const Point start = below_free_edge(0.0) - attachment(0.0);
    const double speed = std::sqrt(dot(start, start)), end = leaflet.coaptation;
    evenness_ = (speed - end) / (speed + end);
  }

  /// Lines a = constant are parabolas (eq. 40): they leave the attachment towards a point below the free edge
  /// and arrive there from that point. So not the edge alone but all lines near it reach to the axis.
  [[nodiscard]] Point at(double a, double b) const {
    const Point from = attachment(a), to = free_edge(a), corner = below_free_edge(a);
    const double t = b - evenness_ * b * (1.0 - b);
    return (1.0 - t) * (1.0 - t) * from + 2.0 * t * (1.0 - t) * corner + t * t * to;
  }
  /// Unit normal, to the side of the aorta.
  [[nodiscard]] Point normal(double a, double b) const {
    constexpr double d = 1e-5;
    const Point s = at(a + d, b) - at(a - d, b), t = at(a, b + d) - at(a, b - d);
    const Point n{s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]};
    return (1.0 / std::sqrt(dot(n, n))) * n;
  }
  /// Longest line a in [0, 1] at constant b, and longest line b in [0, 1].
  [[nodiscard]] std::array<double, 2> extent() const {
    constexpr int n = 50;
    std::array<double, 2> longest{};
    for (int i = 0; i <= n; ++i) {
      std::array<double, 2> length{};
      for (int k = 0; k < n; ++k) {
        const double c = static_cast<double>(i) / n, s = static_cast<double>(k) / n, e = s + 1.0 / n;
        const Point along_a = at(e, c) - at(s, c), along_b = at(c, e) - at(c, s);
        length[0] += std::sqrt(dot(along_a, along_a)), length[1] += std::sqrt(dot(along_b, along_b));
      }
      for (int d = 0; d < 2; ++d) longest[d] = std::max(longest[d], length[d]);
    }
    return longest;
  }

 private:
  /// Distance from the plane of the commissure at 60 degrees: gap + sqrt(rounding^2 + y^2 / 4) - y / 2.
  [[nodiscard]] double free_edge_x(double y) const {
    return (leaflet_.gap + std::sqrt(leaflet_.rounding * leaflet_.rounding + 0.25 * y * y)) /
           std::sin(std::numbers::pi / 3.0);
  }
  [[nodiscard]] Point free_edge(double a) const {
    const double y = a * y_end_;
    return {free_edge_x(y), y, leaflet_.height - (1.0 - a * a) * leaflet_.dip};
  }
  [[nodiscard]] Point below_free_edge(double a) const {
    // Half way up the commissural edge at its ends, where the parabola is that edge.
    const double edge = leaflet_.height - root_.attachment(angle_end_);
    return free_edge(a) - Point{0.0, 0.0, (1.0 - a * a) * leaflet_.coaptation + a * a * 0.5 * edge};
  }
  [[nodiscard]] Point attachment(double a) const {
    const double angle = a * angle_end_;
    return {rim_ * std::cos(angle), rim_ * std::sin(angle), root_.attachment(angle)};
  }
  void check() const {
    const Leaflet& l = leaflet_;
    if (l.thickness > 0.0 && l.gap > 0.5 * l.thickness && l.rounding > 0.0 && l.protrusion >= 0.0 &&
        l.coaptation > 0.0 && l.dip + l.coaptation < l.height && l.height > root_.commissure &&
        l.height < root_.height && l.dip >= 0.0 && l.gap + l.rounding < 0.5 * root_.radius)
      return;
    throw Error(
        ExitCode::configuration,
        "leaflet: found height " + std::to_string(l.height) + ", dip " + std::to_string(l.dip) +
            ", thickness " + std::to_string(l.thickness) + ", gap " + std::to_string(l.gap) + ", rounding " +
            std::to_string(l.rounding) + ", coaptation " + std::to_string(l.coaptation) + ", protrusion " +
            std::to_string(l.protrusion) + "; expected a height between the commissures (" +
            std::to_string(root_.commissure) + ") and the end of the root (" + std::to_string(root_.height) +
            "), a gap of more than half the thickness, gap + rounding below half the radius, dip "
            "and coaptation together below the height, a coaptation, dip and protrusion not negative");
  }

  AorticRoot root_;
  Leaflet leaflet_;
  double rim_, y_end_, angle_end_;
  double
      evenness_;  ///< of the nodes along b: the parabola of the middle is as fast at its end as at its start
};

/// A leaflet as a mesh, and its lines b = constant from attachment to free edge: nodes in order of a.
template <class Mesh>
struct LeafletMesh {
  Mesh mesh;
  std::vector<std::vector<int>> lines;
};

/// The numbers of cells along a and b that put the nodes of the longest line at most `spacing` apart in the
/// mean, and where a leaflet whose mid-leaflet plane is at `angle` has them. Half of one is its part at
/// a >= 0, whose cut a = 0 lies exactly in that plane.
class LeafletLattice {
 public:
  /// \param order of the cells. \throws Error (configuration) as LeafletSurface
  LeafletLattice(const AorticRoot& root, const Leaflet& leaflet, double spacing, int order, bool half,
                 double angle)
      : surface_(root, leaflet),
        thickness_(leaflet.thickness),
        order_(order),
        half_(half),
        cosine_(std::cos(angle)),
        sine_(std::sin(angle)) {
    const auto extent = surface_.extent();
    for (int d = 0; d < 2; ++d)
      cells_[d] = std::max(2, static_cast<int>(std::ceil(extent[d] / (order * spacing))));
    if (!half) cells_[0] *= 2;
  }
  [[nodiscard]] std::array<int, 2> cells() const { return cells_; }
  [[nodiscard]] double a_first() const { return half_ ? 0.0 : -1.0; }
  /// c from -1/2 on the side of the ventricle to 1/2 on that of the aorta.
  [[nodiscard]] Vec<double, 3> at(double a, double b, double c) const {
    const auto y = surface_.at(a, b) + thickness_ * c * surface_.normal(a, b);
    return {cosine_ * y[0] - sine_ * y[1], sine_ * y[0] + cosine_ * y[1], y[2]};
  }
  /// Those of the points (a, b, ..) that `on_lines` lets pass.
  template <int dim, class Filter>
  [[nodiscard]] std::vector<std::vector<int>> lines(const std::vector<Vec<double, dim>>& points,
                                                    Filter&& on_lines) const {
    const int n_b = order_ * cells_[1];
    std::vector<std::vector<int>> lines(n_b + 1);
    for (int p = 0; p < static_cast<int>(points.size()); ++p)
      if (on_lines(points[p])) lines[static_cast<int>(std::lround(n_b * points[p][1]))].push_back(p);
    for (auto& line : lines)
      std::sort(line.begin(), line.end(), [&](int p, int q) { return points[p][0] < points[q][0]; });
    return lines;
  }

 private:
  LeafletSurface surface_;
  double thickness_;
  int order_;
  bool half_;
  double cosine_, sine_;
  std::array<int, 2> cells_{};
};

/// A leaflet as a volume, or half of it. Boundaries cut (halves only), commissure, attachment, free_edge,
/// ventricle, aorta; lines on the side of the ventricle. Throws Error(configuration).
template <class Element>
LeafletMesh<GlobalMesh<Element>> leaflet_mesh(const AorticRoot& root, const Leaflet& leaflet, double spacing,
                                              int layers, bool half, double angle = 0.0) {
  const LeafletLattice lattice(root, leaflet, spacing, Element::order, half, angle);
  const auto [n_a, n_b] = lattice.cells();
  auto mesh = box<Element>({lattice.a_first(), 0.0, -0.5}, {1.0, 1.0, 0.5}, {n_a, n_b, layers});
  mesh.boundary_names = {
      half ? "cut" : "commissure_2", "commissure", "attachment", "free_edge", "ventricle", "aorta"};
  auto lines = lattice.lines(mesh.points, [](const auto& x) { return x[2] < -0.5 + 1e-9; });
  for (auto& x : mesh.points) x = lattice.at(x[0], x[1], x[2]);
  return {std::move(mesh), std::move(lines)};
}

/// The surface in the middle of a leaflet, or half of it, with the crosses of its lines, mirrored on the cut
/// of a half; its other edges have none. Throws Error(configuration).
template <class Element>
LeafletMesh<SurfaceMesh<Element>> leaflet_membrane(const AorticRoot& root, const Leaflet& leaflet,
                                                   double spacing, bool half, double angle = 0.0) {
  const LeafletLattice lattice(root, leaflet, spacing, Element::order, half, angle);
  const auto [n_a, n_b] = lattice.cells();
  const auto flat = box<Element>({lattice.a_first(), 0.0}, {1.0, 1.0}, {n_a, n_b});
  LeafletMesh<SurfaceMesh<Element>> result;
  result.lines = lattice.lines(flat.points, [](const auto&) { return true; });
  result.mesh.cells = flat.cells;
  for (const auto& x : flat.points) result.mesh.points.push_back(lattice.at(x[0], x[1], 0.0));
  const auto& lines = result.lines;
  if (half) {
    result.mesh.mirror_normal = {-std::sin(angle), std::cos(angle), 0.0};
    for (std::size_t j = 1; j + 1 < lines.size(); ++j)
      result.mesh.mirrored.push_back(
          {lines[j][0], lines[j][1], lines[j][1], lines[j - 1][0], lines[j + 1][0]});
  }
  for (std::size_t j = 1; j + 1 < lines.size(); ++j)
    for (std::size_t i = 1; i + 1 < lines[j].size(); ++i)
      result.mesh.crosses.push_back(
          {lines[j][i], lines[j][i - 1], lines[j][i + 1], lines[j - 1][i], lines[j + 1][i]});
  return result;
}

}  // namespace ifsi
