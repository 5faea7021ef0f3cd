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
  Vec<T, dim> v;             ///< velocity
  Vec<T, dim> acceleration;  ///< dv/dt - f, f the body force per unit mass
  Mat<T, dim> grad_v;        ///< grad_v(i, j) = d v_i / d x_j
  Vec<T, dim> lap_v;         ///< sum_j d^2 v_i / d x_j^2 (zero on linear simplices)
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
  T transport;  ///< rho (c N + (v + v') . grad N), v' of (eq. 2)
  T D;          ///< rho (c N + v . grad N) - mu lap N
};

/// Test function of one node at one point, the quadrature weight included, contracted once with everything
/// that does not depend on the trial function.
template <class T, int dim>
struct TestFunction {
  T N;
  Vec<T, dim> div;        ///< divergence operator: grad N (+ N / r in the radial component)
  Vec<T, dim> mu_grad;    ///< mu grad N
  Vec<T, dim> tau_C_div;  ///< rho tau_C div
  Mat<T, dim> A, B;       ///< A D + B N collects what is linear in dr_M = D I + N E, and v . grad w
  Vec<T, dim> q_D, q_N;   ///< the same for the PSPG term of the mass row
  /// d mu / d v of the other functions, through stress and strong residual; read by non-Newtonian scenes
  /// only.
  Vec<T, dim> viscosity_slope;
  T q_viscosity;
  T hoop;  ///< 2 mu N / r^2; read by axisymmetric scenes only

  /// Adds what add_tangent_of_gradients reads: where the gradients of the trial functions are constant,
  /// these terms need only the sum over the points.
  [[gnu::always_inline]] void add_factors_of_gradients(const TestFunction& a) {
    N += a.N;
    mu_grad += a.mu_grad;
    tau_C_div += a.tau_C_div;
    A += a.A;
    q_D += a.q_D;
  }
};

/// One quadrature point: strong residual, stabilisation, and the bilinear form between test and trial
/// functions. Inlined throughout, so that the sums over points stay in registers.
template <class Model, class T, int dim>
class VmsPoint {
  static constexpr bool convection = Model::Physics::convection;
  static constexpr bool newtonian = Model::Rheology::newtonian;
  static constexpr bool axisymmetric = Model::Coordinates::axisymmetric;
  static constexpr int B = dim + 1;
  using Parameters = FluidParameters<typename Model::Rheology>;

 public:
  VmsPoint() = default;

  [[gnu::always_inline]] VmsPoint(const FlowPoint<T, dim>& x, const Parameters& fluid)
      : JxW_(x.JxW), rho_(fluid.rho) {
    copy(x.v, v_);
    copy(x.lap_v, lap_v_);
    copy(x.grad_v, grad_v_);
    set_strain(x, fluid);
    Vec<T, dim> inertia = rho_ * x.acceleration;
    if constexpr (convection) inertia += rho_ * (grad_v_ * v_);
    const Vec<T, dim> r_M = inertia + x.grad_p - mu_ * lap_v_;
    set_stabilisation(x, fluid);
    const Vec<T, dim> tau_r = tau_M_ * r_M;
    fine_v_ = (-1.0 / rho_) * tau_r;
    advecting_v_ = v_ + fine_v_;
    set_linearisation(fluid);
    set_residual(inertia, tau_r, x.p);
  }

  [[nodiscard]] T tau_M() const { return tau_M_; }
  [[nodiscard]] T rho_tau_C() const { return rho_tau_C_; }
  [[nodiscard]] T mu() const { return mu_; }
  [[nodiscard]] T JxW() const { return JxW_; }

  /// Trial function from N, its gradient and its Laplacian (in axisymmetric scenes without the 1/r part).
  [[nodiscard, gnu::always_inline]] TrialFunction<T, dim> trial(double N, const Vec<T, dim>& grad,
                                                                T lap) const {
    TrialFunction<T, dim> b;
    b.N = N;
    copy(grad, b.grad);
    if constexpr (axisymmetric) lap += inverse_r_ * grad[0];
    b.transport = b.D = T(rho_c_ * N);
    if constexpr (convection) {
      b.transport += rho_ * dot(advecting_v_, grad);
      b.D += rho_ * dot(v_, grad);
    }
    b.D -= mu_ * lap;
    return b;
  }

