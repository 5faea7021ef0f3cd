#pragma once
/// \file
/// The discrete equations of a flow on a mesh: cells, boundary terms and prescribed velocities.

#include <memory>
#include <string>
#include <vector>

#include "ifsi/assembly/dirichlet.hpp"
#include "ifsi/assembly/flow_assembler.hpp"
#include "ifsi/assembly/flow_faces.hpp"
#include "ifsi/assembly/plane_boundary.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/core/projector.hpp"
#include "ifsi/simulation/flow_boundary.hpp"

namespace ifsi {

/// Residual and tangent of a flow with its boundary conditions, and the prescribed velocities.
/// The mesh must outlive it.
template <class Element, class Model = FluidModel<>>
class FlowSystem {
 public:
  static constexpr int dim = Element::dim, B = dim + 1;
  using Boundary = FlowBoundary<dim>;
  using Coordinates = typename Model::Coordinates;
  using Parameters = FluidParameters<typename Model::Rheology>;

  /// \throws Error (configuration) for a boundary name the mesh lacks, a boundary without any condition, or a
  /// slip boundary that is no plane.
  FlowSystem(const Mesh<Element>& mesh, Boundary boundary)
      : mesh_(mesh), boundary_(std::move(boundary)), assembler_(mesh), constraints_(mesh.n_nodes()) {
    check_complete();
    find_prescribed();
  }

  [[nodiscard]] const Mesh<Element>& mesh() const { return mesh_; }
  [[nodiscard]] const Constraints<B>& constraints() const { return constraints_; }
  [[nodiscard]] BlockCsr<B> make_matrix() const { return assembler_.make_matrix(); }
  /// No boundary lets the fluid out: the pressure is known up to a constant.
  [[nodiscard]] bool enclosed() const {
    return boundary_.free().empty() && boundary_.tractions().empty() && boundary_.pressures().empty();
  }

  /// Calls set(node, value) for every node where velocity is prescribed: the value at time t outside of the
  /// range of its projector. Slip prescribes zero.
  template <class Set>
  void for_each_prescribed(double t, Set&& set) const {
    for (const Prescribed& p : prescribed_) {
      const Vec<double, dim> value =
          p.profile < 0 ? Vec<double, dim>::zero() : boundary_.velocities()[p.profile].value(p.x, t);
      set(p.node, value);
    }
  }

  /// Residual (and tangent, when K is given) with Neumann data at time t, before prescribed unknowns are
  /// removed.
  void assemble(const FlowFields& fields, const Parameters& fluid, double t, std::span<double> R,
                BlockCsr<B>* K) const {
    if (K != nullptr)
      assembler_.residual_and_tangent(fields, fluid, R, *K);
    else
      assembler_.residual(fields, fluid, R);
    add_tractions(t, R);
    for (const auto& outlet : boundary_.backflows())
      add_backflow<Coordinates>(mesh_, mesh_.boundary(outlet.boundary), outlet.beta * fluid.rho, fields.u, R,
                                K);
  }

  /// What the surroundings give to the fluid per time: momentum (a force) and energy.
  struct Supply {
    Vec<double, dim> momentum{};
    double energy = 0.0;
  };
  /// That of the prescribed velocities and the tractions, less what the flow carries out (eq. 26).
  /// \param R residual before elimination, taken at u and time t.
  [[nodiscard]] Supply supply(std::span<const double> u, std::span<const double> R, double rho,
                              double t) const {
    std::vector<double> T(R.size(), 0.0);
    add_tractions(t, T);
    std::array<double, dim + 1> sums{};
    std::vector<double> free(R.begin(), R.end());
    constraints_.project(mesh_.n_owned_nodes(), free);
    for (int node = 0; node < mesh_.n_owned_nodes(); ++node)
      for (int i = 0; i < dim; ++i) {
        const int k = node * B + i;
        const double force = R[k] - free[k] - T[k];
        sums[i] += force;
        sums[dim] += force * u[k];
      }
    mesh_.comm.sum_in_place(sums.data(), dim + 1);
    Supply total{{}, sums[dim]};
    for (int i = 0; i < dim; ++i) total.momentum[i] = sums[i];
    for (std::size_t b = 0; b < mesh_.boundary_names.size(); ++b) {
      const auto out = carried_out<Coordinates>(mesh_, static_cast<int>(b), u, rho);
      total.energy -= out.kinetic_energy;
      total.momentum -= out.momentum;
    }
    return total;
  }

