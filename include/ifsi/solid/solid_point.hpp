#pragma once
/// \file
/// The immersed solid at one quadrature point: the physics of its weak form, line by line.
///
///     R(w) = int_V [ (rho_s - rho_f J) w.(a - g) + Grad w : (P_elastic + P_viscous) ] dV
///
/// over the reference volume V: the solid's own balance of momentum less that of the fluid which is solved
/// for everywhere, inside the solid too. rho_s dV is the conserved mass of the solid, rho_f J dV the fluid
/// mass in the volume it has now. P_viscous = J sigma_v F^-T pulls back sigma_v = 2 (mu_s - mu_f) eps(v), eps
/// in the *current* configuration.

#include "ifsi/material/tangent.hpp"

namespace ifsi {

/// Solid parameters beside the elastic law; consistent units of the user.
template <int dim>
struct SolidParameters {
  double rho_s = 1.0;          ///< density of the reference configuration
  double rho_f = 0.0;          ///< density of the fluid displaced; 0 for a solid alone
  double mu_f = 0.0;           ///< viscosity of the fluid displaced; 0 for a solid alone
  double mu_s = 0.0;           ///< viscosity of the solid itself (Kelvin-Voigt)
  Vec<double, dim> gravity{};  ///< body force per unit mass
};

/// Slopes of displacement, velocity and acceleration with respect to one unknown (a rate at the end of the
/// step, a displacement, ...): the tangent is their sum, u dR/du + v dR/dv + a dR/da.
struct StateSlopes {
  double u = 1.0;
  double v = 0.0;
  double a = 0.0;
};

/// Fields at one point. n = dim, or 3 for a body of revolution (r, z, theta).
template <class T, int n, int dim>
struct SolidPoint {
  Mat<T, n> F;       ///< deformation gradient
  Mat<T, n> Grad_v;  ///< velocity gradient in reference coordinates
  Vec<T, dim> a;     ///< acceleration
  T dV;              ///< reference volume element: weight, Jacobian and coordinate measure
};

/// The tensor in all three directions: in plane strain `third` is F_33 = 1 for deformation gradients.
template <class T, int n>
Mat<T, 3> in_space(const Mat<T, n>& F, double third) {
  if constexpr (n == 3) {
    return F;
  } else {
    return {F(0, 0), F(0, 1), T(0.0), F(1, 0), F(1, 1), T(0.0), T(0.0), T(0.0), T(third)};
  }
}

/// Viscous stress 2 eta eps(v): P = J sigma F^-T.
template <class T, int n>
Mat<T, n> viscous_piola(const Mat<T, n>& F, const Mat<T, n>& Grad_v, double eta) {
  const Mat<T, n> F_inv = inverse(F);
  const Mat<T, n> l = Grad_v * F_inv;  // spatial velocity gradient
  return T(eta * det(F)) * ((l + transpose(l)) * transpose(F_inv));
}

/// Tangent slopes.u dP/dF + slopes.v dP/d(Grad v) of viscous_piola, entry by entry. With G = F^-T and
/// sigma = eta (l + l^T):
///   dP/dF        = J [ (sigma G)_iJ G_kL - (sigma G)_iL G_kJ - eta ( l_ik (G^T G)_LJ + G_iL (l^T G)_kJ ) ]
///   dP/d(Grad v) = eta J [ delta_ik (G^T G)_JL + G_iL G_kJ ]
template <class T, int n>
class ViscousTangent {
 public:
  ViscousTangent(const Mat<T, n>& F, const Mat<T, n>& Grad_v, const T& eta, const StateSlopes& slopes) {
    const Mat<T, n> F_inv = inverse(F), l = Grad_v * F_inv;
    const T eta_J = eta * det(F), u = slopes.u * eta_J, v = slopes.v * eta_J;
    G_ = transpose(F_inv);
    C_inv_ = F_inv * G_;
    sigma_G_ = u * ((l + transpose(l)) * G_);
    lT_G_ = v * G_ - u * (transpose(l) * G_);
    l_ = v * Mat<T, n>::identity() - u * l;
  }
  T operator()(int i, int J, int k, int L) const {
    return sigma_G_(i, J) * G_(k, L) - sigma_G_(i, L) * G_(k, J) + l_(i, k) * C_inv_(J, L) +
           G_(i, L) * lT_G_(k, J);
  }

 private:
  Mat<T, n> G_, C_inv_, sigma_G_, lT_G_, l_;
};

}  // namespace ifsi
