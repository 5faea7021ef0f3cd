#pragma once
/// \file
/// Flow physics as compile-time policies: a scene without convection or inertia does not pay for them.

#include <concepts>

#include "ifsi/fluid/rheology.hpp"
#include "ifsi/quadrature/coordinates.hpp"

namespace ifsi {

/// Which terms of the momentum balance exist.
template <class P>
concept FlowPhysics = requires {
  { P::convection } -> std::convertible_to<bool>;
};

/// Full incompressible Navier-Stokes.
struct NavierStokes {
  static constexpr bool convection = true;
};

/// Creeping flow: no convection, hence no SUPG, cross and Reynolds terms either.
struct Stokes {
  static constexpr bool convection = false;
};

/// The policies that fix the equations a fluid kernel solves (not the element, not the mesh).
template <FlowPhysics P = NavierStokes, FluidRheology R = Newtonian, class C = Cartesian>
struct FluidModel {
  using Physics = P;
  using Rheology = R;
  using Coordinates = C;
};

}  // namespace ifsi
