#pragma once
/// \file
/// Immersed fluid-structure interaction: solids that move with the fluid at their nodes, one system of the
/// fluid's size.

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ifsi/coupling/coupling_matrix.hpp"
#include "ifsi/coupling/cut_cells.hpp"
#include "ifsi/coupling/interpolation.hpp"
#include "ifsi/coupling/mesh_ratio.hpp"
#include "ifsi/linalg/patched_solver.hpp"
#include "ifsi/simulation/flow_problem.hpp"
#include "ifsi/simulation/immersed_solids.hpp"
#include "ifsi/simulation/solid_overlap.hpp"

namespace ifsi {

struct FsiOptions {
  double rho_inf_solid = 0.0;  ///< beta and gamma of the solid's kinematics
  /// Of C within a step: "frozen" at the predicted positions; "updated", at the present ones, but held in the
  /// tangent; "exact", with its derivative (eq. 25).
  std::string treatment = "frozen";
  double k_p = 0.01;     ///< scale of the PSPG term in cells that hold solid nodes (eq. 13)
  int k_p_rings = 0;     ///< layers of cells around those that have it as well
  StabilisationScale s;  ///< tau_M scale around the solid (eq. 4)
  /// A step is rejected when a solid node ends further than this from where it was predicted, in spacings of
  /// the fluid's nodes: C, cut cells and s were taken at the prediction.
  double max_change = 1.0;
  double contact_range = 0.0;     ///< where surfaces begin to repel each other, in fluid spacings; 0: never
  double contact_pressure = 0.0;  ///< of flat surfaces half of the range apart (eq. 33)
  double seal = 0.0;              ///< resistance of narrow gaps (eq. 42); 0: none
  double seal_range = 2.0;        ///< gap from which on there is none, in fluid spacings
  double tie = 0.0;               ///< friction between the solid's nodes, per volume (eq. 44); 0: none
  double tie_spacing = 0.5;       ///< of its points, in fluid spacings
  /// Layers of fluid nodes around the cut cells that are solved for directly. -1: two, in the plane more
  /// where momentum diffuses further within a step; none in space at s = 1, where they cost more than all
  /// else and save no iterations.
  int patch_layers = -1;
  PatchedSolverOptions linear;

  void declare(Parameters& params) {
    params.add("solid.rho_inf", rho_inf_solid, "-", "rho_inf of the solid's kinematics", {0.0, 1.0});
    params.add_choice("coupling.treatment", treatment, {"frozen", "updated", "exact"}, "C within a step");
    params.add("coupling.max_change", max_change, "-",
               "largest distance of a solid node from its prediction, in fluid spacings", positive);
    params.add("coupling.k_p", k_p, "-", "scale of PSPG in cells that hold solid nodes", {0.0, 1.0});
    params.add("coupling.k_p_rings", k_p_rings, "-", "layers of cells around those with the same scale",
               {0, 10});
    params.add("coupling.s_max", s.s_max, "-", "scale s of tau_M around the solid", {1.0, 1e9});
    params.add("coupling.s_rings", s.rings, "-", "layers of nodes beyond the cut cells with s = s_max",
               {0, 100});
    params.add("coupling.tie", tie, "mass/(length^3 time)",
               "friction of the fluid with the solid between its nodes, per volume (0: none)", non_negative);
    params.add("coupling.tie_spacing", tie_spacing, "-",
               "of the points of that friction, in fluid spacings; solids that are finer have none",
               {0.05, 10.0});
    params.add("contact.range", contact_range, "-",
               "distance in fluid spacings from which surfaces of solids repel (0: no contact)",
               non_negative);
    params.add("contact.pressure", contact_pressure, "force/area",
               "pressure between flat surfaces half of the range apart: what they must hold", non_negative);
    params.add(
        "contact.seal", seal, "mass/(length^2 time)",
        "resistance to flow along gaps between surfaces that the mesh cannot resolve, per area (0: none)",
        non_negative);
    params.add("contact.seal_range", seal_range, "-", "gap in fluid spacings from which on there is none",
               positive);
    params.add("coupling.patch_layers", patch_layers, "-",
               "layers around the cut cells solved for directly (-1: by dimension, s and time step)",
               {-1, 20});
    params.add_choice("coupling.base", linear.base, {"auto", "direct", "gmres"},
                      "preconditioner of the fluid alone");
  }
};

/// A flow with immersed bodies of one kind. The same C interpolates and spreads, so that power is conserved;
/// nodal kinematics are recomputed from the fluid velocity in every iteration, so that the constraint holds
/// to round-off. Mesh and problem are not copied: keep both in place.
template <class Element, class Body, class Model = FluidModel<>>
class FsiProblem : public FlowProblem<Element, Model> {
  using Flow = FlowProblem<Element, Model>;

