#pragma once
/// \file
/// A plane channel with a circular cylinder: rings of cells around the cylinder that turn into a square, and
/// graded rectangles from there to the walls, the inlet and the outlet.
///
///     +------+---------+------------------------------+
///     |      |         |                              |   walls
///     +------+---------+------------------------------+
///     |      | \     / |                              |
///     | inlet|   ( )   |  wake                        | outlet
///     |      | /     \ |                              |
///     +------+---------+------------------------------+
///     |      |         |                              |   walls
///     +------+---------+------------------------------+

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ifsi/mesh/axis.hpp"
#include "ifsi/mesh/reference_lattice.hpp"
#include "ifsi/mesh/split.hpp"
#include "ifsi/mesh/weld.hpp"

namespace ifsi {

/// Geometry and resolution. Lengths in the user's unit. The defaults are the channel of Schaefer and Turek
/// (1996), Benchmark computations of laminar flow around a cylinder, with about 2,900 cells.
struct CylinderChannel {
  double length = 2.2;
  double height = 0.41;
  Vec<double, 2> center = {0.2, 0.2};
  double radius = 0.05;
  double half_width = 0.1;       ///< of the square around the cylinder
  double first_layer = 0.00125;  ///< thickness of the cells at the cylinder
  int n_around = 64;             ///< cells around the cylinder, a multiple of 8
  int n_radial = 12;             ///< from the cylinder to the square
  int n_upstream = 5;            ///< from the inlet to the square
  int n_side = 5;                ///< from the square to either wall
  int n_downstream = 70;         ///< from the square (or the end of the band) to the outlet
  /// A band of equal cells behind the cylinder, for a wake or an immersed flag: center_y -+ band_half_height,
  /// from the square to x = band_end. No band when n_band_rows = 0; otherwise n_band_columns cells along it,
  /// n_band_rows across, and n_beside_band on either side of it to the corners of the square.
  double band_half_height = 0;
  double band_end = 0;
  int n_band_rows = 0;
  int n_band_columns = 0;
  int n_beside_band = 0;
  /// Of a flag in the middle of the band, fixed to the back of the cylinder: the lines of the mesh along it
  /// are straight from the cylinder on. No flag when 0.
  double flag_half_height = 0;
  /// The flag is rigid: a hole in the mesh from the cylinder to band_end, boundary "flag". It fills its band.
  bool cut_flag = false;

  /// Every cell count times a factor (rounded; n_around stays a multiple of 8), the first layer divided by
  /// it.
  [[nodiscard]] CylinderChannel refined(double factor) const {
    CylinderChannel r = *this;
    const auto scale = [factor](int n) {
      return n == 0 ? 0 : std::max(1, static_cast<int>(std::lround(n * factor)));
    };
    r.first_layer /= factor;
    r.n_around = 8 * std::max(1, static_cast<int>(std::lround(n_around / 8.0 * factor)));
    for (int CylinderChannel::*n :
         {&CylinderChannel::n_radial, &CylinderChannel::n_upstream, &CylinderChannel::n_side,
          &CylinderChannel::n_downstream, &CylinderChannel::n_band_rows, &CylinderChannel::n_band_columns,
          &CylinderChannel::n_beside_band})
      r.*n = scale(this->*n);
    return r;
  }
};

/// The section of the three-dimensional channel 3D-1Z of Schaefer and Turek: length 2.5, cylinder at (0.5,
/// 0.2).
inline CylinderChannel schaefer_turek_3d_section() {
  CylinderChannel c;
  c.length = 2.5;
  c.center = {0.5, 0.2};
  c.n_upstream = 12;
  return c;
}

/// The channel of Turek and Hron (2006) for an immersed flag: length 2.5, cylinder at (0.2, 0.2); a band of
/// equal cells holds the flag of 0.02 x 0.35 behind the cylinder, with four rows of cells over its thickness.
inline CylinderChannel turek_hron_channel() {
  CylinderChannel c;
  c.length = 2.5;
  c.band_half_height = 0.03;
  c.band_end = 0.64;
  c.n_band_rows = 12;
  c.n_band_columns = 56;
  c.n_beside_band = 7;
  c.n_downstream = 56;
  c.flag_half_height = 0.01;
  return c;
}

namespace detail {

/// Block structure of the channel with cells of the tensor type Element (order 1 or 2).
template <class Element>
class CylinderChannelBuilder {
 public:
  explicit CylinderChannelBuilder(const CylinderChannel& c) : c_(c) {
    validate();
    const double a = c.half_width;
    rings_ = axis_from_first_cell(c.radius, a, c.n_radial, c.first_layer);
    const Axis even = side_of_equal_angles();
    const double outer_ring = rings_.back() - rings_[c.n_radial - 1], corner = even[1] - even[0];
    bottom_ = shift(even, c.center[0]);
    left_ = shift(even, c.center[1]);
    right_ = shift(c.n_band_rows > 0 ? side_with_band() : even, c.center[1]);
    upstream_ = toward_lower(0, c.center[0] - a, c.n_upstream, outer_ring);
    below_ = toward_lower(0, c.center[1] - a, c.n_side, corner);
    above_ = toward_upper(c.center[1] + a, c.height, c.n_side, corner);
    downstream_ = downstream(outer_ring);
  }

