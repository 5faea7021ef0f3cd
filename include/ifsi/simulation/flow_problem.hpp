#pragma once
/// \file
/// A flow in time: one implicit step, or the steady state.

#include <functional>
#include <string>
#include <vector>

#include "ifsi/assembly/integrals.hpp"
#include "ifsi/assembly/wall_traction.hpp"
#include "ifsi/io/mesh_checkpoint.hpp"
#include "ifsi/io/parameters.hpp"
#include "ifsi/linalg/block_norms.hpp"
#include "ifsi/linalg/linear_solver.hpp"
#include "ifsi/simulation/flow_state.hpp"
#include "ifsi/simulation/flow_system.hpp"
#include "ifsi/simulation/newton.hpp"

namespace ifsi {

/// What a user may choose about the numerics of a flow.
struct FlowOptions {
  double rho_inf = 0.5;  ///< spectral radius at infinite frequency of generalized-alpha
  double tau_dt = 0.0;   ///< reference time step inside tau_M; 0: the time step itself
  NewtonOptions newton;
  LinearSolverOptions linear;
  std::array<double, 3> gravity{};

  void declare(Parameters& params) {
    params.add("time.rho_inf", rho_inf, "-", "spectral radius at infinite frequency", {0.0, 1.0});
    params.add("fluid.tau_dt", tau_dt, "time",
               "reference time step in tau_M (0: dt); steps of less than a fifth of it may fail",
               non_negative);
    newton.declare(params);
    params.add_choice("linear.method", linear.method, {"auto", "direct", "gmres"}, "linear solver");
    params.add("linear.max_iterations", linear.max_iterations, "-", "GMRES iterations per solve", {1, 10000});
  }
};

/// Newton's view of a flow step lives here too: see NonlinearSystem. The mesh must outlive the problem.
template <class Element, class Model = FluidModel<>>
class FlowProblem {
 public:
  static constexpr int dim = Element::dim, B = dim + 1;
  using System = FlowSystem<Element, Model>;
  using Point = Vec<double, dim>;
  using Field = std::function<Point(const Point& x)>;
  using ScalarField = std::function<double(const Point& x)>;

  FlowProblem(const Mesh<Element>& mesh, FlowBoundary<dim> boundary, double rho,
              typename Model::Rheology rheology, FlowOptions options)
      : options_(std::move(options)),
        system_(mesh, std::move(boundary)),
        state_(mesh.n_nodes()),
        K_(system_.make_matrix()),
        R_(mesh.n_nodes() * B, 0.0),
        reaction_(R_),
        update_(R_),
        zero_(R_),
        solver_(linear_options(), [this] { return system_.schur_parts(fields(), fluid_); }) {
    if (system_.enclosed()) volumes_ = nodal_volumes<typename Model::Coordinates>(mesh);
    fluid_.rho = rho;
    fluid_.rheology = rheology;
    fluid_.C_I = Element::order == 1 ? 36.0 : 60.0;
    start(0.0, [](const Point&) { return Point::zero(); });
  }

  /// Initial velocity, and where known its rate and the pressure.
  void start(double t, const Field& v, const Field& v_dot = {}, const ScalarField& p = {}) {
    const auto x = system_.mesh().node_coordinates();
    std::vector<double> u(R_.size(), 0.0), rate, pressure;
    if (v_dot) rate.assign(R_.size(), 0.0);
    for (std::size_t node = 0; node < x.size(); ++node) {
      for (int i = 0; i < dim; ++i) u[node * B + i] = v(x[node])[i];
      if (v_dot)
        for (int i = 0; i < dim; ++i) rate[node * B + i] = v_dot(x[node])[i];
      if (p) pressure.push_back(p(x[node]));
    }
    state_.start(t, u, rate, pressure);
    smooth_start_ = static_cast<bool>(v_dot);
  }

  /// One step of generalized-alpha. When the report says it did not converge nothing has changed: try a
  /// smaller dt.
  NewtonReport step(double dt) { return step(GeneralizedAlpha::from_rho_inf(options_.rho_inf), dt, false); }

  /// The steady state, by Newton from the present one; if that fails, through steps of backward Euler of
  /// growing size until Newton holds.
  NewtonReport solve_steady() {
    NewtonReport total;
    double dt = initial_pseudo_dt();
    for (int attempt = 0; attempt < 60; ++attempt) {
      const NewtonReport steady =
          attempt % 5 == 0 ? step(GeneralizedAlpha::backward_euler(), 0.0, true) : NewtonReport{};
      total.iterations += steady.iterations, total.gmres += steady.gmres;
      if (steady.converged) return total.converged = true, total.residual = steady.residual, total;
      const NewtonReport pseudo = step(GeneralizedAlpha::backward_euler(), dt, true);
      total.iterations += pseudo.iterations, total.gmres += pseudo.gmres;
      dt *= pseudo.converged ? 3.0 : 0.25;
      total.failure = steady.failure.empty() ? total.failure : steady.failure;
    }
    return total;
  }

