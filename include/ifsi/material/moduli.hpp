#pragma once
/// \file
/// Elastic moduli: conversion and the checks every law makes of its parameters.

#include <cmath>
#include <string>

#include "ifsi/core/error.hpp"

namespace ifsi {

/// The modulus itself when it is finite and positive.
/// \throws Error (configuration) otherwise, naming the modulus and its value.
inline double positive_modulus(const char* name, double value) {
  if (std::isfinite(value) && value > 0) return value;
  throw Error(ExitCode::configuration,
              std::string(name) + " = " + std::to_string(value) + ": expected a finite number > 0");
}

/// Lame's parameters, in units of stress.
struct Lame {
  double mu;
  double lambda;

  /// From Young's modulus and Poisson's ratio -1 < nu < 0.5.
  /// \throws Error (configuration) outside that range: at nu = 0.5 lambda is infinite.
  static Lame from_young(double E, double nu) {
    positive_modulus("Young's modulus E", E);
    if (!(nu > -1 && nu < 0.5))
      throw Error(ExitCode::configuration,
                  "Poisson's ratio nu = " + std::to_string(nu) +
                      ": expected -1 < nu < 0.5 (for an incompressible solid take an uncoupled law with mean "
                      "dilatation and a large bulk modulus)");
    return {E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))};
  }
  /// From the shear modulus and Poisson's ratio.
  static Lame from_shear(double mu, double nu) {
    return from_young(2 * positive_modulus("shear modulus mu", mu) * (1 + nu), nu);
  }
  /// The same parameters when they describe a stable solid: mu > 0 and bulk modulus > 0.
  /// \throws Error (configuration) otherwise.
  [[nodiscard]] Lame checked() const {
    positive_modulus("shear modulus mu", mu);
    positive_modulus("bulk modulus lambda + 2 mu / 3", bulk_modulus());
    return *this;
  }
  [[nodiscard]] double bulk_modulus() const { return lambda + 2 * mu / 3; }
  [[nodiscard]] double young_modulus() const { return mu * (3 * lambda + 2 * mu) / (lambda + mu); }
};

/// Young's modulus of a solid with shear modulus mu and bulk modulus kappa.
constexpr double young_modulus(double mu, double kappa) { return 9 * kappa * mu / (3 * kappa + mu); }

}  // namespace ifsi