  [[nodiscard]] GlobalMesh<Element> build() const {
    GlobalMesh<Element> mesh;
    add_rings(
        mesh, right_,
        [](double t) {
          return Vec<double, 2>{1, t};
        },
        c_.flag_half_height);
    add_rings(mesh, reversed(bottom_), [](double t) { return Vec<double, 2>{t, 1}; });
    add_rings(mesh, reversed(left_), [](double t) { return Vec<double, 2>{-1, t}; });
    add_rings(mesh, bottom_, [](double t) { return Vec<double, 2>{t, -1}; });
    for (const Axis* y : {&below_, &left_, &above_}) add_rectangle(mesh, upstream_, *y);
    for (const Axis* y : {&below_, &above_}) add_rectangle(mesh, bottom_, *y);
    for (const Axis* y : {&below_, &right_, &above_}) add_rectangle(mesh, downstream_, *y);
    weld(mesh, 1e-9 * c_.radius);
    if (c_.cut_flag) mesh = without_flag(std::move(mesh));
    name_boundaries(mesh);
    return mesh;
  }

 private:
  void validate() const {
    const auto fail = [](const std::string& what) {
      throw Error(ExitCode::configuration, "channel with cylinder: " + what);
    };
    const double a = c_.half_width;
    if (c_.n_around < 8 || c_.n_around % 8 != 0)
      fail("found n_around = " + std::to_string(c_.n_around) + "; expected a positive multiple of 8");
    if (!(c_.radius > 0 && a > 1.2 * c_.radius))
      fail("found radius " + std::to_string(c_.radius) + " in a square of half width " + std::to_string(a) +
           "; expected half_width > 1.2 radius > 0");
    if (!(c_.center[0] > a && c_.center[0] + a < c_.length && c_.center[1] > a &&
          c_.center[1] + a < c_.height))
      fail("the square around the cylinder, half width " + std::to_string(a) +
           ", does not fit into the channel");
    if (c_.n_band_rows > 0 &&
        !(c_.band_half_height > 0 && c_.band_half_height < a && c_.band_end > c_.center[0] + a &&
          c_.band_end < c_.length && c_.n_band_columns > 0 && c_.n_beside_band > 0))
      fail(
          "the band must be narrower than the square and end between the square and the outlet, with cells "
          "in it "
          "and beside it");
    if (!(c_.flag_half_height >= 0 && c_.flag_half_height < c_.radius))
      fail("found a flag of half height " + std::to_string(c_.flag_half_height) +
           "; expected less than the radius");
    if (c_.cut_flag &&
        !(c_.flag_half_height > 0 && c_.n_band_rows > 0 && c_.band_half_height == c_.flag_half_height))
      fail("a flag that is cut out must fill a band: expected band_half_height = flag_half_height > 0");
  }

