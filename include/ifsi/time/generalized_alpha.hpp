#pragma once
/// \file
/// Generalized-alpha for first-order systems (fluid) and second-order systems (solid), one parameter rho_inf.

#include <string>

#include "ifsi/core/error.hpp"

namespace ifsi {

/// Coefficients of one time step (eq. 8); alpha_m, alpha_f as in Jansen, Whiting & Hulbert (2000).
struct GeneralizedAlpha {
  double alpha_m = 1.0, alpha_f = 1.0, gamma = 1.0, beta = 0.5;

  /// From the spectral radius at infinite frequency, 0 <= rho_inf <= 1: 0 damps most (it is BDF2), 1 not at
  /// all. \throws Error (configuration) outside of that range.
  static GeneralizedAlpha from_rho_inf(double rho_inf) {
    if (!(rho_inf >= 0.0 && rho_inf <= 1.0))
      throw Error(ExitCode::configuration, "rho_inf = " + std::to_string(rho_inf) + " is outside [0, 1]");
    GeneralizedAlpha g;
    g.alpha_m = (3.0 - rho_inf) / (2.0 * (1.0 + rho_inf));
    g.alpha_f = 1.0 / (1.0 + rho_inf);
    g.gamma = 0.5 + g.alpha_m - g.alpha_f;
    g.beta = 0.25 * (1.0 + g.alpha_m - g.alpha_f) * (1.0 + g.alpha_m - g.alpha_f);
    return g;
  }
  /// First order and stiffly stable: the scheme of a start from data without a known acceleration.
  static GeneralizedAlpha backward_euler() { return {}; }

  /// d(dv/dt at alpha_m) / d(v at alpha_f) for unknowns at n+1 (eq. 9).
  [[nodiscard]] double c_inertia(double dt) const { return alpha_m / (alpha_f * gamma * dt); }

  /// Rate at n+1 that belongs to a value at n+1: the inverse of v_1 = v_0 + dt ((1 - gamma) r_0 + gamma r_1).
  [[nodiscard]] double rate(double value_1, double value_0, double rate_0, double dt) const {
    return (value_1 - value_0) / (gamma * dt) - (1.0 - gamma) / gamma * rate_0;
  }
};

}  // namespace ifsi