 public:
  using Flow::B, Flow::dim, Flow::mesh;
  using Point = typename Flow::Point;
  using Block = Mat<double, Flow::dim>;

  /// \throws Error (configuration) when a body lies partly outside of the mesh without `may_protrude`, or
  /// when bodies overlap.
  FsiProblem(const Mesh<Element>& mesh, FlowBoundary<Flow::dim> boundary, double rho,
             typename Model::Rheology rheology, std::vector<Body> bodies, FlowOptions flow,
             FsiOptions options, bool may_protrude = false)
      : Flow(mesh, std::move(boundary), rho, rheology, flow),
        fsi_(std::move(options)),
        solids_(std::move(bodies)),
        C_(mesh),
        cut_(mesh),
        K_s_(C_, solids_.cells()),
        patched_(patched_options(),
                 [this] { return this->system_.schur_parts(this->fields(), this->fluid_); }) {
    if constexpr (!Body::is_surface) refuse_overlap(solids_.bodies());
    C_.locate(solids_.positions());
    if (!may_protrude) C_.require_all_found("solid nodes");
    n_held_ = C_.lost().size();
    if (fsi_.contact_range > 0.0) set_contact();
    if (fsi_.seal > 0.0) set_seal();
    if (fsi_.tie > 0.0) set_tie();
  }

  /// A plane that the bodies may not pass. \throws Error (configuration) without contact.range.
  void add_contact_plane(const ContactPlane<Flow::dim>& plane) {
    if (!solids_.contact())
      throw Error(ExitCode::configuration, "a contact plane needs contact.range > 0; it is 0");
    solids_.add_plane(plane);
  }

  /// A symmetry plane behind which the mirror images of the bodies lie: gaps to them are sealed as well.
  /// \throws Error (configuration) without contact.seal.
  void add_seal_mirror(const ContactPlane<Flow::dim>& plane) {
    if (!solids_.seal())
      throw Error(ExitCode::configuration, "a mirror for seals needs contact.seal > 0; it is 0");
    solids_.add_mirror(plane);
  }

  [[nodiscard]] const ImmersedSolids<Body>& solids() const { return solids_; }
  /// Gravity and surface loads of the bodies may be changed between steps.
  [[nodiscard]] std::vector<Body>& bodies() { return solids_.bodies(); }
  [[nodiscard]] const Interpolation<Element>& interpolation() const { return C_; }
  [[nodiscard]] const PatchedSolver<Flow::B>& linear_solver() const { return patched_; }
  /// The largest ratio of solid to fluid node spacing in the present configuration.
  [[nodiscard]] MeshRatio<Flow::dim> ratio() const {
    MeshRatio<Flow::dim> worst;
    for (std::size_t b = 0; b < solids_.bodies().size(); ++b) {
      const auto r =
          mesh_ratio<typename Body::Element>(C_, solids_.bodies()[b].mesh().cells, solids_.first_node(b));
      if (r.ratio > worst.ratio) worst = r;
    }
    return worst;
  }
  /// Distance of the fluid's nodes where the surfaces are, in the mean.
  [[nodiscard]] double fluid_spacing() const {
    double sum = 0.0;
    int n = 0;
    for (const auto& point : solids_.surface_points()) {
      if (!C_.row(point.node).found()) continue;
      double squares = 0.0;
      for (int i = 0; i < Flow::dim; ++i) {
        auto e = Point::zero();
        e[i] = 1.0;
        squares += std::pow(length_in_cells(C_.row(point.node), e), 2);
      }
      sum += std::sqrt(Flow::dim / squares), ++n;
    }
    return sum / std::max(n, 1);
  }
  /// What is known to go wrong with the chosen scheme; empty when nothing is.
  [[nodiscard]] std::string advice() const {
    if (fsi_.treatment != "frozen" || fsi_.rho_inf_solid <= 0.2) return {};
    return "warning: with C frozen and solid.rho_inf above 0.2 sub-grid modes of stiff solids grow; errors "
           "of 10 % "
           "were seen without any other sign. Take coupling.treatment=exact";
  }
  /// Smallest det F of the last assembly, over all ranks.
  [[nodiscard]] double min_det_F() const { return min_det_F_; }