  /// Test function of the node that `b` is the trial function of.
  [[nodiscard, gnu::always_inline]] TestFunction<T, dim> test(const TrialFunction<T, dim>& b) const {
    TestFunction<T, dim> a;
    a.N = JxW_ * b.N;
    const Vec<T, dim> grad = JxW_ * b.grad, tau_grad = tau_M_ * grad;
    const Vec<T, dim> tau_grad_E = times_E(tau_grad);
    copy(grad, a.div);
    if constexpr (axisymmetric) a.div[0] += a.N * inverse_r_;
    if constexpr (axisymmetric) a.hoop = 2.0 * mu_ * inverse_r_ * inverse_r_ * a.N;
    a.mu_grad = mu_ * grad;
    a.tau_C_div = rho_tau_C_ * a.div;
    if constexpr (convection) {
      const T advection = dot(advecting_v_, tau_grad);            // SUPG and Reynolds
      a.A = outer(fine_v_, tau_grad) - (tau_M_ * a.N) * grad_v_;  // Reynolds again, cross
      add_to_diagonal(a.A, advection);
      a.B = outer(fine_v_, tau_grad_E - rho_ * grad) + a.N * value_slope_ + (rho_ * advection) * grad_v_;
      if constexpr (axisymmetric) a.B(0, 0) += advection * E_rr_;
    } else {
      a.A = a.B = Mat<T, dim>::zero();
    }
    a.q_D = k_p_over_rho_ * tau_grad;
    a.q_N = k_p_over_rho_ * tau_grad_E;
    if constexpr (!newtonian) {
      a.viscosity_slope = slope_ * (JxW_ * shear_gradient(b) - a.A * lap_v_);
      a.q_viscosity = -slope_ * dot(a.q_D, lap_v_);
    }
    return a;
  }

  /// Adds the residual of the node that `b` is the trial function of: dim momentum rows, then the mass row
  /// (eq. 3).
  [[gnu::always_inline]] void add_residual(const TrialFunction<T, dim>& b, Vec<T, B>& R) const {
    IFSI_UNROLL
    for (int i = 0; i < dim; ++i) {
      R[i] += b.N * momentum_source_[i];
      IFSI_UNROLL
      for (int j = 0; j < dim; ++j) R[i] += momentum_flux_(i, j) * b.grad[j];
      R[dim] += mass_flux_[i] * b.grad[i];
    }
    R[dim] += b.N * mass_source_;
  }

  /// Adds to the tangent block of a pair of functions (eq. 7) what multiplies N_b and D_b: rows as the
  /// residual, columns (v, p) at alpha_f. `diagonal` collects what belongs on the diagonal of the velocity.
  [[gnu::always_inline]] void add_tangent_of_values(const TestFunction<T, dim>& a,
                                                    const TrialFunction<T, dim>& b, Mat<T, B>& K,
                                                    T& diagonal) const {
    diagonal += a.N * b.transport;
    IFSI_UNROLL
    for (int i = 0; i < dim; ++i) {
      if constexpr (convection) {
        IFSI_UNROLL
        for (int j = 0; j < dim; ++j) {
          K(i, j) += a.A(i, j) * b.D;
          K(i, j) += a.B(i, j) * b.N;
        }
      }
      K(i, dim) -= a.div[i] * b.N;
      K(dim, i) += a.q_D[i] * b.D;
      K(dim, i) += a.q_N[i] * b.N;
    }
    if constexpr (axisymmetric) K(0, 0) += a.hoop * b.N;
    if constexpr (!newtonian) {
      const Vec<T, dim> shear_b = shear_gradient(b);
      IFSI_UNROLL
      for (int j = 0; j < dim; ++j) {
        IFSI_UNROLL
        for (int i = 0; i < dim; ++i) K(i, j) += a.viscosity_slope[i] * shear_b[j];
        K(dim, j) += a.q_viscosity * shear_b[j];
      }
    }
  }

  /// Adds the rest of the block: what multiplies grad N_b.
  [[gnu::always_inline]] void add_tangent_of_gradients(const TestFunction<T, dim>& a,
                                                       const TrialFunction<T, dim>& b, Mat<T, B>& K,
                                                       T& diagonal) const {
    Vec<T, dim> b_div = b.grad;
    if constexpr (axisymmetric) b_div[0] += inverse_r_ * b.N;
    IFSI_UNROLL
    for (int i = 0; i < dim; ++i) {
      diagonal += a.mu_grad[i] * b.grad[i];
      IFSI_UNROLL
      for (int j = 0; j < dim; ++j) {
        K(i, j) += a.mu_grad[j] * b.grad[i];
        K(i, j) += a.tau_C_div[i] * b_div[j];
        if constexpr (convection) K(i, dim) += a.A(i, j) * b.grad[j];
      }
      K(dim, i) += a.N * b_div[i];
      K(dim, dim) += a.q_D[i] * b.grad[i];
    }
  }

