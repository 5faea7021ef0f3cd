#pragma once
/// \file
/// Residual-based variational multiscale form of incompressible flow at one quadrature point.
///
/// The residual is (eq. 3) and the tangent (eq. 7) of docs/equations.md, term by term. Everything is a
/// template on the number type: double for tests and single points, Pack<W> for W cells at once, an automatic
/// differentiation number for checking the tangent.

#include <cmath>
#include <type_traits>

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

/// The residual at one quadrature point (eq. 3): what multiplies w, grad w, q and grad q, the quadrature
/// weight included.
template <class T, int dim>
struct ResidualFactors {
  Vec<T, dim> w;
  Mat<T, dim> grad_w;
  T q;
  Vec<T, dim> grad_q;
};

/// Adds the part of a point to the residual of the node with shape function N: dim momentum rows, then the
/// mass row.
template <class T, int dim>
[[gnu::always_inline]] inline void add_residual(const ResidualFactors<T, dim>& point, double N,
                                                const Vec<T, dim>& grad, Vec<T, dim + 1>& R) {
  IFSI_UNROLL
  for (int i = 0; i < dim; ++i) {
    R[i] += N * point.w[i];
    IFSI_UNROLL
    for (int j = 0; j < dim; ++j) R[i] += point.grad_w(i, j) * grad[j];
    R[dim] += point.grad_q[i] * grad[i];
  }
  R[dim] += N * point.q;
}

/// Trial function of one node at one point: what a change of its unknowns does to the fields there.
/// dr_M = D I + N E for the velocity (E belongs to the point), grad for the pressure. Its value N is that of
/// the table of shape functions, the same in all cells.
template <class T, int dim>
struct TrialFunction {
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

  /// Also hands out the residual, which nobody needs later.
  [[gnu::always_inline]] VmsPoint(const FlowPoint<T, dim>& x, const Parameters& fluid,
                                  ResidualFactors<T, dim>& residual)
      : JxW_(x.JxW), rho_(fluid.rho) {
    copy(x.grad_v, grad_v_);
    const Strain strain = strain_of(x);
    set_viscosity(strain, fluid);
    Vec<T, dim> inertia = rho_ * x.acceleration;
    if constexpr (convection) inertia += rho_ * (grad_v_ * x.v);
    const Vec<T, dim> r_M = inertia + x.grad_p - mu_ * strain.lap_v;
    set_stabilisation(x, fluid);
    const Vec<T, dim> tau_r = tau_M_ * r_M;
    fine_v_ = (-1.0 / rho_) * tau_r;
    advecting_v_ = x.v + fine_v_;
    rho_c_ = rho_ * fluid.c_inertia;
    if constexpr (axisymmetric) E_rr_ = mu_ * inverse_r_ * inverse_r_;
    residual = residual_of(strain, inertia, tau_r, x.p);
  }

  [[nodiscard]] T tau_M() const { return tau_M_; }
  [[nodiscard]] T rho_tau_C() const { return rho_tau_C_; }
  [[nodiscard]] T mu() const { return mu_; }
  [[nodiscard]] T JxW() const { return JxW_; }

  /// Trial function from N, its gradient and its Laplacian (in axisymmetric scenes without the 1/r part), and
  /// the velocity v at the point.
  [[nodiscard, gnu::always_inline]] TrialFunction<T, dim> trial(double N, const Vec<T, dim>& grad, T lap,
                                                                const Vec<T, dim>& v) const {
    TrialFunction<T, dim> b;
    copy(grad, b.grad);
    if constexpr (axisymmetric) lap += inverse_r_ * grad[0];
    b.transport = b.D = T(rho_c_ * N);
    if constexpr (convection) {
      b.transport += rho_ * dot(advecting_v_, grad);
      b.D += rho_ * dot(v, grad);
    }
    b.D -= mu_ * lap;
    return b;
  }

