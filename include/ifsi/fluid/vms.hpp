#pragma once
/// \file
/// Residual-based variational multiscale form of incompressible flow at one quadrature point.
///
/// The residual is (eq. 3) and the tangent (eq. 7) of docs/equations.md, term by term. Everything is a
/// template on the number type: double for tests and single points, Pack<W> for W cells at once, an automatic
/// differentiation number for checking the tangent.

#include <cmath>

#include "ifsi/core/tensor.hpp"
#include "ifsi/fluid/physics.hpp"

namespace ifsi {

/// Parameters of the fluid that are the same everywhere during one assembly.
template <class Rheology>
struct FluidParameters {
  double rho = 1.0;        ///< density
  Rheology rheology{};     ///< gives mu
  double c_inertia = 0.0;  ///< d(dv/dt at alpha_m) / d(v at alpha_f), 1/time; 0 when steady (eq. 9)
  double tau_rate2 = 0.0;  ///< C_T / dt^2 in tau_M, 1/time^2; 0 when steady (eq. 4)
  double C_I = 36.0;       ///< inverse-estimate constant of tau_M: 36 for order 1, 60 for order 2 (eq. 4)
};

/// The fields at one quadrature point: velocity and pressure at alpha_f, acceleration at alpha_m.
template <class T, int dim>
struct FlowPoint {
  Vec<T, dim> v, v_dot, f;  ///< velocity, dv/dt, body force per unit mass
  Mat<T, dim> grad_v;       ///< grad_v(i, j) = d v_i / d x_j
  Vec<T, dim> lap_v;        ///< sum_j d^2 v_i / d x_j^2 (zero on linear simplices)
  T p;
  Vec<T, dim> grad_p;
  Mat<T, dim> G;  ///< element metric J^-T M J^-1 (eq. 6)
  T s;            ///< stabilisation scale near immersed solids, >= 1 (eq. 4)
  T k_p;          ///< scale of the PSPG term in cut cells (eq. 13); 1 elsewhere
  T radius;       ///< first coordinate; read by axisymmetric scenes only
  T JxW;          ///< quadrature weight times volume element
};

/// Trial function of one node at one point: what a change of its unknowns does to the fields there.
/// dr_M = D I + N E for the velocity (E belongs to the point), grad for the pressure.
template <class T, int dim>
struct TrialFunction {
  double N;
  Vec<T, dim> grad;
  T inertia;     ///< rho (c N + v . grad N)
  T D;           ///< inertia - mu lap N
  T tau_r_grad;  ///< tau_M r_M . grad N
};

/// Test function of one node at one point, the quadrature weight included, contracted once with everything
/// that does not depend on the trial function.
template <class T, int dim>
struct TestFunction {
  T N;
  Vec<T, dim> div;        ///< divergence operator: grad N (+ N / r in the radial component)
  Vec<T, dim> mu_grad;    ///< mu grad N
  Vec<T, dim> tau_C_div;  ///< rho tau_C div
  T tau_N;                ///< tau_M N, of the cross stress
  Mat<T, dim> A, B;       ///< A D + B N collects what is linear in dr_M = D I + N E, and v . grad w
  Vec<T, dim> q_D, q_N;   ///< the same for the PSPG term of the mass row
  /// d mu / d v of the other functions, through stress and strong residual; read by non-Newtonian scenes
  /// only.
  Vec<T, dim> viscosity_slope;
  T q_viscosity;
  T hoop;  ///< 2 mu N / r^2; read by axisymmetric scenes only
};

/// One quadrature point: strong residual, stabilisation, and the bilinear form between test and trial
/// functions.
template <class Model, class T, int dim>
class VmsPoint {
  static constexpr bool convection = Model::Physics::convection;
  static constexpr bool newtonian = Model::Rheology::newtonian;
  static constexpr bool axisymmetric = Model::Coordinates::axisymmetric;
  static constexpr int B = dim + 1;

 public:
  VmsPoint() = default;