  /// Largest difference between a solid node's velocity and the fluid's there, by the C of the last step.
  [[nodiscard]] double constraint_violation() const {
    const auto v = this->state_.velocity();
    const auto v_f = C_.velocities(v.data(), Flow::B);
    double largest = 0.0;
    for (int a = 0; a < solids_.n_nodes(); ++a)
      for (int i = 0; i < Flow::dim; ++i)
        largest = std::max(largest, std::abs(solids_.velocity()[a * Flow::dim + i] - v_f[a][i]));
    return largest;
  }

  /// As of the flow alone; the solids move with it from the beginning.
  void start(double t, const typename Flow::Field& v, const typename Flow::Field& v_dot = {},
             const typename Flow::ScalarField& p = {}) {
    Flow::start(t, v, v_dot, p);
    C_.locate(solids_.positions());
    solids_.start(C_.velocities(this->state_.velocity().data(), Flow::B));
  }

  /// Force of the fluid on a boundary and on the bodies fixed to it, all of them (eq. 27), at time
  /// state().time_alpha(), of the last step.
  [[nodiscard]] Point force_with_bodies(const std::string& boundary) const {
    return this->force(boundary) + solids_.rate_of_momentum() - held_force();
  }

  /// Part of each local cell that counts as fluid, for the positions of the solids' nodes (eq. 20).
  using FractionAt = std::function<std::vector<double>(const std::vector<Point>& x)>;
  /// Without it all of the box does, and the solids carry the excess over it.
  void set_fraction(FractionAt fraction) { fraction_at_ = std::move(fraction); }

  /// One step; when the report says it did not converge nothing has changed.
  StepReport step(double dt) {
    begin_step(dt);
    StepReport report;
    if (n_lost_nodes() > n_held_) return report.failure = leaving(), report;
    report = newton(*this, this->options_.newton, this->watch_);
    if (report.converged) check_change(report, dt);
    if (!report.converged) patched_.give_up();
    if (report.converged) {
      this->close_step();
      solids_.end_step();
    } else if (!settled_) {
      report.failure += "; the positions of the solid nodes do not settle for this dt";
    } else if (!(min_det_F_ > 0.0)) {
      report.failure += "; solid cell " + std::to_string(worst_cell_) +
                        " is inverted, det F = " + std::to_string(min_det_F_);
    }
    return report;
  }

  /// Momentum and energy that the solids take from the fluid per time, at state().time_alpha() of the last
  /// step (eq. 26).
  [[nodiscard]] typename Flow::System::Supply taken_by_solids() const {
    constexpr int dim = Flow::dim;
    std::array<double, dim + 1> sums = taken_;
    mesh().comm.sum_in_place(sums.data(), dim + 1);
    typename Flow::System::Supply taken{{}, sums[dim]};
    for (int i = 0; i < dim; ++i) taken.momentum[i] = sums[i];
    return taken;
  }