  /// Test function of the node that `b` is the trial function of.
  [[nodiscard, gnu::always_inline]] TestFunction<T, dim> test(double N,
                                                              const TrialFunction<T, dim>& b) const {
    TestFunction<T, dim> a;
    a.N = JxW_ * N;
    const Vec<T, dim> grad = JxW_ * b.grad, tau_grad = tau_M_ * grad;
    copy(grad, a.div);
    if constexpr (axisymmetric) a.div[0] += a.N * inverse_r_;
    if constexpr (axisymmetric) a.hoop = 2.0 * mu_ * inverse_r_ * inverse_r_ * a.N;
    a.mu_grad = mu_ * grad;
    a.tau_C_div = rho_tau_C_ * a.div;
    if constexpr (convection) {
      a.A = outer(fine_v_, tau_grad) - (tau_M_ * a.N) * grad_v_;  // Reynolds, cross
      add_to_diagonal(a.A, dot(advecting_v_, tau_grad));          // SUPG, Reynolds
      Mat<T, dim> value = a.A;
      add_to_diagonal(value, a.N);
      a.B = value * (rho_ * grad_v_) - outer(fine_v_, rho_ * grad);  // A E + w.grad v - Reynolds
      if constexpr (axisymmetric)
        for (int i = 0; i < dim; ++i) a.B(i, 0) += E_rr_ * a.A(i, 0);
    } else {
      a.A = a.B = Mat<T, dim>::zero();
    }
    a.q_D = k_p_over_rho_ * tau_grad;
    a.q_N = k_p_over_rho_ * times_E(tau_grad);
    if constexpr (!newtonian) {
      a.viscosity_slope = slope_ * (JxW_ * shear_gradient(N, b) - a.A * strain_.lap_v);
      a.q_viscosity = -slope_ * dot(a.q_D, strain_.lap_v);
    }
    return a;
  }

  /// Adds to the tangent block of a pair of functions (eq. 7) what multiplies N_b and D_b: rows as the
  /// residual, columns (v, p) at alpha_f. `diagonal` collects what belongs on the diagonal of the velocity.
  [[gnu::always_inline]] void add_tangent_of_values(const TestFunction<T, dim>& a, double N_b,
                                                    const TrialFunction<T, dim>& b, Mat<T, B>& K,
                                                    T& diagonal) const {
    diagonal += a.N * b.transport;
    IFSI_UNROLL
    for (int i = 0; i < dim; ++i) {
      if constexpr (convection) {
        IFSI_UNROLL
        for (int j = 0; j < dim; ++j) {
          K(i, j) += a.A(i, j) * b.D;
          K(i, j) += a.B(i, j) * N_b;
        }
      }
      K(i, dim) -= a.div[i] * N_b;
      K(dim, i) += a.q_D[i] * b.D;
      K(dim, i) += a.q_N[i] * N_b;
    }
    if constexpr (axisymmetric) K(0, 0) += a.hoop * N_b;
    if constexpr (!newtonian) {
      const Vec<T, dim> shear_b = shear_gradient(N_b, b);
      IFSI_UNROLL
      for (int j = 0; j < dim; ++j) {
        IFSI_UNROLL
        for (int i = 0; i < dim; ++i) K(i, j) += a.viscosity_slope[i] * shear_b[j];
        K(dim, j) += a.q_viscosity * shear_b[j];
      }
    }
  }

