#pragma once
/// \file
/// A duct whose flow begins from rest.

#include <algorithm>

#include "ifsi/simulation/flow_boundary.hpp"

namespace ifsi::test {

/// Of the box [0, L] x [0, 1] x [0, 1]: the inflow grows to its full size within 0.05.
inline FlowBoundary<3> duct() {
  FlowBoundary<3> boundary;
  boundary.velocity("left", [](const auto& x, double t) {
    return Vec<double, 3>{std::min(1.0, 20.0 * t) * 16.0 * x[1] * (1.0 - x[1]) * x[2] * (1.0 - x[2]), 0.0,
                          0.0};
  });
  boundary.traction_free("right");
  for (const char* wall : {"top", "bottom", "front", "back"}) boundary.no_slip(wall);
  return boundary;
}

}  // namespace ifsi::test
