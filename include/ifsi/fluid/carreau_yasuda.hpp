#pragma once
/// \file
/// Shear-thinning rheology of Carreau and Yasuda.

#include <cmath>

#include "ifsi/fluid/rheology.hpp"

namespace ifsi {

/// mu = mu_inf + (mu_0 - mu_inf) (1 + (lambda gamma_dot)^a)^((n - 1) / a), as in Cho & Kensey (1991) for
/// blood.
struct CarreauYasuda {
  static constexpr bool newtonian = false;
  double mu_0 = 1.0, mu_inf = 1.0;  ///< dynamic viscosity at rest and at high shear rate
  double lambda = 1.0;              ///< time
  double a = 2.0, n = 1.0;
  /// Added to gamma_dot^2 [1/time^2]: keeps the slope finite in fluid at rest.
  double shear_rate_floor = 1e-12;

  template <class T>
  T viscosity(const T& shear_rate_squared) const {
    using std::pow;
    const T x = pow(T(lambda * lambda * (shear_rate_squared + shear_rate_floor)), 0.5 * a);
    return T(mu_inf + (mu_0 - mu_inf) * pow(T(1.0 + x), (n - 1.0) / a));
  }
  /// d mu / d(gamma_dot^2).
  template <class T>
  T viscosity_slope(const T& shear_rate_squared) const {
    using std::pow;
    const T s = shear_rate_squared + shear_rate_floor;
    const T x = pow(T(lambda * lambda * s), 0.5 * a);
    return T((0.5 * (n - 1.0) * (mu_0 - mu_inf)) * pow(T(1.0 + x), (n - 1.0) / a - 1.0) * x / s);
  }
};

static_assert(FluidRheology<CarreauYasuda>);

}  // namespace ifsi
