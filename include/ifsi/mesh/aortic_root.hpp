#pragma once
/// \file
/// An idealised aortic root: a straight vessel along z with three sinuses behind the attachment lines of the
/// leaflets.

#include <cmath>
#include <numbers>
#include <string>

#include "ifsi/core/error.hpp"
#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// The shape of the wall. Three mid-leaflet planes at the angles 0, 120, 240 degrees, three commissures
/// between them. The attachment line of a leaflet is the section of the vessel with an inclined plane: it
/// begins at z = 0 in the mid-leaflet plane (the nadir) and reaches z = commissure at the commissures. Above
/// it, up to z = height, the wall bulges out by `lobe` radii in the middle of a sinus, by nothing at the
/// commissures: the attachment lines lie on the straight vessel (eq. 40).
struct AorticRoot {
  double radius = 1.4;      ///< of the straight vessel
  double height = 2.4;      ///< of the root, from the nadirs to the end of the sinuses
  double commissure = 1.2;  ///< height of the attachment lines at the commissures
  double lobe = 0.3;        ///< depth of a sinus over the radius

  static constexpr double third = 2.0 * std::numbers::pi / 3.0;

  /// \throws Error (configuration) when the numbers make no root.
  void check() const {
    if (radius > 0.0 && lobe >= 0.0 && lobe <= 1.0 && commissure > 0.0 && commissure < height) return;
    throw Error(ExitCode::configuration,
                "aortic root: found radius " + std::to_string(radius) + ", height " + std::to_string(height) +
                    ", commissures at " + std::to_string(commissure) + ", lobes of " + std::to_string(lobe) +
                    " radii; expected radius > 0, 0 < commissures < height, lobes of 0 to 1");
  }

  /// Angle to the nearest mid-leaflet plane, in [-60, 60] degrees.
  [[nodiscard]] static double from_mid_leaflet(double angle) {
    return angle - third * std::round(angle / third);
  }
  /// Height of the attachment line.
  [[nodiscard]] double attachment(double angle) const {
    return 2.0 * commissure * (1.0 - std::cos(from_mid_leaflet(angle)));
  }
  /// Part of the radius by which the wall bulges out: smooth, zero with its derivatives at both ends.
  [[nodiscard]] double bulge(double angle, double z) const {
    const double low = attachment(angle), s = (z - low) / (height - low);
    if (s <= 0.0 || s >= 1.0) return 0.0;
    const double along = std::sin(std::numbers::pi * s);
    return 0.5 * lobe * (1.0 + std::cos(3.0 * angle)) * along * along;
  }
  [[nodiscard]] double wall_radius(double angle, double z) const { return radius * (1.0 + bulge(angle, z)); }

  /// Takes a point of the straight vessel to the root: r -> r (1 + bulge r / radius), its angle and height
  /// kept, so that planes through the axis stay planes and the vessel's wall becomes the root's.
  [[nodiscard]] Vec<double, 3> map(const Vec<double, 3>& x) const {
    const double r = std::hypot(x[0], x[1]);
    const double stretch = 1.0 + bulge(std::atan2(x[1], x[0]), x[2]) * r / radius;
    return {stretch * x[0], stretch * x[1], x[2]};
  }
};

}  // namespace ifsi