  /// Whether a position is within the flag, its surface included.
  [[nodiscard]] bool in_flag(const Vec<double, 2>& x) const {
    const double tolerance = 1e-9 * c_.radius;
    return x[0] > c_.center[0] && x[0] < c_.band_end + tolerance &&
           std::abs(x[1] - c_.center[1]) < c_.flag_half_height + tolerance;
  }

  [[nodiscard]] GlobalMesh<Element> without_flag(GlobalMesh<Element> mesh) const {
    std::erase_if(mesh.cells, [&](const auto& cell) {
      return std::all_of(cell.begin(), cell.end(), [&](int p) { return in_flag(mesh.points[p]); });
    });
    std::vector<int> number(mesh.points.size(), -1);
    std::vector<Vec<double, 2>> points;
    for (auto& cell : mesh.cells)
      for (int& p : cell) {
        if (number[p] < 0) number[p] = static_cast<int>(points.size()), points.push_back(mesh.points[p]);
        p = number[p];
      }
    mesh.points = std::move(points);
    return mesh;
  }

  /// The band, if any, and the cells from there to the outlet.
  [[nodiscard]] Axis downstream(double first) const {
    const double begin = c_.center[0] + c_.half_width;
    if (c_.n_band_rows == 0) return toward_upper(begin, c_.length, c_.n_downstream, first);
    const double cell = (c_.band_end - begin) / c_.n_band_columns;
    return join(uniform_axis(begin, c_.band_end, c_.n_band_columns),
                toward_upper(c_.band_end, c_.length, c_.n_downstream, cell));
  }

  /// One side of the square about 0, divided by rays at equal angles.
  [[nodiscard]] Axis side_of_equal_angles() const {
    const int n = c_.n_around / 4;
    Axis y(n + 1);
    for (int i = 0; i <= n; ++i) y[i] = c_.half_width * std::tan((2.0 * i / n - 1) * std::numbers::pi / 4);
    y.front() = -c_.half_width;
    y.back() = c_.half_width;
    return y;
  }

  /// One side of the square about 0: the band in the middle, growing cells on either side.
  [[nodiscard]] Axis side_with_band() const {
    const double b = c_.band_half_height;
    const Axis upper = toward_upper(b, c_.half_width, c_.n_beside_band, 2 * b / c_.n_band_rows);
    return join(join(reflect(upper), uniform_axis(-b, b, c_.n_band_rows)), upper);
  }

  /// Cells that grow from the upper (lower) end, where they have the given length; equal ones if that is too
  /// long.
  static Axis toward_upper(double lower, double upper, int n, double first) {
    if (first * n >= upper - lower) return uniform_axis(lower, upper, n);
    return axis_from_first_cell(lower, upper, n, first);
  }
  static Axis toward_lower(double lower, double upper, int n, double last) {
    return reflect(toward_upper(-upper, -lower, n, last));
  }
  static Axis reversed(const Axis& axis) { return Axis(axis.rbegin(), axis.rend()); }

  /// Coordinate at s cells along an axis, s whole or half.
  static double at(const Axis& axis, double s) {
    const int i = std::min(static_cast<int>(s), static_cast<int>(axis.size()) - 2);
    return s == i ? axis[i] : s == i + 1 ? axis[i + 1] : 0.5 * (axis[i] + axis[i + 1]);
  }

  static void add_rectangle(GlobalMesh<Element>& mesh, const Axis& x, const Axis& y) {
    append_block(mesh, static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1,
                 [&](double s, double t) {
                   return Vec<double, 2>{at(x, s), at(y, t)};
                 });
  }

