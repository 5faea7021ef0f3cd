#pragma once
/// \file
/// Boundary conditions of a flow by boundary name, as a driver states them.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// What holds on each named boundary. Where two Dirichlet boundaries meet, the one stated last wins.
/// A boundary may carry several entries (a traction and backflow stabilisation, say) but not none.
template <int dim>
class FlowBoundary {
 public:
  using Point = Vec<double, dim>;
  using Profile = std::function<Point(const Point& x, double t)>;
  using Signal = std::function<double(double t)>;

  struct Velocity {
    std::string boundary;
    Profile value;
  };
  struct Traction {
    std::string boundary;
    Profile value;
  };
  struct Pressure {
    std::string boundary;
    Signal value;
  };
  struct Backflow {
    std::string boundary;
    double beta;
  };

  /// Prescribed velocity; x is the node, t the time.
  void velocity(std::string boundary, Profile value) {
    velocities_.push_back({std::move(boundary), std::move(value)});
  }
  void no_slip(std::string boundary) {
    velocity(std::move(boundary), [](const Point&, double) { return Point::zero(); });
  }
  /// Symmetry or slip on a plane, however inclined: no flow through it, no shear on it (eq. 28).
  void slip(std::string boundary) { slips_.push_back(std::move(boundary)); }
  /// Prescribed traction h = sigma n.
  void traction(std::string boundary, Profile value) {
    tractions_.push_back({std::move(boundary), std::move(value)});
  }
  /// Prescribed normal pressure, h = -p n.
  void pressure(std::string boundary, Signal value) {
    pressures_.push_back({std::move(boundary), std::move(value)});
  }
  void traction_free(std::string boundary) { free_.push_back(std::move(boundary)); }
  /// Backflow stabilisation (eq. 11), added to what else holds there.
  void backflow(std::string boundary, double beta) { backflows_.push_back({std::move(boundary), beta}); }

  [[nodiscard]] const std::vector<Velocity>& velocities() const { return velocities_; }
  [[nodiscard]] const std::vector<std::string>& slips() const { return slips_; }
  [[nodiscard]] const std::vector<Traction>& tractions() const { return tractions_; }
  [[nodiscard]] const std::vector<Pressure>& pressures() const { return pressures_; }
  [[nodiscard]] const std::vector<std::string>& free() const { return free_; }
  [[nodiscard]] const std::vector<Backflow>& backflows() const { return backflows_; }

 private:
  std::vector<Velocity> velocities_;
  std::vector<std::string> slips_, free_;
  std::vector<Traction> tractions_;
  std::vector<Pressure> pressures_;
  std::vector<Backflow> backflows_;
};

}  // namespace ifsi