  [[nodiscard]] const FlowState<B>& state() const { return state_; }
  [[nodiscard]] FlowState<B>& state() { return state_; }
  [[nodiscard]] const System& system() const { return system_; }
  [[nodiscard]] const Mesh<Element>& mesh() const { return system_.mesh(); }
  [[nodiscard]] const LinearSolver<B>& solver() const { return solver_; }
  [[nodiscard]] double time() const { return state_.time(); }
  /// Sees every residual evaluation of Newton.
  void watch(std::function<void(const NewtonReport&)> watcher) { watch_ = std::move(watcher); }

  /// Velocity, and pressure at the same time, of every local node.
  [[nodiscard]] std::vector<double> solution() const {
    std::vector<double> u(state_.velocity().begin(), state_.velocity().end());
    for (std::size_t node = 0; node * B < u.size(); ++node)
      u[node * B + dim] = state_.pressure(static_cast<int>(node));
    return u;
  }

  /// Force of the fluid on a boundary (eq. 12) at time state().time_alpha(), of the last step.
  [[nodiscard]] Point force(const std::string& boundary) const { return system_.force(boundary, reaction_); }

  /// Traction of the fluid on walls and the wall shear stress (eq. 31) at time state().time_alpha(), of the
  /// last step. Collective.
  [[nodiscard]] WallTraction<dim> wall_traction(const std::vector<std::string>& walls) const
      requires(Element::shape != Shape::tet || Element::order == 1) {
    return ifsi::wall_traction<typename Model::Coordinates>(mesh(), walls, reaction_);
  }

  /// What the surroundings give to the fluid at time state().time_alpha() of the last step (eq. 26).
  [[nodiscard]] typename System::Supply supply() const {
    return system_.supply(state_.u, reaction_, fluid_.rho, state_.time_alpha());
  }
  /// Momentum, kinetic energy and dissipation at the last completed level, and at state().time_alpha().
  [[nodiscard]] FlowTotals<dim> totals() const { return totals(state_.velocity()); }
  [[nodiscard]] FlowTotals<dim> totals_alpha() const { return totals(state_.u); }

  /// Writes and reads all that the scheme carries from step to step; any number of ranks may read.
  void save(CheckpointWriter& checkpoint) const {
    const auto scalars = state_.scalars();
    for (std::size_t k = 0; k < scalars.size(); ++k)
      checkpoint.number("flow.scalar" + std::to_string(k), scalars[k]);
    state_.for_each_array([&](const char* name, const auto& x, int block) {
      write_nodes(checkpoint, std::string("flow.") + name, mesh(), x.data(), block);
    });
  }
  void restore(const Checkpoint& checkpoint) {
    auto scalars = state_.scalars();
    for (std::size_t k = 0; k < scalars.size(); ++k)
      scalars[k] = checkpoint.number("flow.scalar" + std::to_string(k));
    state_.set_scalars(scalars);
    state_.for_each_array([&](const char* name, auto& x, int block) {
      read_nodes(checkpoint, std::string("flow.") + name, mesh(), x.data(), block);
    });
  }

  // NonlinearSystem
  void assemble_residual() { assemble(nullptr); }
  void assemble_tangent() {
    terms_known_ = false;
    assemble(&K_);
    system_.constraints().eliminate(K_);
  }
  BlockNorms relative_residual() {
    const BlockNorms r = block_norms<B>(mesh().nodes, R_);
    if (!terms_known_) terms_ = absolute_product_norms<B>(K_, state_.u);
    terms_known_ = true;
    const auto ratio = [](double a, double b) { return a == 0.0 ? 0.0 : a / std::max(b, 1e-300); };
    return {ratio(r.momentum, terms_.momentum), ratio(r.mass, terms_.mass)};
  }
  SolverReport solve(BlockNorms target) {
    for (std::size_t i = 0; i < R_.size(); ++i) update_[i] = 0.0, R_[i] = -R_[i];
    const SolverReport report = solver_.solve(K_, R_, update_, target);
    // Prescribed directions that are no unknowns of their own come back with the error of the solver.
    system_.constraints().project(mesh().n_nodes(), update_);
    return report;
  }
  void apply_update(double factor) {
    for (std::size_t i = 0; i < update_.size(); ++i) state_.u[i] += factor * update_[i];
    state_.update_rate();
    terms_known_ = terms_known_ && small_update(factor);
  }

