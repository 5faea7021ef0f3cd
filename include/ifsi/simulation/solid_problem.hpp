#pragma once
/// \file
/// A solid without a fluid: statics by load steps, dynamics by generalized-alpha.

#include "ifsi/simulation/solid_newton.hpp"
#include "ifsi/time/generalized_alpha.hpp"

namespace ifsi {

/// Generalized-alpha for equations of second order (Chung & Hulbert 1993, doi:10.1115/1.2900803), levels
/// counted from n: rho_inf = 1 keeps all energy of a linear system, 0 damps most.
/// \throws Error (configuration) outside of 0 <= rho_inf <= 1.
inline GeneralizedAlpha second_order_scheme(double rho_inf) {
  GeneralizedAlpha g = GeneralizedAlpha::from_rho_inf(rho_inf);
  g.alpha_m = (2.0 - rho_inf) / (1.0 + rho_inf);
  g.gamma = 0.5 + g.alpha_m - g.alpha_f;
  g.beta = 0.25 * (1.0 + g.alpha_m - g.alpha_f) * (1.0 + g.alpha_m - g.alpha_f);
  return g;
}

/// One body, its supports and loads, and its state. Every rank that has one computes all of it.
template <class Body_>
class SolidProblem {
 public:
  using Body = Body_;
  static constexpr int dim = Body::dim;
  SolidNewtonOptions newton;
  double smallest_load_step = 1e-3;  ///< of the full load; below it statics gives up

  explicit SolidProblem(Body body)
      : body_(std::move(body)),
        system_(body_),
        gravity_(body_.parameters.gravity),
        u_(body_.n_dofs()),
        v_(body_.n_dofs()),
        a_(body_.n_dofs()) {}
  SolidProblem(const SolidProblem&) = delete;
  SolidProblem& operator=(const SolidProblem&) = delete;

  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const std::vector<double>& u() const { return u_; }
  [[nodiscard]] const std::vector<double>& v() const { return v_; }
  [[nodiscard]] const std::vector<double>& a() const { return a_; }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] int newton_iterations() const { return n_newton_; }
  [[nodiscard]] Vec<double, dim> displacement(int node) const {
    Vec<double, dim> w;
    for (int i = 0; i < dim; ++i) w[i] = u_[node * dim + i];
    return w;
  }
  /// The node nearest to a point of the reference configuration.
  [[nodiscard]] int node_at(const Vec<double, dim>& X) const {
    const auto distance = [&](const Vec<double, dim>& p) { return dot(p - X, p - X); };
    const auto& points = body_.mesh().points;
    return static_cast<int>(
        std::min_element(points.begin(), points.end(),
                         [&](const auto& p, const auto& q) { return distance(p) < distance(q); }) -
        points.begin());
  }

  /// Prescribes component `i` of the displacement (reached in proportion to the load).
  void prescribe(int node, int i, double value) { system_.prescribe(node * dim + i, value); }
  void prescribe(const std::string& boundary, int i, double value) {
    for (int node : body_.nodes_on(boundary)) prescribe(node, i, value);
  }
  void clamp(const std::string& boundary) {
    for (int i = 0; i < dim; ++i) prescribe(boundary, i, 0.0);
  }
  /// Force per reference area of a boundary.
  void add_traction(const std::string& boundary, const Vec<double, dim>& traction) {
    body_.add_load(boundary, traction);
  }
  /// Force per current area of a boundary, inwards.
  void add_pressure(const std::string& boundary, double pressure) { body_.add_load(boundary, {}, pressure); }

  /// Starts dynamics from this displacement and velocity (dim numbers per node).
  void set_initial(std::vector<double> u, std::vector<double> v) {
    u_ = std::move(u);
    v_ = std::move(v);
  }

  /// Equilibrium under the full load, reached in `n_steps` equal load steps that are halved when Newton
  /// fails. \throws Error (nonlinear) with a diagnosis below smallest_load_step.
  void solve_static(int n_steps = 1) {
    double load = 0, step = 1.0 / n_steps;
    while (load < 1) {
      const double next = load + step > 1 - 1e-12 ? 1.0 : load + step;
      std::vector<double> u = u_;
      const auto report = solid_newton(
          system_, u, newton,
          [&](const std::vector<double>& w, const std::vector<double>& w_before) {
            return evaluate({w}, w_before, {}, next);
          },
          [&](int dof) { return next * system_.prescribed(dof); });
      n_newton_ += report.iterations;
      if (report.converged) {
        u_ = std::move(u);
        load = next;
      } else if ((step *= 0.5) < smallest_load_step) {
        throw Error(ExitCode::nonlinear, "solid '" + body_.name() + "' finds no equilibrium beyond " +
                                             std::to_string(load) + " of the load: " + report.diagnosis);
      }
    }
  }

