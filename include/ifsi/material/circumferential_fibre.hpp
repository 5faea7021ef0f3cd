#pragma once
/// \file
/// Fibres along circles about a point: the stress of the annulus benchmark.

#include "ifsi/material/moduli.hpp"
#include "ifsi/material/solid_law.hpp"

namespace ifsi {

/// S = mu e_Theta (x) e_Theta, psi = mu/2 (|F e_Theta|^2 - 1), with e_Theta the unit vector around `center`
/// in the plane of the first two coordinates of the *reference* configuration. The state F = I carries the
/// stress mu: such a body is in equilibrium only under a pressure jump.
class CircumferentialFibre {
 public:
  /// \throws Error (configuration) unless mu > 0.
  CircumferentialFibre(double mu, Vec<double, 2> center)
      : mu_(positive_modulus("fibre stress mu", mu)), center_(center) {}

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    const Vec<T, n> f = F * direction<T, n>(X);
    return T(0.5 * mu_ * (dot(f, f) - 1.0));
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    const Vec<T, n> e = direction<T, n>(X);
    return mu_ * outer(F * e, e);
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>&, const Vec<T, dim>& X) const {
    const Vec<T, n> e = direction<T, n>(X);
    Tangent<T, n> A = Tangent<T, n>::zero();
    add_geometric(A, mu_ * outer(e, e));
    return A;
  }
  [[nodiscard]] double young_modulus() const { return mu_; }

 private:
  template <class T, int n, int dim>
  Vec<T, n> direction(const Vec<T, dim>& X) const {
    using std::sqrt;
    const T x = X[0] - center_[0], y = X[1] - center_[1];
    const T r = sqrt(T(x * x + y * y));
    Vec<T, n> e = Vec<T, n>::zero();
    e[0] = -(y / r);
    e[1] = x / r;
    return e;
  }

  double mu_;
  Vec<double, 2> center_;
};

}  // namespace ifsi