 protected:
  /// Prepares the unknowns and coefficients of a step to time() + dt. dt = 0 with `steady` asks for the
  /// steady equations themselves.
  void open_step(const GeneralizedAlpha& scheme, double dt, bool steady, bool smooth) {
    fluid_.c_inertia = dt > 0.0 ? scheme.c_inertia(dt) : 0.0;
    const double tau_dt = options_.tau_dt > 0.0 ? options_.tau_dt : dt;
    fluid_.tau_rate2 = steady ? 0.0 : 4.0 / (tau_dt * tau_dt);
    inertia_ = dt > 0.0;
    if (fluid_.c_inertia != c_inertia_of_setup_) solver_.invalidate();
    c_inertia_of_setup_ = fluid_.c_inertia;
    state_.begin_step(scheme, dt > 0.0 ? dt : 1.0, smooth);
    system_.for_each_prescribed(state_.time() + (steady ? 0.0 : dt), [&](int node, const Point& value) {
      state_.prescribe(node, system_.constraints().velocity(node), value);
    });
    state_.update_rate();
  }
  void close_step() {
    state_.end_step();
    if (system_.enclosed()) remove_mean_pressure();
  }

  NewtonReport step(const GeneralizedAlpha& scheme, double dt, bool steady) {
    open_step(scheme, dt, steady, !steady && (smooth_start_ || state_.n_steps() > 1));
    const NewtonReport report = newton(*this, options_.newton, watch_);
    if (report.converged) close_step();
    return report;
  }

  /// Whether what was added last leaves the sizes of the terms (and so the pass over K that finds them)
  /// alone.
  [[nodiscard]] bool small_update(double factor) const {
    const BlockNorms added = block_norms<B>(mesh().nodes, update_),
                     u = block_norms<B>(mesh().nodes, state_.u);
    constexpr double small = 0.1;
    return std::abs(factor) * added.momentum <= small * u.momentum &&
           std::abs(factor) * added.mass <= small * u.mass;
  }

  [[nodiscard]] FlowTotals<dim> totals(std::span<const double> u) const {
    return flow_totals<typename Model::Coordinates>(mesh(), u, fluid_.rho, fluid_.rheology);
  }

  [[nodiscard]] LinearSolverOptions linear_options() const {
    LinearSolverOptions linear = options_.linear;
    linear.enclosed = system_.enclosed();
    return linear;
  }

  [[nodiscard]] FlowFields fields() const {
    return {.u = state_.u,
            .u_dot = inertia_ ? state_.rate : zero_,
            .f = {},
            .s = s_,
            .k_p = k_p_,
            .fraction = fraction_,
            .gravity = options_.gravity};
  }

  void assemble(BlockCsr<B>* K) {
    system_.assemble(fields(), fluid_, state_.time_alpha(), R_, K);
    reaction_ = R_;
    system_.constraints().project(mesh().n_owned_nodes(), R_);
  }

  void remove_mean_pressure() {
    double sums[2] = {};
    for (int node = 0; node < mesh().n_owned_nodes(); ++node) {
      sums[0] += volumes_[node] * state_.last_pressure(node);
      sums[1] += volumes_[node];
    }
    mesh().comm.sum_in_place(sums, 2);
    state_.shift_pressure(-sums[0] / sums[1]);
  }

  /// The time a particle needs for a cell, were it to move with the largest prescribed speed.
  [[nodiscard]] double initial_pseudo_dt() const {
    double v_max = 1e-12;
    system_.for_each_prescribed(state_.time(),
                                [&](int, const Point& v) { v_max = std::max(v_max, std::sqrt(dot(v, v))); });
    return mesh().h_max() / mesh().comm.max(v_max);
  }

  FlowOptions options_;
  System system_;
  FlowState<B> state_;
  FluidParameters<typename Model::Rheology> fluid_;
  BlockCsr<B> K_;
  std::vector<double> R_, reaction_, update_, zero_;
  std::vector<double> s_, k_p_;   ///< stabilisation scales near immersed solids; empty without
  std::vector<double> fraction_;  ///< part of each cell that is fluid, with rigid bodies; empty without
  std::vector<double> volumes_;   ///< of owned nodes, in an enclosed flow
  LinearSolver<B> solver_;
  BlockNorms terms_;          ///< sizes of the terms that cancel in the residual
  bool terms_known_ = false;  ///< for the present tangent and state
  std::function<void(const NewtonReport&)> watch_;
  double c_inertia_of_setup_ = -1.0;
  bool inertia_ = true, smooth_start_ = false;
};

// Compiled once, in src/instantiate.
extern template class FlowProblem<Tri1>;
extern template class FlowProblem<Tri2>;
extern template class FlowProblem<Quad1>;
extern template class FlowProblem<Quad2>;
extern template class FlowProblem<Tet1>;
extern template class FlowProblem<Tet2>;
extern template class FlowProblem<Hex1>;
extern template class FlowProblem<Hex2>;
extern template class FlowProblem<Wedge1>;

}  // namespace ifsi