  void save(CheckpointWriter& checkpoint) const {
    Flow::save(checkpoint);
    const_cast<ImmersedSolids<Body>&>(solids_).for_each_array(
        [&](const char* name, const std::vector<double>& x) {
          checkpoint.array(std::string("solid.") + name, x.data(), 1,
                           this->mesh().comm.is_root() ? all_numbers(x) : std::vector<long>{});
        });
  }
  void restore(const Checkpoint& checkpoint) {
    Flow::restore(checkpoint);
    solids_.for_each_array([&](const char* name, std::vector<double>& x) {
      checkpoint.array(std::string("solid.") + name, x.data(), 1, all_numbers(x));
    });
  }

  /// (K_f + C K_s C^T) x of the last tangent, on owned nodes. \param x n_local x B numbers.
  [[nodiscard]] std::vector<double> tangent_times(std::vector<double> x) const {
    std::vector<double> y(x.size(), 0.0);
    this->K_.apply(x.data(), y.data());
    std::vector<double> wide(static_cast<std::size_t>(K_s_constrained_.layout().n_local()) * Flow::B, 0.0),
        z(x.size(), 0.0);
    std::copy_n(x.begin(), mesh().n_owned_nodes() * Flow::B, wide.begin());
    K_s_constrained_.apply(wide.data(), z.data());
    for (std::size_t k = 0; k < z.size(); ++k) y[k] += z[k];
    return y;
  }

  /// Prepares the equations of a step; step() does, then solves them by Newton.
  void begin_step(double dt) {
    const auto scheme = GeneralizedAlpha::from_rho_inf(this->options_.rho_inf);
    const auto rates = GeneralizedAlpha::from_rho_inf(fsi_.rho_inf_solid);
    if (scheme.c_inertia(dt) != c_of_patch_) patched_.invalidate();
    c_of_patch_ = scheme.c_inertia(dt);
    this->open_step(scheme, dt, false, false);
    solids_.begin_step(scheme, rates, dt);
    place_solids(dt);
  }

  // NonlinearSystem
  void assemble_residual() { assemble(false); }
  void assemble_tangent() { assemble(true); }
  BlockNorms relative_residual() {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (!settled_ || !(min_det_F_ > 0.0)) return {nan, nan};
    const BlockNorms r = block_norms<Flow::B>(mesh().nodes, this->R_);
    const BlockNorms fluid = absolute_product_norms<Flow::B>(this->K_, this->state_.u);
    const auto ratio = [](double a, double b) { return a == 0.0 ? 0.0 : a / std::max(b, 1e-300); };
    return {ratio(r.momentum, fluid.momentum + spread_norm_), ratio(r.mass, fluid.mass)};
  }
  SolverReport solve(BlockNorms target) {
    for (std::size_t i = 0; i < this->R_.size(); ++i) this->update_[i] = 0.0, this->R_[i] = -this->R_[i];
    const SolverReport report =
        patched_.solve(this->K_, K_s_constrained_, this->R_, this->update_, SolveTarget{target, {}});
    this->system_.constraints().project(mesh().n_nodes(), this->update_);
    return report;
  }

 private:
  /// A node predicted outside of the mesh would be held there for good.
  [[nodiscard]] std::string leaving() const {
    return std::to_string(n_lost_nodes() - n_held_) +
           " solid nodes are predicted to leave the fluid mesh; expected none but the " +
           std::to_string(n_held_) + " that lie outside from the beginning";
  }

  /// Friction takes its places at the predicted positions.
  void require_frozen(const char* key, double value) const {
    if (fsi_.treatment == "frozen") return;
    throw Error(ExitCode::configuration, key + (" = " + std::to_string(value)) +
                                             " needs coupling.treatment = frozen; it is " + fsi_.treatment);
  }
  /// Nodes in the wall stay there, and no gap opens beside them.
  void set_seal() {
    require_frozen("contact.seal", fsi_.seal);
    auto points = solids_.surface_points();
    std::erase_if(points, [&](const auto& p) { return !C_.row(p.node).found(); });
    solids_.set_seal({std::move(points), fsi_.seal_range * fluid_spacing(), fsi_.seal});
  }