  /// Adds the rest of the block: what multiplies grad N_b.
  [[gnu::always_inline]] void add_tangent_of_gradients(const TestFunction<T, dim>& a, double N_b,
                                                       const TrialFunction<T, dim>& b, Mat<T, B>& K,
                                                       T& diagonal) const {
    Vec<T, dim> b_div = b.grad;
    if constexpr (axisymmetric) b_div[0] += inverse_r_ * N_b;
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
  /// Derivatives of v with what 1/r adds to them in axisymmetric scenes.
  struct Strain {
    Mat<T, dim> two_eps;
    Vec<T, dim> lap_v;
    T div_v;
    T hoop_rate;  ///< v_r / r; read by axisymmetric scenes only
  };
  struct NoStrain {};

  [[gnu::always_inline]] Strain strain_of(const FlowPoint<T, dim>& x) {
    Strain strain;
    strain.two_eps = x.grad_v + transpose(x.grad_v);
    copy(x.lap_v, strain.lap_v);
    strain.div_v = trace(x.grad_v);
    if constexpr (axisymmetric) {
      inverse_r_ = T(1.0) / x.radius;
      strain.hoop_rate = x.v[0] * inverse_r_;
      strain.div_v += strain.hoop_rate;
      for (int i = 0; i < dim; ++i) strain.lap_v[i] += inverse_r_ * x.grad_v(i, 0);
      strain.lap_v[0] -= inverse_r_ * strain.hoop_rate;
    }
    return strain;
  }

  [[gnu::always_inline]] void set_viscosity(const Strain& strain, const Parameters& fluid) {
    T shear_rate_squared = 0.5 * inner(strain.two_eps, strain.two_eps);
    if constexpr (axisymmetric) shear_rate_squared += 2.0 * strain.hoop_rate * strain.hoop_rate;
    mu_ = fluid.rheology.viscosity(shear_rate_squared);
    if constexpr (!newtonian) {
      slope_ = 2.0 * fluid.rheology.viscosity_slope(shear_rate_squared);
      strain_ = strain;
    }
  }

  /// tau_M (eq. 4) and tau_C (eq. 5).
  [[gnu::always_inline]] void set_stabilisation(const FlowPoint<T, dim>& x, const Parameters& fluid) {
    using std::sqrt;
    const T nu = (1.0 / rho_) * mu_;
    T rate2 = fluid.tau_rate2 + fluid.C_I * nu * nu * inner(x.G, x.G);
    if constexpr (convection) rate2 += dot(x.v, x.G * x.v);
    rate2 = x.s * rate2;
    const T trace_G = trace(x.G);
    const T inverse_tau_M = sqrt(rate2);
    const T factor = T(1.0) / (inverse_tau_M * trace_G);  // one division for both
    tau_M_ = trace_G * factor;
    rho_tau_C_ = rho_ * inverse_tau_M * inverse_tau_M * factor;
    k_p_over_rho_ = (1.0 / rho_) * x.k_p;
  }

  /// (eq. 3), term by term.
  [[nodiscard, gnu::always_inline]] ResidualFactors<T, dim> residual_of(const Strain& strain,
                                                                        const Vec<T, dim>& inertia,
                                                                        const Vec<T, dim>& tau_r,
                                                                        const T& p) const {
    const T isotropic = rho_tau_C_ * strain.div_v - p;  // LSIC, pressure
    Vec<T, dim> source = inertia;
    Mat<T, dim> flux = mu_ * strain.two_eps;
    add_to_diagonal(flux, isotropic);
    if constexpr (convection) {
      source -= grad_v_ * tau_r;           // cross stress
      flux += outer(tau_r, advecting_v_);  // SUPG, Reynolds stress
    }
    if constexpr (axisymmetric) source[0] += inverse_r_ * (isotropic + 2.0 * mu_ * strain.hoop_rate);
    return {JxW_ * source, JxW_ * flux, JxW_ * strain.div_v, (JxW_ * k_p_over_rho_) * tau_r};  // last: PSPG
  }

  /// x E, E = rho grad v + mu / r^2 e_r (x) e_r of dr_M = D I + N E (eq. 7).
  [[nodiscard, gnu::always_inline]] Vec<T, dim> times_E(const Vec<T, dim>& x) const {
    Vec<T, dim> y = Vec<T, dim>::zero();
    if constexpr (convection) y = rho_ * (transpose(grad_v_) * x);
    if constexpr (axisymmetric) y[0] += E_rr_ * x[0];
    return y;
  }

  /// Half the derivative of gamma_dot^2 with respect to the nodal velocity of a function.
  [[nodiscard, gnu::always_inline]] Vec<T, dim> shear_gradient(double N,
                                                               const TrialFunction<T, dim>& b) const {
    Vec<T, dim> g = strain_.two_eps * b.grad;
    if constexpr (axisymmetric) g[0] += 2.0 * strain_.hoop_rate * inverse_r_ * N;
    return g;
  }

  // What the test functions read, and nothing that only the residual needs: the points of a cell and its
  // trial functions compete for the first-level cache.
  Mat<T, dim> grad_v_;
  Vec<T, dim> fine_v_, advecting_v_;  ///< v' (eq. 2) and v + v'
  T JxW_, tau_M_, mu_, rho_tau_C_, k_p_over_rho_;
  double rho_, rho_c_;
  T slope_, inverse_r_, E_rr_;  ///< the first in non-Newtonian scenes only, the others in axisymmetric ones
  [[no_unique_address]] std::conditional_t<newtonian, NoStrain, Strain> strain_;
};

}  // namespace ifsi