  VmsPoint(const FlowPoint<T, dim>& x, const FluidParameters<typename Model::Rheology>& fluid)
      : v_(x.v), grad_v_(x.grad_v), p_(x.p), JxW_(x.JxW), rho_(fluid.rho) {
    using std::sqrt;
    two_eps_ = grad_v_ + transpose(grad_v_);
    div_v_ = trace(grad_v_);
    T shear_rate_squared = 0.5 * inner(two_eps_, two_eps_);
    lap_v_ = x.lap_v;
    if constexpr (axisymmetric) {
      inverse_r_ = T(1.0) / x.radius;
      const T hoop_rate = v_[0] * inverse_r_;
      div_v_ += hoop_rate;
      shear_rate_squared += 2.0 * hoop_rate * hoop_rate;
      for (int i = 0; i < dim; ++i) lap_v_[i] += inverse_r_ * grad_v_(i, 0);
      lap_v_[0] -= inverse_r_ * hoop_rate;
    }
    mu_ = fluid.rheology.viscosity(shear_rate_squared);
    if constexpr (!newtonian) slope_ = 2.0 * fluid.rheology.viscosity_slope(shear_rate_squared);

    inertia_ = rho_ * (x.v_dot - x.f);
    if constexpr (convection) inertia_ += rho_ * (grad_v_ * v_);
    const Vec<T, dim> r_M = inertia_ + x.grad_p - mu_ * lap_v_;

    const T nu = (1.0 / rho_) * mu_;
    T rate2 = fluid.tau_rate2 + fluid.C_I * nu * nu * inner(x.G, x.G);
    if constexpr (convection) rate2 += dot(v_, x.G * v_);
    tau_M_ = T(1.0) / sqrt(x.s * rate2);
    rho_tau_C_ = rho_ / (tau_M_ * trace(x.G));
    tau_r_ = tau_M_ * r_M;
    k_p_over_rho_ = (1.0 / rho_) * x.k_p;

    rho_c_ = rho_ * fluid.c_inertia;
    E_ = Mat<T, dim>::zero();
    if constexpr (convection) E_ = rho_ * grad_v_;
    if constexpr (axisymmetric) E_(0, 0) += mu_ * inverse_r_ * inverse_r_;
  }

  [[nodiscard]] T tau_M() const { return tau_M_; }
  [[nodiscard]] T rho_tau_C() const { return rho_tau_C_; }
  [[nodiscard]] T mu() const { return mu_; }
  [[nodiscard]] T JxW() const { return JxW_; }

  /// Trial function from N, its gradient and its Laplacian (in axisymmetric scenes without the 1/r part).
  [[nodiscard]] TrialFunction<T, dim> trial(double N, const Vec<T, dim>& grad, T lap) const {
    TrialFunction<T, dim> b;
    b.N = N;
    b.grad = grad;
    if constexpr (axisymmetric) lap += inverse_r_ * grad[0];
    b.inertia = rho_c_ * N;
    b.tau_r_grad = T(0.0);
    if constexpr (convection) {
      b.inertia += rho_ * dot(v_, grad);
      b.tau_r_grad = dot(tau_r_, grad);
    }
    b.D = b.inertia - mu_ * lap;
    return b;
  }

  /// Test function of the node that `b` is the trial function of.
  [[nodiscard]] TestFunction<T, dim> test(const TrialFunction<T, dim>& b) const {
    TestFunction<T, dim> a;
    a.N = JxW_ * b.N;
    const Vec<T, dim> w_grad = JxW_ * b.grad;
    a.div = w_grad;
    if constexpr (axisymmetric) a.div[0] += a.N * inverse_r_;
    if constexpr (axisymmetric) a.hoop = 2.0 * mu_ * inverse_r_ * inverse_r_ * a.N;
    a.mu_grad = mu_ * w_grad;
    a.tau_C_div = rho_tau_C_ * a.div;
    a.A = a.B = Mat<T, dim>::zero();
    if constexpr (convection) {
      const T supg = tau_M_ * dot(v_, w_grad);                         // v . grad w
      const T reynolds = (1.0 / rho_) * tau_M_ * dot(tau_r_, w_grad);  // grad w : (tau r (x) tau r) / rho
      for (int i = 0; i < dim; ++i) a.A(i, i) += supg - reynolds;
      a.A -= (tau_M_ * a.N) * grad_v_ +
             outer(((1.0 / rho_) * tau_M_) * tau_r_, w_grad);  // cross, Reynolds again
      a.B = outer(tau_r_, w_grad);                             // the increment of v in v . grad w
    }
    if constexpr (convection) a.B += a.A * E_ + (rho_ * a.N) * grad_v_;
    a.q_D = (k_p_over_rho_ * tau_M_) * w_grad;
    a.q_N = transpose(E_) * a.q_D;
    if constexpr (!newtonian) {
      a.viscosity_slope = slope_ * (JxW_ * shear_gradient(b) - a.A * lap_v_);
      a.q_viscosity = -slope_ * dot(a.q_D, lap_v_);
    }
    return a;
  }