  void set_tie() {
    require_frozen("coupling.tie", fsi_.tie);
    if constexpr (is_tensor_cell<typename Body::Element> && !Body::is_surface &&
                  !Body::Coordinates::axisymmetric) {
      SolidTie<Flow::dim> tie(fsi_.tie_spacing, fsi_.tie);
      for (std::size_t b = 0; b < solids_.bodies().size(); ++b)
        tie.template add_body<typename Body::Element>(C_, solids_.bodies()[b].mesh().cells,
                                                      solids_.first_node(static_cast<int>(b)));
      if (tie.n_points() > 0) solids_.set_tie(std::move(tie));
    } else {
      throw Error(ExitCode::configuration, "coupling.tie = " + std::to_string(fsi_.tie) +
                                               ", expected 0: only solids of quads or hexes can be tied, no "
                                               "membranes and no bodies of revolution");
    }
  }

  void set_contact() {
    if (!(fsi_.contact_pressure > 0.0))
      throw Error(ExitCode::configuration, "contact.pressure = " + std::to_string(fsi_.contact_pressure) +
                                               ", expected the pressure that pushes surfaces together, > 0");
    if (Body::Coordinates::axisymmetric)
      throw Error(ExitCode::configuration, "contact.range = " + std::to_string(fsi_.contact_range) +
                                               ", expected 0 for bodies of revolution: they have no contact");
    solids_.set_contact(fsi_.contact_range * fluid_spacing(), fsi_.contact_pressure);
  }
  /// How far nodes ended from their predicted places; too far is no step.
  void check_change(StepReport& report, double dt) const {
    const auto from = solids_.predicted(dt), to = solids_.new_positions();
    int worst = 0;
    for (int a = 0; a < solids_.n_nodes(); ++a) {
      if (!C_.row(a).found()) continue;
      const double change = length_in_cells(C_.row(a), to[a] - from[a]) / fsi_.max_change;
      if (change > report.change) report.change = change, worst = a;
    }
    if (report.change <= 1.0) return;
    report.converged = false;
    report.failure =
        "solid node " + std::to_string(worst) + " ends " + std::to_string(report.change * fsi_.max_change) +
        " fluid spacings from where it was predicted; expected at most " + std::to_string(fsi_.max_change);
  }

  [[nodiscard]] PatchedSolverOptions patched_options() const {
    PatchedSolverOptions o = fsi_.linear;
    o.enclosed = this->system_.enclosed();
    if (patch_is_dear()) o.growth = 1.0;
    return o;
  }
  /// In space an LU costs much, and at s = 1 the fluid's equations know little of the solid.
  [[nodiscard]] bool patch_is_dear() const { return Flow::dim == 3 && fsi_.s.s_max == 1.0; }
  [[nodiscard]] int patch_layers(double dt) const {
    if (fsi_.patch_layers >= 0) return fsi_.patch_layers;
    if (Flow::dim == 3) return patch_is_dear() ? 0 : 2;
    return std::clamp(static_cast<int>(std::lround(0.6 * diffusion_length(dt))), 2, 8);
  }
  /// How far momentum diffuses in dt, in spacings of the fluid's nodes around the solids, the largest of all.
  [[nodiscard]] double diffusion_length(double dt) const {
    const double length = std::sqrt(this->fluid_.rheology.viscosity(0.0) / this->fluid_.rho * dt);
    double largest = 0.0;
    for (int a = 0; a < solids_.n_nodes(); ++a)
      if (C_.row(a).found())
        for (int d = 0; d < Flow::dim; ++d) {
          auto e = Point::zero();
          e[d] = length;
          largest = std::max(largest, length_in_cells(C_.row(a), e));
        }
    return largest;
  }

  /// C, cut cells, s-field and the patch for the positions the solids are expected at.
  void place_solids(double dt) {
    locate_points(solids_.with_friction_points(solids_.predicted(dt)));
    if (solids_.link_friction()) K_s_.set_cells(solids_.cells());
    cut_.update(C_);
    this->k_p_.assign(mesh().n_cells(), 1.0);
    for (int c : cut_.with_rings(fsi_.k_p_rings)) this->k_p_[c] = fsi_.k_p;
    if (fraction_at_) this->fraction_ = fraction_at_(C_.positions());
    if (fsi_.s.s_max > 1.0) this->s_ = cut_.stabilisation(fsi_.s);
    const int layers_before = std::exchange(patch_layers_, patch_layers(dt));
    update_pattern(patch_layers_ != layers_before);
  }

