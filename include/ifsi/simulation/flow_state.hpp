#pragma once
/// \file
/// The flow between two time levels: what generalized-alpha keeps, and the levels at which the equations
/// hold.

#include <span>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/time/generalized_alpha.hpp"

namespace ifsi {

/// Nodal unknowns of one step, B = dim + 1 interleaved numbers (velocity, pressure) per local node.
/// Newton works on u = (v, p) at n + alpha_f; everything else follows from it (eq. 8-10).
template <int B>
class FlowState {
 public:
  static constexpr int dim = B - 1;

  FlowState() = default;
  explicit FlowState(int n_nodes)
      : u(n_nodes * B), rate(u), old_(u), old_rate_(u), p_last_(n_nodes), p_before_(p_last_) {}

  std::vector<double> u;     ///< v and p at n + alpha_f
  std::vector<double> rate;  ///< dv/dt at n + alpha_m; its pressure entries stay zero

  [[nodiscard]] double time() const { return t_; }
  /// Time of the equations within the present (or last) step.
  [[nodiscard]] double time_alpha() const { return t_alpha_; }
  /// Velocity (with a meaningless last entry) and its rate at the last completed level.
  [[nodiscard]] std::span<const double> velocity() const { return old_; }
  [[nodiscard]] std::span<const double> acceleration() const { return old_rate_; }

  /// Starts from given velocity (and rate) at time t; empty rates mean rest. Arrays are interleaved as u.
  void start(double t, std::span<const double> v, std::span<const double> v_dot, std::span<const double> p) {
    t_ = t_alpha_ = t_p_last_ = t_p_before_ = t;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const bool velocity = i % B < dim;
      old_[i] = velocity ? v[i] : 0.0;
      old_rate_[i] = velocity && !v_dot.empty() ? v_dot[i] : 0.0;
      if (!velocity) p_last_[i / B] = p_before_[i / B] = p.empty() ? 0.0 : p[i / B];
    }
    n_steps_ = 0;
  }

  /// Opens the step to t + dt with a prediction: constant acceleration and linear pressure when `smooth`,
  /// else constant velocity and pressure.
  void begin_step(const GeneralizedAlpha& scheme, double dt, bool smooth) {
    scheme_ = scheme, dt_ = dt;
    t_alpha_ = t_ + scheme.alpha_f * dt;
    for (std::size_t i = 0; i < u.size(); ++i)
      if (i % B < dim)
        u[i] = old_[i] + (smooth ? scheme_.alpha_f * dt * old_rate_[i] : 0.0);
      else
        u[i] = smooth ? extrapolated_pressure(i / B, t_alpha_) : p_last_[i / B];
    update_rate();
  }

  /// Prescribes v at n + 1 outside of the range of the projector P.
  void prescribe(int node, const Mat<double, dim>& P, const Vec<double, dim>& value) {
    Vec<double, dim> now, prescribed;
    for (int i = 0; i < dim; ++i) {
      const int k = node * B + i;
      now[i] = u[k];
      prescribed[i] = old_[k] + scheme_.alpha_f * (value[i] - old_[k]);
    }
    const Vec<double, dim> v = P * now + (prescribed - P * prescribed);
    for (int i = 0; i < dim; ++i) u[node * B + i] = v[i];
  }

  /// Recomputes the rate at alpha_m after u changed.
  void update_rate() {
    for (std::size_t i = 0; i < u.size(); ++i)
      if (i % B < dim) rate[i] = old_rate_[i] + scheme_.alpha_m * (new_rate(i) - old_rate_[i]);
  }

  /// Velocity at n + 1 as the present iterate has it, interleaved as u.
  void new_velocities(std::vector<double>& v) const {
    v.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) v[i] = i % B < dim ? new_velocity(i) : 0.0;
  }

  /// Accepts the step: level n + 1 becomes level n.
  void end_step() {
    for (std::size_t i = 0; i < u.size(); ++i)
      if (i % B < dim) {
        const double r = new_rate(i);
        old_[i] = new_velocity(i);
        old_rate_[i] = r;
      } else {
        p_before_[i / B] = p_last_[i / B];
        p_last_[i / B] = u[i];
      }
    t_p_before_ = t_p_last_;
    t_p_last_ = t_alpha_;
    t_ += dt_;
    ++n_steps_;
  }

  /// Pressure of a node at time t by linear extrapolation of the last two levels (eq. 10).
  [[nodiscard]] double extrapolated_pressure(int node, double t) const {
    if (n_steps_ < 2) return p_last_[node];
    const double slope = (p_last_[node] - p_before_[node]) / (t_p_last_ - t_p_before_);
    return p_last_[node] + slope * (t - t_p_last_);
  }
  [[nodiscard]] double pressure(int node) const { return extrapolated_pressure(node, t_); }

  /// Pressure of the last step, at its alpha_f.
  [[nodiscard]] double last_pressure(int node) const { return p_last_[node]; }

  /// Adds a constant to the pressure of the completed level (its mean is arbitrary in an enclosed flow).
  void shift_pressure(double by) {
    for (double& p : p_last_) p += by;
  }

  /// Calls visit(name, array, numbers per node) for every array a restart needs.
  template <class Visit>
  void for_each_array(Visit&& visit) {
    for_each_array(*this, visit);
  }
  template <class Visit>
  void for_each_array(Visit&& visit) const {
    for_each_array(*this, visit);
  }
  /// The numbers a restart needs besides.
  [[nodiscard]] std::vector<double> scalars() const {
    return {t_, t_alpha_, t_p_last_, t_p_before_, static_cast<double>(n_steps_)};
  }
  void set_scalars(const std::vector<double>& s) {
    t_ = s[0], t_alpha_ = s[1], t_p_last_ = s[2], t_p_before_ = s[3], n_steps_ = static_cast<int>(s[4]);
  }
  [[nodiscard]] int n_steps() const { return n_steps_; }

 private:
  template <class Self, class Visit>
  static void for_each_array(Self& self, Visit& visit) {
    visit("velocity", self.old_, B);
    visit("acceleration", self.old_rate_, B);
    visit("pressure", self.p_last_, 1);
    visit("pressure_before", self.p_before_, 1);
  }
  [[nodiscard]] double new_velocity(std::size_t i) const {
    return old_[i] + (u[i] - old_[i]) / scheme_.alpha_f;
  }
  [[nodiscard]] double new_rate(std::size_t i) const {
    return scheme_.rate(new_velocity(i), old_[i], old_rate_[i], dt_);
  }

  GeneralizedAlpha scheme_;
  double dt_ = 1.0, t_ = 0.0, t_alpha_ = 0.0, t_p_last_ = 0.0, t_p_before_ = 0.0;
  int n_steps_ = 0;
  std::vector<double> old_, old_rate_;     ///< level n
  std::vector<double> p_last_, p_before_;  ///< pressures of the last two steps, at their alpha_f
};

}  // namespace ifsi