  /// Adds the residual of a test function, b being the trial function of the same node: dim momentum rows,
  /// then the mass row (eq. 3).
  void add_residual(const TestFunction<T, dim>& a, const TrialFunction<T, dim>& b, Vec<T, B>& R) const {
    const Vec<T, dim> stress = two_eps_ * a.mu_grad;
    const T isotropic = rho_tau_C_ * div_v_ - p_;
    for (int i = 0; i < dim; ++i) R[i] += a.N * inertia_[i] + stress[i] + a.div[i] * isotropic;
    if constexpr (axisymmetric) R[0] += a.hoop * v_[0];
    if constexpr (convection) {
      const T supg = JxW_ * dot(v_, b.grad);
      const T reynolds = (1.0 / rho_) * JxW_ * b.tau_r_grad;
      const Vec<T, dim> cross = grad_v_ * tau_r_;
      for (int i = 0; i < dim; ++i) R[i] += (supg - reynolds) * tau_r_[i] - a.N * cross[i];
    }
    R[dim] += a.N * div_v_ + k_p_over_rho_ * JxW_ * dot(b.grad, tau_r_);
  }

  /// Adds the tangent block of a pair of functions (eq. 7): rows as the residual, columns (v, p) at alpha_f.
  [[gnu::always_inline]] void add_tangent(const TestFunction<T, dim>& a, const TrialFunction<T, dim>& b,
                                          Mat<T, B>& K) const {
    Vec<T, dim> b_div = b.grad;
    if constexpr (axisymmetric) b_div[0] += inverse_r_ * b.N;
    T isotropic = dot(a.mu_grad, b.grad) + a.N * b.inertia;
    if constexpr (convection) isotropic -= a.N * b.tau_r_grad;
    IFSI_UNROLL
    for (int i = 0; i < dim; ++i) {
      IFSI_UNROLL
      for (int j = 0; j < dim; ++j) {
        K(i, j) += a.A(i, j) * b.D;
        K(i, j) += a.B(i, j) * b.N;
        K(i, j) += a.mu_grad[j] * b.grad[i];
        K(i, j) += a.tau_C_div[i] * b_div[j];
        K(i, dim) += a.A(i, j) * b.grad[j];
      }
      K(i, i) += isotropic;
      K(i, dim) -= a.div[i] * b.N;
      K(dim, i) += a.N * b_div[i];
      K(dim, i) += a.q_D[i] * b.D;
      K(dim, i) += a.q_N[i] * b.N;
      K(dim, dim) += a.q_D[i] * b.grad[i];
    }
    if constexpr (axisymmetric) K(0, 0) += a.hoop * b.N;
    if constexpr (!newtonian) {
      const Vec<T, dim> shear_b = shear_gradient(b);
      for (int j = 0; j < dim; ++j) {
        for (int i = 0; i < dim; ++i) K(i, j) += a.viscosity_slope[i] * shear_b[j];
        K(dim, j) += a.q_viscosity * shear_b[j];
      }
    }
  }

 private:
  /// Half the derivative of gamma_dot^2 with respect to the nodal velocity of a function.
  [[nodiscard]] Vec<T, dim> shear_gradient(const TrialFunction<T, dim>& b) const {
    Vec<T, dim> g = two_eps_ * b.grad;
    if constexpr (axisymmetric) g[0] += 2.0 * v_[0] * inverse_r_ * inverse_r_ * b.N;
    return g;
  }

  Vec<T, dim> v_, lap_v_;
  Mat<T, dim> grad_v_;
  T p_, JxW_;
  double rho_;
  T mu_, slope_, rho_c_, tau_M_, rho_tau_C_, k_p_over_rho_, div_v_, inverse_r_;
  Vec<T, dim> inertia_, tau_r_;  ///< rho (dv/dt + v . grad v - f) and tau_M r_M
  Mat<T, dim> two_eps_, E_;
};

}  // namespace ifsi
