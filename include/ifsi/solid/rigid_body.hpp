#pragma once
/// \file
/// A rigid body: which motions it has, its inertia, and how it moves in a time step. No mesh, no matrix.

#include <array>
#include <cmath>

#include "ifsi/core/tensor.hpp"
#include "ifsi/quadrature/coordinates.hpp"
#include "ifsi/time/generalized_alpha.hpp"

namespace ifsi {

/// Volume, centroid and second moments about it, int (x - c) (x) (x - c) dV, of a body in its reference
/// position. For a body of revolution the centroid lies on the axis and the second moments are not used.
template <int dim>
struct RigidShape {
  double volume = 0;
  Vec<double, dim> centre = Vec<double, dim>::zero();
  Mat<double, dim> second_moments = Mat<double, dim>::zero();
};

/// Degrees of freedom of a rigid motion: translation, then rotation (vector in space, angle in the plane);
/// the axial translation alone for a body of revolution.
template <int dim, class Coordinates>
struct RigidMotion {
  static constexpr bool axial = Coordinates::axisymmetric;
  static constexpr int n = axial ? 1 : dim == 2 ? 3 : 6;
  using Dofs = Vec<double, n>;

  /// Velocity of the material point at r from the centre, as a matrix on the degrees of freedom (eq. 21).
  static Mat<double, dim, n> velocity_at(const Vec<double, dim>& r) {
    auto P = Mat<double, dim, n>::zero();
    if constexpr (axial) {
      P(1, 0) = 1.0;
    } else {
      for (int i = 0; i < dim; ++i) P(i, i) = 1.0;
      if constexpr (dim == 2) {
        P(0, 2) = -r[1], P(1, 2) = r[0];
      } else {
        const auto c = cross_matrix(r);  // omega x r = - r x omega
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) P(i, 3 + j) = -c(i, j);
      }
    }
    return P;
  }

  /// Matrix of r x.
  static Mat<double, 3> cross_matrix(const Vec<double, 3>& r) {
    return {0.0, -r[2], r[1], r[2], 0.0, -r[0], -r[1], r[0], 0.0};
  }
};

/// Rotation by the vector theta (axis times angle, Rodrigues' formula), or by an angle in the plane.
inline Mat<double, 3> rotation(const Vec<double, 3>& theta) {
  const double angle = std::sqrt(dot(theta, theta));
  const double s = angle > 1e-9 ? std::sin(angle) / angle : 1.0;
  const double c = angle > 1e-4 ? (1.0 - std::cos(angle)) / (angle * angle) : 0.5;
  const auto k = RigidMotion<3, Cartesian>::cross_matrix(theta);
  return Mat<double, 3>::identity() + s * k + c * (k * k);
}
inline Mat<double, 2> rotation(double angle) {
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}

/// Position, orientation, velocity and acceleration of a rigid body through time steps, by the rules of
/// (eq. 15) for its six (three, one) degrees of freedom. Its weight and inertia are those in excess of the
/// fluid that the flow's equations hold inside it.
template <int dim, class Coordinates>
class RigidBody {
 public:
  using Motion = RigidMotion<dim, Coordinates>;
  using Point = Vec<double, dim>;
  using Dofs = typename Motion::Dofs;
  static constexpr int n = Motion::n;

  /// \param inertia density in excess of the fluid that moves inside, \param force on the centre,
  /// \param free which degrees of freedom there are (symmetry planes take some away)
  RigidBody(const RigidShape<dim>& shape, double inertia, const Point& force, std::array<bool, n> free)
      : shape_(shape), inertia_(inertia), force_(force), free_(free), position_(shape.centre) {}

  [[nodiscard]] const std::array<bool, n>& free() const { return free_; }
  /// At the last completed level.
  [[nodiscard]] const Dofs& velocity() const { return W_old_; }
  [[nodiscard]] const Point& position() const { return position_; }
  [[nodiscard]] const Mat<double, dim>& orientation() const { return Q_; }
  [[nodiscard]] const RigidShape<dim>& shape() const { return shape_; }

  /// Opens a step; the body is put where it is expected at its end, in which place the equations hold.
  void begin_step(const GeneralizedAlpha& scheme, double dt, bool predict) {
    scheme_ = scheme, dt_ = dt;
    W_alpha_ = W_old_;
    if (predict) W_alpha_ += scheme.alpha_f * dt * A_old_;
    place(displacement(A_old_));
  }
  /// Steady motion: the body stays at its place.
  void begin_steady() {
    scheme_ = {}, dt_ = 0.0;
    W_alpha_ = W_old_;
    place(Dofs::zero());
  }
  void add(double factor, const Dofs& dW) { W_alpha_ += factor * dW; }
  void end_step() {
    const Dofs W = new_velocity();
    if (dt_ > 0.0) {
      const Dofs A = new_acceleration();
      place(displacement(A));
      position_ = expected_, Q_ = expected_Q_;
      A_old_ = A;
    }
    W_old_ = W;
  }