  /// Nodes and points of friction; these may lie outside: between surfaces in a bulging vessel, or where a
  /// solid is fixed in a wall.
  void locate_points(std::vector<Point> x) {
    C_.locate(x);
    const auto outside = std::span(C_.lost()).subspan(n_lost_nodes());
    if (outside.empty()) return;
    solids_.give_up(outside, x);
    C_.locate(x);
  }
  [[nodiscard]] std::size_t n_lost_nodes() const {
    const auto& lost = C_.lost();
    return std::lower_bound(lost.begin(), lost.end(), solids_.n_nodes()) - lost.begin();
  }

  /// The pattern of C K_s C^T, and the patch on it, if a node has changed its fluid cell, or the patch its
  /// size.
  void update_pattern(bool other_layers = false) {
    if (!K_s_.update() && !other_layers) return;
    K_s_constrained_ = BlockCsr<Flow::B>(K_s_.matrix().shared_pattern());
    constraints_s_ =
        this->system_.constraints().carried_to(K_s_constrained_.layout(), mesh().n_owned_nodes());
    constraints_s_.update_ghosts(K_s_constrained_.layout());
    std::vector<char> in_patch;
    for (int layer : cut_.layers(patch_layers_)) in_patch.push_back(layer <= patch_layers_);
    patched_.set_patch(this->K_, K_s_constrained_, in_patch);
  }

  /// v = C^T v_f at the nodes. Where C follows the nodes this is an equation for each of them, since the
  /// place depends on the velocity: Newton's method, with P = (I - (du/dv) grad v)^-1 (eq. 25).
  void move_solids() {
    this->state_.new_velocities(new_v_);
    settled_ = true;
    if (fsi_.treatment == "frozen") {
      if (solids_.has_friction())
        solids_.set_friction_velocity(C_.velocities(this->state_.u.data(), Flow::B));
      return solids_.set_velocity(C_.velocities(new_v_.data(), Flow::B));
    }
    constexpr int max_iterations = 40, undamped = 10;
    std::vector<Point> v = solids_.new_velocity();
    for (int k = 0; k < max_iterations; ++k) {
      solids_.set_velocity(v);
      C_.locate(solids_.new_positions());
      const auto v_f = C_.velocities(new_v_.data(), Flow::B);
      const auto grad_v = C_.velocity_gradients(new_v_.data(), Flow::B);
      double change = 0.0, largest = 0.0;  // squares of speeds
      P_.resize(v.size());
      for (std::size_t a = 0; a < v.size(); ++a) {
        P_[a] = inverse(Block::identity() - solids_.slopes().u * grad_v[a]);
        const Point dv = P_[a] * (v_f[a] - v[a]);
        v[a] += (k < undamped ? 1.0 : 0.5) * dv;  // grad v jumps at facets: Newton may go to and fro there
        change = std::max(change, dot(dv, dv));
        largest = std::max(largest, dot(v[a], v[a]));
      }
      if (change <= 1e-24 * largest) return solids_.set_velocity(v);
    }
    settled_ = false;
  }

  void assemble_solids(bool tangent) {
    const bool exact = fsi_.treatment == "exact";
    if (solids_.update_contact()) {
      K_s_.set_cells(solids_.cells());
      update_pattern();
    }
    if (tangent) update_pattern(), K_s_.set_zero();
    R_s_.assign(solids_.n_points(), Point::zero());
    const DeformationReport report =
        solids_.assemble(K_s_.relevant_cells(), R_s_, tangent,
                         [&](int i, const Block* K) { exact ? K_s_.add(i, K, P_) : K_s_.add(i, K); });
    if (tangent && exact) {
      // du at n + 1, where C is, for a change of the unknown, the velocity at n + alpha_f.
      const double du_dv = solids_.slopes().u / solids_.alpha_f();
      for (Block& P : P_) P = du_dv * P;
      K_s_.add_spreading(R_s_, P_);
    }
    min_det_F_ = mesh().comm.min(report.min_det_F == report.min_det_F ? report.min_det_F : -1.0);
    worst_cell_ = report.cell;
  }

