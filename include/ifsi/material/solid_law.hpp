#pragma once
/// \file
/// What a solid law offers. A new material is one header with these functions and one line in the driver.

#include <concepts>

#include "ifsi/material/tangent.hpp"

namespace ifsi {

namespace detail {
template <class L, int n, int dim>
concept SolidLawIn = requires(const L& law, const Mat<double, n>& F, const Vec<double, dim>& X) {
  { law.psi(F, X) } -> std::same_as<double>;
  { law.first_piola(F, X) } -> std::same_as<Mat<double, n>>;
  { law.tangent(F, X) } -> std::same_as<Tangent<double, n>>;
};
}  // namespace detail

/// A hyperelastic law. F is the deformation gradient at the reference point X:
/// 2 x 2 in plane strain (F_33 = 1 is understood), 3 x 3 in space, and 3 x 3 in the order (r, z, theta) for
/// a body of revolution, where X = (r, z). det F > 0 is the caller's business. Each function is a template
/// on the number type (double, Pack, dual numbers).
///   psi            stored energy per reference volume
///   first_piola    P = d psi / dF
///   tangent        dP / dF, see Tangent
///   young_modulus  at small strain; a scale for preconditioners and estimates, not for physics
template <class L>
concept SolidLaw = detail::SolidLawIn<L, 2, 2> && detail::SolidLawIn<L, 3, 3> &&
    detail::SolidLawIn<L, 3, 2> && requires(const L& law) {
  { law.young_modulus() } -> std::same_as<double>;
};

namespace detail {
template <class L, class... Directions>
concept SurfaceLawOf = requires(const L& law, const Mat<double, 3>& F, const Vec<double, 3>& X,
                                const Directions&... directions) {
  { law.relaxed(F, X, X) } -> std::same_as<Mat<double, 3>>;
  { law.psi(F, X, directions...) } -> std::same_as<double>;
  { law.first_piola(F, X, directions...) } -> std::same_as<Mat<double, 3>>;
  { law.tangent(F, X, directions...) } -> std::same_as<Tangent<double, 3>>;
  { law.young_modulus() } -> std::same_as<double>;
};
}  // namespace detail

/// A law of a surface in space, asked with its unit normal N: see PlaneStress.
///   relaxed        F in the plane, with the director that N turns into; the F of all others
template <class L>
concept SurfaceLaw = detail::SurfaceLawOf<L, Vec<double, 3>>;

/// The same of a surface with fibres, asked with their direction A and N: see TensionFibres.
template <class L>
concept FibredSurfaceLaw = detail::SurfaceLawOf<L, Vec<double, 3>, Vec<double, 3>>;

/// A law whose energy is an isochoric part, which sees J^(-1/3) F only, plus a volumetric part U(J).
/// Mean dilatation then replaces U(J) by U(theta) and leaves the rest alone.
template <class L>
concept UncoupledLaw = SolidLaw<L> && detail::SolidLawIn<typename L::Isochoric, 3, 3> &&
    requires(const L& law, double J) {
  { law.isochoric } -> std::convertible_to<typename L::Isochoric>;
  { law.volumetric.U(J) } -> std::same_as<double>;
  { law.volumetric.dU(J) } -> std::same_as<double>;
  { law.volumetric.ddU(J) } -> std::same_as<double>;
};

}  // namespace ifsi