  /// One time step; `load` scales loads and gravity at its middle level. The first step starts from the
  /// acceleration that the loads cause. \throws Error (nonlinear) with a diagnosis when Newton fails.
  void step(double dt, const GeneralizedAlpha& scheme, double load = 1.0) {
    if (time_ == 0) start(load);
    const double af = scheme.alpha_f, am = scheme.alpha_m;
    const double v_slope = scheme.gamma / (scheme.beta * dt), a_slope = 1 / (scheme.beta * dt * dt);
    const StateSlopes slopes{af, af * v_slope, am * a_slope};
    const std::size_t size = u_.size();
    std::vector<double> u = u_, v(size), a(size), u_f(size), v_f(size), a_m(size), u_f_before(size);
    const auto evaluate_levels = [&](const std::vector<double>& w, const std::vector<double>& w_before) {
      for (std::size_t i = 0; i < size; ++i) {
        a[i] = a_slope * (w[i] - u_[i] - dt * v_[i]) - (0.5 / scheme.beta - 1) * a_[i];
        v[i] = v_[i] + dt * ((1 - scheme.gamma) * a_[i] + scheme.gamma * a[i]);
        u_f[i] = u_[i] + af * (w[i] - u_[i]);
        u_f_before[i] = u_[i] + af * (w_before[i] - u_[i]);
        v_f[i] = v_[i] + af * (v[i] - v_[i]);
        a_m[i] = a_[i] + am * (a[i] - a_[i]);
      }
      return evaluate({u_f, v_f, a_m}, u_f_before, slopes, load);
    };
    const auto report =
        solid_newton(system_, u, newton, evaluate_levels, [&](int dof) { return system_.prescribed(dof); });
    n_newton_ += report.iterations;
    if (!report.converged)
      throw Error(ExitCode::nonlinear, "solid '" + body_.name() +
                                           "', step from t = " + std::to_string(time_) + " by " +
                                           std::to_string(dt) + ": " + report.diagnosis);
    u_ = std::move(u);
    v_ = std::move(v);
    a_ = std::move(a);
    time_ += dt;
  }

  /// Force that the supports of a boundary exert on the body, from the last residual.
  [[nodiscard]] Vec<double, dim> reaction(const std::string& boundary) const {
    Vec<double, dim> force{};
    for (int node : body_.nodes_on(boundary))
      for (int i = 0; i < dim; ++i)
        if (system_.is_prescribed(node * dim + i)) force[i] += system_.residual()[node * dim + i];
    return force;
  }
  [[nodiscard]] SolidTotals<dim> totals() const { return body_.totals({u_, v_, a_}, body_.all_cells()); }

 private:
  /// Everything that acts on the body at a state, and its tangent.
  DeformationReport evaluate(const SolidState& state, std::span<const double> u_before,
                             const StateSlopes& slopes, double load) {
    body_.parameters.gravity = load * gravity_;
    const auto report = system_.assemble(state, u_before, slopes);
    body_.parameters.gravity = gravity_;
    body_.add_loads(
        load, state.u, slopes,
        [&](int, std::span<const int> nodes, std::span<const double> R, std::span<const double> K) {
          system_.add_residual(nodes, R);
          if (!K.empty()) system_.add_tangent(nodes, K);
        });
    return report;
  }

  /// Acceleration at rest under the load: M a = -R(u, v, a = 0).
  void start(double load) {
    evaluate({u_, v_, a_}, u_, {0, 0, 1}, load);
    const std::vector<double> no_gap(u_.size(), 0.0), da = system_.solve(no_gap);
    for (std::size_t i = 0; i < a_.size(); ++i) a_[i] += da[i];
  }

  Body body_;
  SolidSystem<Body> system_;
  Vec<double, dim> gravity_;
  std::vector<double> u_, v_, a_;
  double time_ = 0;
  int n_newton_ = 0;
};

}  // namespace ifsi