  /// Where a point of the reference body is expected, and its distance from the centre there.
  [[nodiscard]] Point lever(const Point& X) const { return expected_Q_ * (X - shape_.centre); }
  [[nodiscard]] Point expected(const Point& X) const { return expected_ + lever(X); }
  /// The point of the reference body expected at x.
  [[nodiscard]] Point reference(const Point& x) const {
    return shape_.centre + transpose(expected_Q_) * (x - expected_);
  }
  /// Velocity at n + 1 of the present iterate.
  [[nodiscard]] Dofs new_velocity() const { return W_old_ + (1.0 / scheme_.alpha_f) * (W_alpha_ - W_old_); }

  /// Inertia less applied forces (eq. 21): what the constraint forces must add up to.
  [[nodiscard]] Dofs residual() const {
    Dofs R = Dofs::zero();
    for (int i = 0; i < n; ++i) R[i] = -force(i);
    if (dt_ == 0.0) return R;
    R += mass() * (A_old_ + scheme_.alpha_m * (new_acceleration() - A_old_));
    if constexpr (n == 6) {
      const Vec<double, 3> omega{W_alpha_[3], W_alpha_[4], W_alpha_[5]};
      const auto gyroscopic = Motion::cross_matrix(omega) * (rotational_inertia() * omega);
      for (int i = 0; i < 3; ++i) R[3 + i] += gyroscopic[i];
    }
    return R;
  }
  /// Its derivative with respect to the velocity at alpha_f.
  [[nodiscard]] Mat<double, n> tangent() const {
    if (dt_ == 0.0) return Mat<double, n>::zero();
    Mat<double, n> K = scheme_.c_inertia(dt_) * mass();
    if constexpr (n == 6) {
      const Vec<double, 3> omega{W_alpha_[3], W_alpha_[4], W_alpha_[5]};
      const auto I = rotational_inertia();
      const auto G = Motion::cross_matrix(omega) * I - Motion::cross_matrix(I * omega);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) K(3 + i, 3 + j) += G(i, j);
    }
    return K;
  }

  /// Calls visit(name, numbers, count) for all that a restart needs.
  template <class Visit>
  void for_each_array(Visit&& visit) {
    visit("position", position_.data, dim);
    visit("orientation", Q_.data, dim * dim);
    visit("velocity", W_old_.data, n);
    visit("acceleration", A_old_.data, n);
  }

 private:
  [[nodiscard]] double force(int dof) const {
    if constexpr (Motion::axial)
      return force_[1];
    else
      return dof < dim ? force_[dof] : 0.0;
  }
  /// About the centre, in the expected orientation.
  [[nodiscard]] Mat<double, 3> rotational_inertia() const requires(n == 6) {
    const auto S = expected_Q_ * shape_.second_moments * transpose(expected_Q_);
    const double trace = S(0, 0) + S(1, 1) + S(2, 2);
    return inertia_ * (trace * Mat<double, 3>::identity() - S);
  }
  [[nodiscard]] Mat<double, n> mass() const {
    auto M = Mat<double, n>::zero();
    for (int i = 0; i < (Motion::axial ? 1 : dim); ++i) M(i, i) = inertia_ * shape_.volume;
    if constexpr (n == 3) {
      M(2, 2) = inertia_ * (shape_.second_moments(0, 0) + shape_.second_moments(1, 1));
    } else if constexpr (n == 6) {
      const auto I = rotational_inertia();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) M(3 + i, 3 + j) = I(i, j);
    }
    return M;
  }
  [[nodiscard]] Dofs new_acceleration() const {
    const Dofs W = new_velocity();
    Dofs A;
    for (int i = 0; i < n; ++i) A[i] = scheme_.rate(W[i], W_old_[i], A_old_[i], dt_);
    return A;
  }
  /// Translation and rotation over the step for an acceleration at its end.
  [[nodiscard]] Dofs displacement(const Dofs& A) const {
    return dt_ * W_old_ + (dt_ * dt_) * ((0.5 - scheme_.beta) * A_old_ + scheme_.beta * A);
  }
  void place(const Dofs& d) {
    expected_ = position_, expected_Q_ = Q_;
    if constexpr (Motion::axial) {
      expected_[1] += d[0];
    } else {
      for (int i = 0; i < dim; ++i) expected_[i] += d[i];
      if constexpr (dim == 2)
        expected_Q_ = rotation(d[2]) * Q_;
      else
        expected_Q_ = rotation(Vec<double, 3>{d[3], d[4], d[5]}) * Q_;
    }
  }

  RigidShape<dim> shape_;
  double inertia_;
  Point force_;
  std::array<bool, n> free_;
  GeneralizedAlpha scheme_;
  double dt_ = 0.0;
  Point position_, expected_{};
  Mat<double, dim> Q_ = Mat<double, dim>::identity(), expected_Q_ = Q_;
  Dofs W_old_ = Dofs::zero(), A_old_ = Dofs::zero(), W_alpha_ = Dofs::zero();
};

}  // namespace ifsi