  void assemble(bool tangent) {
    Flow::assemble(tangent ? &this->K_ : nullptr);
    if (tangent) this->system_.constraints().eliminate(this->K_);
    move_solids();
    assemble_solids(tangent);
    spread_.assign(this->R_.size(), 0.0);
    C_.spread(R_s_, spread_.data(), Flow::B);
    for (std::size_t i = 0; i < spread_.size(); ++i) this->reaction_[i] += spread_[i];
    sum_taken();
    this->system_.constraints().project(mesh().n_owned_nodes(), spread_);
    for (std::size_t i = 0; i < spread_.size(); ++i) this->R_[i] += spread_[i];
    spread_norm_ = block_norms<Flow::B>(mesh().nodes, spread_).momentum;
    if (!tangent) return;
    K_s_constrained_.values = K_s_.matrix().values;
    constraints_s_.eliminate(K_s_constrained_, false);
  }

  /// What holds the nodes outside of the mesh at their place: the sum of their forces, which C spreads
  /// nowhere.
  [[nodiscard]] Point held_force() const {
    auto sum = Point::zero();
    if (C_.lost().empty()) return sum;
    std::vector<int> cells(solids_.cells().size());
    std::iota(cells.begin(), cells.end(), 0);
    std::vector<Point> R(solids_.n_points(), Point::zero());
    solids_.assemble(cells, R, false, [](int, const Mat<double, Flow::dim>*) {});
    for (int p : C_.lost()) sum += R[p];
    return sum;
  }

  /// This rank's part of what the solids take, with what they take from prescribed nodes.
  void sum_taken() {
    taken_ = {};
    for (int node = 0; node < mesh().n_owned_nodes(); ++node)
      for (int i = 0; i < Flow::dim; ++i) {
        const int k = node * Flow::B + i;
        taken_[i] += spread_[k];
        taken_[Flow::dim] += spread_[k] * this->state_.u[k];
      }
  }

  static std::vector<long> all_numbers(const std::vector<double>& x) {
    std::vector<long> numbers(x.size());
    std::iota(numbers.begin(), numbers.end(), 0L);
    return numbers;
  }

  FsiOptions fsi_;
  ImmersedSolids<Body> solids_;
  Interpolation<Element> C_;
  CutCells<Element> cut_;
  FractionAt fraction_at_;
  CouplingMatrix<Element> K_s_;
  BlockCsr<Flow::B> K_s_constrained_;
  Constraints<Flow::B> constraints_s_;  ///< of the layout of K_s
  PatchedSolver<Flow::B> patched_;
  std::vector<Point> R_s_;
  std::vector<Block> P_;  ///< change of a node's velocity per change of the fluid's at its place (eq. 25)
  std::array<double, Flow::dim + 1> taken_{};  ///< momentum and energy per time
  bool settled_ = true;
  std::vector<double> new_v_, spread_;
  double min_det_F_ = 1.0, spread_norm_ = 0.0, c_of_patch_ = -1.0;
  int worst_cell_ = -1, patch_layers_ = 0;
  std::size_t n_held_ = 0;  ///< nodes outside of the mesh from the beginning
};

// What several drivers name is compiled once, in src/instantiate.
extern template class ImmersedSolids<SolidBody<Quad1, NeoHookean>>;
extern template class ImmersedSolids<SolidBody<Quad1, ThinSheet<NeoHookean>>>;
extern template class FsiProblem<Quad1, SolidBody<Quad1, NeoHookean>>;
extern template class FsiProblem<Quad1, SolidBody<Quad1, ThinSheet<NeoHookean>>>;
extern template class FsiProblem<Quad2, SolidBody<Quad1, NeoHookean>>;
extern template class FsiProblem<Quad2, SolidBody<Quad1, ThinSheet<NeoHookean>>>;

}  // namespace ifsi
