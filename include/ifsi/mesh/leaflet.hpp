#pragma once
/// \file
/// Leaflets of a semilunar valve: thin sheets of tensor cells.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ifsi/mesh/aortic_root.hpp"
#include "ifsi/mesh/box.hpp"

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

/// A leaflet as a mesh, and its lines b = constant on the side of the ventricle, from attachment to free
/// edge: nodes in order of a.
template <class Element>
struct LeafletMesh {
  GlobalMesh<Element> mesh;
  std::vector<std::vector<int>> lines;
};

/// The leaflet whose mid-leaflet plane is at `angle`, or the half of it at a >= 0, whose cut a = 0 lies
/// exactly in the plane y = 0. Neighbouring nodes are at most `spacing` apart. Boundaries cut (halves only),
/// commissure, attachment, free_edge, ventricle, aorta. Throws Error(configuration).
template <class Element>
LeafletMesh<Element> leaflet_mesh(const AorticRoot& root, const Leaflet& leaflet, double spacing, int layers,
                                  bool half, double angle = 0.0) {
  const LeafletSurface surface(root, leaflet);
  const auto extent = surface.extent();
  const auto cells = [&](double length) {
    return std::max(2, static_cast<int>(std::ceil(length / (Element::order * spacing))));
  };
  const int n_a = cells(extent[0]);
  LeafletMesh<Element> result;
  auto& mesh = result.mesh;
  mesh = box<Element>({half ? 0.0 : -1.0, 0.0, -0.5}, {1.0, 1.0, 0.5},
                      {half ? n_a : 2 * n_a, cells(extent[1]), layers});
  mesh.boundary_names = {
      half ? "cut" : "commissure_2", "commissure", "attachment", "free_edge", "ventricle", "aorta"};
  const int n_b = Element::order * cells(extent[1]);
  result.lines.resize(n_b + 1);
  for (int p = 0; p < mesh.n_points(); ++p)
    if (mesh.points[p][2] < -0.5 + 1e-9)
      result.lines[static_cast<int>(std::lround(n_b * mesh.points[p][1]))].push_back(p);
  for (auto& line : result.lines)
    std::sort(line.begin(), line.end(), [&](int p, int q) { return mesh.points[p][0] < mesh.points[q][0]; });
  const double cosine = std::cos(angle), sine = std::sin(angle);
  for (auto& x : mesh.points) {
    const double a = x[0], b = x[1];
    const auto y = surface.at(a, b) + leaflet.thickness * x[2] * surface.normal(a, b);
    x = {cosine * y[0] - sine * y[1], sine * y[0] + cosine * y[1], y[2]};
  }
  return result;
}

}  // namespace ifsi