  /// The rings between the cylinder and one side of the square. `side` are coordinates along it,
  /// counterclockwise; corner(t) maps t = +-1 (relative coordinate along the side) onto the square of half
  /// width 1. Lines within `straight` of the middle of the side run straight to the cylinder.
  template <class Square>
  void add_rings(GlobalMesh<Element>& mesh, const Axis& side, Square&& square, double straight = 0) const {
    const int axis = square(0.5)[0] == 0.5 ? 0 : 1;  // the coordinate that varies along the side
    const auto on_square = [&](double s) {
      auto q = c_.center + c_.half_width * square(0);
      q[axis] = at(side, s);
      return q;
    };
    const auto angle = [&](double s) {
      const int i = static_cast<int>(s);
      const auto ray = [&](int j) {
        const auto q = on_square(j) - c_.center;
        return std::atan2(q[1], q[0]);
      };
      if (s == i) return ray(i);
      return ray(i) + 0.5 * std::remainder(ray(i + 1) - ray(i), 2 * std::numbers::pi);
    };
    append_block(mesh, c_.n_radial, static_cast<int>(side.size()) - 1, [&](double layer, double s) {
      const auto q = on_square(s);
      if (layer == c_.n_radial) return q;
      const double R = at(rings_, layer), phi = angle(s);
      const double blend = (R - c_.radius) / (c_.half_width - c_.radius);
      const auto direction = [&](double radius) {
        const double bent = bent_angle(phi, radius, straight);
        return Vec<double, 2>{std::cos(bent), std::sin(bent)};
      };
      // Rings near the cylinder are circles; the excess of the square over the last circle comes in
      // quadratically.
      const auto excess = q - c_.center - c_.half_width * direction(c_.half_width);
      return c_.center + R * direction(R) + blend * blend * excess;
    });
  }

  /// Angle at which the mesh line to the angle phi of the right side meets the circle of a radius: phi
  /// itself, unless lines within `straight` of the middle are to keep their distance from it.
  [[nodiscard]] double bent_angle(double phi, double radius, double straight) const {
    if (straight == 0) return phi;
    constexpr double corner = std::numbers::pi / 4;
    const double a = c_.half_width, edge = std::atan(straight / a), edge_here = std::asin(straight / radius);
    if (std::abs(phi) <= edge) return std::asin(a * std::tan(phi) / radius);
    const double part = (std::abs(phi) - edge) / (corner - edge);
    return std::copysign(edge_here + part * (corner - edge_here), phi);
  }

  void name_boundaries(GlobalMesh<Element>& mesh) const {
    mesh.boundary_names = {"inlet", "outlet", "walls", "cylinder"};
    if (c_.cut_flag) mesh.boundary_names.push_back("flag");
    const double tolerance = 1e-9 * c_.radius;
    mark_boundaries(mesh, [&](const Vec<double, 2>& x) {
      if (dot(x - c_.center, x - c_.center) < (1 + 1e-6) * c_.radius * c_.radius) return 3;
      if (c_.cut_flag && in_flag(x)) return 4;
      if (x[0] < tolerance) return 0;
      return x[0] > c_.length - tolerance ? 1 : 2;
    });
  }

  CylinderChannel c_;
  Axis rings_;                  ///< radii of the rings
  Axis bottom_, left_, right_;  ///< the sides of the square (top as bottom)
  Axis upstream_, downstream_, below_, above_;
};

}  // namespace detail

/// The channel with a cylinder, boundaries inlet, outlet, walls, cylinder (and flag, where one is cut out);
/// cells quads or triangles, of order 1 or 2. Nodes of order-2 cells lie exactly on the circle, and inside
/// follow the same smooth map. Throws Error(configuration) when the numbers do not make a channel.
template <class Element>
GlobalMesh<Element> channel_with_cylinder(const CylinderChannel& channel = {}) {
  auto quads = detail::CylinderChannelBuilder<BaseCell<Element>>(channel).build();
  if constexpr (is_tensor_cell<Element>) {
    return quads;
  } else {
    return split<Element>(quads, [&](int c) {
      const auto X = quads.cell_coordinates(c);
      const double first = dot(X[2] - X[0], X[2] - X[0]), second = dot(X[3] - X[1], X[3] - X[1]);
      const bool equal = std::abs(first - second) < 1e-6 * (first + second);
      return equal ? (X[0][1] + X[2][1]) / 2 > channel.center[1] : second < first;
    });
  }
}

}  // namespace ifsi
