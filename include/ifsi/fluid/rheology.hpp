#pragma once
/// \file
/// Fluid rheologies: the dynamic viscosity as a function of the shear rate.

#include <concepts>

namespace ifsi {

/// A rheology gives the dynamic viscosity mu and its slope from the squared shear rate
/// gamma_dot^2 = 2 eps(v) : eps(v) [1/s^2]; a Newtonian one says so, and its slope is never evaluated.
template <class R>
concept FluidRheology = requires(const R& r, double shear_rate_squared) {
  { R::newtonian } -> std::convertible_to<bool>;
  { r.viscosity(shear_rate_squared) } -> std::convertible_to<double>;
  { r.viscosity_slope(shear_rate_squared) } -> std::convertible_to<double>;
};

/// Constant dynamic viscosity mu [mass / (length time)].
struct Newtonian {
  static constexpr bool newtonian = true;
  double mu = 1.0;

  template <class T>
  T viscosity(const T&) const {
    return T(mu);
  }
  template <class T>
  T viscosity_slope(const T&) const {
    return T(0.0);
  }
};

static_assert(FluidRheology<Newtonian>);

}  // namespace ifsi