 private:
  /// Strain rate, viscosity, and what 1/r adds to div v and lap v.
  [[gnu::always_inline]] void set_strain(const FlowPoint<T, dim>& x, const Parameters& fluid) {
    two_eps_ = grad_v_ + transpose(grad_v_);
    div_v_ = trace(grad_v_);
    T shear_rate_squared = 0.5 * inner(two_eps_, two_eps_);
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
  }

  /// tau_M (eq. 4) and tau_C (eq. 5).
  [[gnu::always_inline]] void set_stabilisation(const FlowPoint<T, dim>& x, const Parameters& fluid) {
    using std::sqrt;
    const T nu = (1.0 / rho_) * mu_;
    T rate2 = fluid.tau_rate2 + fluid.C_I * nu * nu * inner(x.G, x.G);
    if constexpr (convection) rate2 += dot(v_, x.G * v_);
    rate2 = x.s * rate2;
    const T trace_G = trace(x.G);
    const T inverse_tau_M = sqrt(rate2);
    const T factor = T(1.0) / (inverse_tau_M * trace_G);  // one division for both
    tau_M_ = trace_G * factor;
    rho_tau_C_ = rho_ * inverse_tau_M * inverse_tau_M * factor;
    k_p_over_rho_ = (1.0 / rho_) * x.k_p;
  }

  /// E and value_slope: the derivatives with respect to the value of v.
  [[gnu::always_inline]] void set_linearisation(const Parameters& fluid) {
    rho_c_ = rho_ * fluid.c_inertia;
    if constexpr (axisymmetric) E_rr_ = mu_ * inverse_r_ * inverse_r_;
    if constexpr (convection) {
      Mat<T, dim> E = rho_ * grad_v_;
      if constexpr (axisymmetric) E(0, 0) += E_rr_;
      value_slope_ = rho_ * grad_v_ - tau_M_ * (grad_v_ * E);
    }
  }

  /// (eq. 3): the factors of w and grad w, and of q and grad q, the quadrature weight included.
  [[gnu::always_inline]] void set_residual(const Vec<T, dim>& inertia, const Vec<T, dim>& tau_r, const T& p) {
    const T isotropic = rho_tau_C_ * div_v_ - p;  // LSIC, pressure
    Vec<T, dim> source = inertia;
    Mat<T, dim> flux = mu_ * two_eps_;
    add_to_diagonal(flux, isotropic);
    if constexpr (convection) {
      source -= grad_v_ * tau_r;           // cross stress
      flux += outer(tau_r, advecting_v_);  // SUPG, Reynolds stress
    }
    if constexpr (axisymmetric) source[0] += inverse_r_ * (isotropic + 2.0 * mu_ * v_[0] * inverse_r_);
    momentum_source_ = JxW_ * source;
    momentum_flux_ = JxW_ * flux;
    mass_source_ = JxW_ * div_v_;
    mass_flux_ = (JxW_ * k_p_over_rho_) * tau_r;  // PSPG
  }

  /// x E, E = rho grad v + mu / r^2 e_r (x) e_r of dr_M = D I + N E (eq. 7).
  [[nodiscard, gnu::always_inline]] Vec<T, dim> times_E(const Vec<T, dim>& x) const {
    Vec<T, dim> y = Vec<T, dim>::zero();
    if constexpr (convection) y = rho_ * (transpose(grad_v_) * x);
    if constexpr (axisymmetric) y[0] += E_rr_ * x[0];
    return y;
  }

  /// Half the derivative of gamma_dot^2 with respect to the nodal velocity of a function.
  [[nodiscard, gnu::always_inline]] Vec<T, dim> shear_gradient(const TrialFunction<T, dim>& b) const {
    Vec<T, dim> g = two_eps_ * b.grad;
    if constexpr (axisymmetric) g[0] += 2.0 * v_[0] * inverse_r_ * inverse_r_ * b.N;
    return g;
  }

  // In the order of use: first what every test function reads.
  Mat<T, dim> grad_v_;
  Mat<T, dim> value_slope_;           ///< rho grad v - tau_M grad v E: factor of N_a in B of (eq. 7)
  Vec<T, dim> fine_v_, advecting_v_;  ///< v' (eq. 2) and v + v'
  T JxW_, tau_M_, mu_, rho_tau_C_, k_p_over_rho_;
  double rho_, rho_c_;
  Vec<T, dim> momentum_source_, mass_flux_;
  Mat<T, dim> momentum_flux_;
  T mass_source_;
  Vec<T, dim> v_, lap_v_;
  Mat<T, dim> two_eps_;
  T div_v_, slope_, inverse_r_, E_rr_;
};

}  // namespace ifsi