  /// Parts of the pressure Schur complement at a state (eq. 14).
  [[nodiscard]] SchurParts schur_parts(const FlowFields& fields, const Parameters& fluid) const {
    return assembler_.schur_parts(fields, fluid);
  }

  /// Force of the fluid on a boundary from the residual before elimination (eq. 12), summed over the ranks.
  [[nodiscard]] Vec<double, dim> force(const std::string& boundary, std::span<const double> R) const {
    auto F = Vec<double, dim>::zero();
    for (int node : mesh_.nodes_on(boundary))
      if (node < mesh_.n_owned_nodes())
        for (int i = 0; i < dim; ++i) F[i] -= R[node * B + i];
    mesh_.comm.sum_in_place(F.data, dim);
    return F;
  }

 private:
  struct Prescribed {
    int node;
    int profile;  ///< index into velocities, -1 for zero
    Vec<double, dim> x;
  };

  /// Neumann terms -(w, h) at time t.
  void add_tractions(double t, std::span<double> R) const {
    for (const auto& h : boundary_.tractions())
      add_traction<Coordinates>(
          mesh_, mesh_.boundary(h.boundary), [&](const auto& x, const auto&) { return h.value(x, t); }, R);
    for (const auto& p : boundary_.pressures()) {
      const double value = p.value(t);
      add_traction<Coordinates>(
          mesh_, mesh_.boundary(p.boundary), [&](const auto&, const auto& n) { return -value * n; }, R);
    }
  }

  void check_complete() const {
    std::vector<bool> stated(mesh_.boundary_names.size(), false);
    const auto state = [&](const std::string& name) { stated[mesh_.boundary(name)] = true; };
    for (const auto& b : boundary_.velocities()) state(b.boundary);
    for (const auto& b : boundary_.tractions()) state(b.boundary);
    for (const auto& b : boundary_.pressures()) state(b.boundary);
    for (const auto& name : boundary_.slips()) state(name);
    for (const auto& name : boundary_.free()) state(name);
    for (const auto& b : boundary_.backflows()) (void)mesh_.boundary(b.boundary);  // throws if unknown
    for (std::size_t b = 0; b < stated.size(); ++b)
      if (!stated[b])
        throw Error(ExitCode::configuration, "boundary \"" + mesh_.boundary_names[b] +
                                                 "\" has no condition; expected a velocity, no_slip, slip, "
                                                 "traction, pressure or traction_free");
  }

  /// Later statements win where boundaries meet; what slip fixes stays fixed.
  void find_prescribed() {
    using Projector = Mat<double, dim>;
    const auto x = mesh_.node_coordinates();
    std::vector<Projector> free(mesh_.n_nodes(), Projector::identity());
    std::vector<int> profile(mesh_.n_nodes(), -1);
    for (const std::string& name : boundary_.slips()) {
      const Vec<double, dim> normal = plane_normal(mesh_, name);
      for (int node : mesh_.nodes_on(name)) remove_direction(free[node], normal);
    }
    for (std::size_t k = 0; k < boundary_.velocities().size(); ++k)
      for (int node : mesh_.nodes_on(boundary_.velocities()[k].boundary)) {
        free[node] = Projector::zero();
        profile[node] = static_cast<int>(k);
      }
    for (int node = 0; node < mesh_.n_nodes(); ++node) {
      if (free[node] == Projector::identity()) continue;
      constraints_.set_velocity(node, free[node]);
      prescribed_.push_back({node, profile[node], x[node]});
    }
  }

  const Mesh<Element>& mesh_;
  Boundary boundary_;
  FlowAssembler<Element, Model> assembler_;
  Constraints<B> constraints_;
  std::vector<Prescribed> prescribed_;
};

// Compiled once, in src/instantiate.
extern template class FlowSystem<Tri1>;
extern template class FlowSystem<Tri2>;
extern template class FlowSystem<Quad1>;
extern template class FlowSystem<Quad2>;
extern template class FlowSystem<Tet1>;
extern template class FlowSystem<Tet2>;
extern template class FlowSystem<Hex1>;
extern template class FlowSystem<Hex2>;
extern template class FlowSystem<Wedge1>;

}  // namespace ifsi
