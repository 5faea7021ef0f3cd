#pragma once
/// \file
/// Rigid bodies immersed in a flow: their points move with the fluid, their motion is part of the unknowns.

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "ifsi/coupling/cut_cells.hpp"
#include "ifsi/coupling/fluid_fraction.hpp"
#include "ifsi/coupling/interpolation.hpp"
#include "ifsi/coupling/rigid_constraint.hpp"
#include "ifsi/linalg/patched_solver.hpp"
#include "ifsi/simulation/flow_problem.hpp"
#include "ifsi/solid/rigid_body.hpp"

namespace ifsi {

struct RigidFsiOptions {
  double interior = 1e-3;  ///< part of the fluid's equations that is kept inside of bodies (eq. 20)
  double k_p = 1.0;        ///< scale of the PSPG term in cells that hold points of bodies (eq. 13)
  int patch_layers = 2;    ///< layers of fluid nodes around the cut cells that are solved for directly
  PatchedSolverOptions linear;

  void declare(Parameters& params) {
    params.add("rigid.interior", interior, "-", "part of the fluid's equations kept inside bodies (1: all)",
               {1e-12, 1.0});
    params.add("rigid.k_p", k_p, "-", "scale of PSPG in cells that hold points of rigid bodies", {0.0, 1.0});
  }
};

/// A rigid body in a scene: how it moves, the points at which the fluid must move with it, and the distance
/// of a point to it (negative inside), both in its reference position.
template <int dim, class Coordinates>
struct ImmersedRigidBody {
  RigidBody<dim, Coordinates> motion;
  std::vector<Vec<double, dim>> points;
  std::function<double(const Vec<double, dim>&)> distance;
};

/// A flow with rigid bodies (eq. 20-22). The fluid's velocity at the points of a body is that of its rigid
/// motion, by Lagrange multipliers: no penalty, no stiff material. Inside of bodies the fluid's equations are
/// scaled down, cell by cell with the part of the cell that is inside, so that the velocity need not bend
/// within cut cells. Mesh and problem are not copied: keep both in place.
template <class Element, class Model = FluidModel<>>
class RigidFsiProblem : public FlowProblem<Element, Model> {
  using Flow = FlowProblem<Element, Model>;

 public:
  using Flow::B, Flow::dim, Flow::mesh;
  using Point = typename Flow::Point;
  using Coordinates = typename Model::Coordinates;
  using Immersed = ImmersedRigidBody<Flow::dim, Coordinates>;
  using Motion = RigidMotion<Flow::dim, Coordinates>;
  static constexpr int n = Motion::n;

  /// \throws Error (configuration) when a body lies partly outside of the mesh, or the flow is enclosed and
  /// options.interior below 1.
  RigidFsiProblem(const Mesh<Element>& mesh, FlowBoundary<Flow::dim> boundary, double rho,
                  typename Model::Rheology rheology, std::vector<Immersed> bodies, FlowOptions flow,
                  RigidFsiOptions options)
      : Flow(mesh, std::move(boundary), rho, rheology, flow),
        rigid_(std::move(options)),
        bodies_(std::move(bodies)),
        C_(mesh),
        cut_(mesh),
        constraint_(C_, bodies_of_points(), static_cast<int>(bodies_.size())),
        border_(this->K_.shared_pattern(), constraint_.n_extra()),
        patched_(patched_options(), [this] { return schur_parts(); }) {
    check_pressure_level();
    lambda_.assign(constraint_.n_points(), Point::zero());
    for (Immersed& body : bodies_) body.motion.begin_steady();
    C_.locate(expected_points());
    C_.require_all_found("points of rigid bodies");
  }

  [[nodiscard]] const RigidBody<Flow::dim, Coordinates>& body(int b) const { return bodies_[b].motion; }
  [[nodiscard]] const Interpolation<Element>& interpolation() const { return C_; }
  /// Part of each local cell that counts as fluid, as of the last step.
  [[nodiscard]] const std::vector<double>& fraction() const { return this->fraction_; }

  /// One step; when the report says it did not converge nothing has changed.
  NewtonReport step(double dt) {
    const auto scheme = GeneralizedAlpha::from_rho_inf(this->options_.rho_inf);
    return step(scheme, dt);
  }
  /// A step of backward Euler, to be made very small from an impulsive start: it finds the accelerations.
  NewtonReport start_step(double dt) { return step(GeneralizedAlpha::backward_euler(), dt); }
  /// The steady velocity of flow and bodies with the bodies at their present place.
  NewtonReport solve_steady() { return step(GeneralizedAlpha::backward_euler(), 0.0); }

  /// Largest difference between the fluid's velocity at a point and the body's, at the end of the last step.
  [[nodiscard]] double constraint_violation() const {
    double largest = 0.0;
    for (const Point& g : gaps_)
      for (int i = 0; i < Flow::dim; ++i) largest = std::max(largest, std::abs(g[i]));
    return largest;
  }

  void save(CheckpointWriter& checkpoint) const {
    Flow::save(checkpoint);
    const_cast<RigidFsiProblem*>(this)->for_each_array([&](const std::string& name, double* x, int count) {
      checkpoint.array(name, x, 1, this->mesh().comm.is_root() ? numbers(count) : std::vector<long>{});
    });
  }
  void restore(const Checkpoint& checkpoint) {
    Flow::restore(checkpoint);
    for_each_array(
        [&](const std::string& name, double* x, int count) { checkpoint.array(name, x, 1, numbers(count)); });
  }

  // NonlinearSystem
  void assemble_residual() { assemble(false); }
  void assemble_tangent() { assemble(true); }
  BlockNorms relative_residual() {
    const BlockNorms r = block_norms<Flow::B>(border_.layout(), R_bordered_);
    const BlockNorms fluid = absolute_product_norms<Flow::B>(this->K_, this->state_.u);
    const auto ratio = [](double a, double b) { return a == 0.0 ? 0.0 : a / std::max(b, 1e-300); };
    return {ratio(r.momentum, fluid.momentum + spread_norm_), ratio(r.mass, fluid.mass)};
  }
  SolverReport solve(BlockNorms target) {
    update_bordered_.assign(R_bordered_.size(), 0.0);
    for (double& r : R_bordered_) r = -r;
    const SolverReport report = patched_.solve(K_bordered_, constraint_.matrix(), R_bordered_,
                                               update_bordered_, SolveTarget{target, {}});
    constraints_.project(border_.layout().n_owned(), update_bordered_);
    std::copy_n(update_bordered_.begin(), mesh().n_owned_nodes() * Flow::B, this->update_.begin());
    mesh().nodes.update_ghosts(this->update_.data(), Flow::B);
    further_.assign(static_cast<std::size_t>(constraint_.n_extra()) * Flow::B, 0.0);
    for (int k = 0; k < border_.n_here(); ++k)
      std::copy_n(&update_bordered_[border_.local(k) * Flow::B], Flow::B, &further_[k * Flow::B]);
    mesh().comm.sum_in_place(further_.data(), static_cast<int>(further_.size()));
    return report;
  }
  void apply_update(double factor) {
    Flow::apply_update(factor);
    for (int p = 0; p < constraint_.n_points(); ++p)
      for (int i = 0; i < Flow::dim; ++i) lambda_[p][i] += factor * scale_ * further_[p * Flow::B + i];
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      typename Motion::Dofs dW;
      for (int j = 0; j < n; ++j) dW[j] = further_[further_index(b, j)];
      bodies_[b].motion.add(factor, dW);
    }
  }

 private:
  using Constraint = RigidConstraint<Element, n>;

  NewtonReport step(const GeneralizedAlpha& scheme, double dt) {
    const bool steady = dt == 0.0, predict = !steady && this->state_.n_steps() > 1;
    if (this->c_inertia_of_setup_ != (steady ? 0.0 : scheme.c_inertia(dt))) patched_.invalidate();
    this->open_step(scheme, dt, steady, predict);
    for (Immersed& body : bodies_)
      steady ? body.motion.begin_steady() : body.motion.begin_step(scheme, dt, predict);
    alpha_f_ = scheme.alpha_f;
    const std::vector<Point> lambda = lambda_;
    place_bodies();
    const NewtonReport report = newton(*this, this->options_.newton, this->watch_);
    if (report.converged) {
      this->close_step();
      for (Immersed& body : bodies_) body.motion.end_step();
    } else {
      lambda_ = lambda;
    }
    return report;
  }

  /// With fractions a constant pressure is no longer without effect in cut cells.
  void check_pressure_level() const {
    if (this->system_.enclosed() && rigid_.interior < 1.0)
      throw Error(ExitCode::configuration,
                  "rigid.interior = " + std::to_string(rigid_.interior) +
                      " in an enclosed flow, whose pressure is known up to a constant; expected "
                      "rigid.interior = 1, or a boundary with a traction");
  }
  [[nodiscard]] PatchedSolverOptions patched_options() const {
    PatchedSolverOptions o = rigid_.linear;
    o.enclosed = this->system_.enclosed();
    return o;
  }
  [[nodiscard]] std::vector<int> bodies_of_points() const {
    std::vector<int> of;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      of.insert(of.end(), bodies_[b].points.size(), static_cast<int>(b));
    return of;
  }
  [[nodiscard]] std::vector<Point> expected_points() const {
    std::vector<Point> x;
    for (const Immersed& body : bodies_)
      for (const Point& X : body.points) x.push_back(body.motion.expected(X));
    return x;
  }
  [[nodiscard]] std::size_t further_index(std::size_t body, int dof) const {
    return static_cast<std::size_t>(constraint_.node_of(static_cast<int>(body), dof)) * Flow::B +
           Constraint::component_of(dof);
  }

  /// C, cut cells, fluid fractions and the patch where the bodies are expected.
  void place_bodies() {
    C_.locate(expected_points());
    C_.require_all_found("points of rigid bodies");
    cut_.update(C_);
    this->k_p_.assign(mesh().n_cells(), 1.0);
    for (int c : cut_.cells()) this->k_p_[c] = rigid_.k_p;
    const auto distance = [&](const Point& x) {
      double d = std::numeric_limits<double>::infinity();
      for (const Immersed& body : bodies_) d = std::min(d, body.distance(body.motion.reference(x)));
      return d;
    };
    this->fraction_ = fluid_weights<Coordinates>(mesh(), distance, rigid_.interior);
    P_.clear();
    for (const Immersed& body : bodies_)
      for (const Point& X : body.points) P_.push_back(Motion::velocity_at(body.motion.lever(X)));
    free_ = constraint_.free_directions([&](int node) { return this->system_.constraints().velocity(node); });
    if (C_.revision() != revision_) renew_pattern();
    constrain_further();
    scale_ = 0.0;
  }

  void renew_pattern() {
    revision_ = C_.revision();
    constraint_.make_pattern(border_);
    border_.extend(this->K_, 1.0, K_bordered_);
    std::vector<char> in_patch(border_.layout().n_local(), 0);
    const std::vector<int> layers = cut_.layers(rigid_.patch_layers);
    for (std::size_t i = 0; i < layers.size(); ++i)
      in_patch[bordered_index(static_cast<int>(i))] = layers[i] <= rigid_.patch_layers;
    for (int k = 0; k < border_.n_here(); ++k) in_patch[border_.local(k)] = 1;
    patched_.set_patch(K_bordered_, constraint_.matrix(), in_patch);
  }
  /// Local index in the border's layout of a local fluid node.
  [[nodiscard]] int bordered_index(int node) const {
    return node < mesh().n_owned_nodes() ? node : node + border_.n_here();
  }

  /// What is free of the nodes of the constraint's layout: of the fluid, of multipliers and motions.
  void constrain_further() {
    const Layout& layout = constraint_.matrix().layout();
    constraints_ = this->system_.constraints().carried_to(layout, mesh().n_owned_nodes());
    using Projector = Mat<double, Flow::B>;
    for (int k = 0; k < border_.n_here(); ++k) constraints_.set(border_.local(k), Projector::zero());
    for (int p = 0; p < constraint_.n_points() && border_.n_here() > 0; ++p) {
      Projector P = Projector::zero();
      for (int i = 0; i < Flow::dim; ++i)
        for (int j = 0; j < Flow::dim; ++j) P(i, j) = free_[p](i, j);
      constraints_.set(border_.local(p), P);
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (int j = 0; j < n && border_.n_here() > 0; ++j)
        if (bodies_[b].motion.free()[j]) {
          const int node = border_.local(constraint_.node_of(static_cast<int>(b), j));
          Projector P = constraints_[node];
          P(Constraint::component_of(j), Constraint::component_of(j)) = 1.0;
          constraints_.set(node, P);
        }
    constraints_.update_ghosts(layout);
  }

  void assemble(bool tangent) {
    Flow::assemble(tangent ? &this->K_ : nullptr);
    if (tangent) assemble_matrix();
    this->state_.new_velocities(new_v_);
    gaps_ = C_.velocities(new_v_.data(), Flow::B);
    for (std::size_t p = 0; p < gaps_.size(); ++p) {
      gaps_[p] -= P_[p] * bodies_[constraint_.body_of(p)].motion.new_velocity();
      gaps_[p] = free_[p] * gaps_[p];
    }
    spread_.assign(this->R_.size(), 0.0);
    C_.spread(lambda_, spread_.data(), Flow::B);
    this->system_.constraints().project(mesh().n_owned_nodes(), spread_);
    spread_norm_ = block_norms<Flow::B>(mesh().nodes, spread_).momentum;
    R_bordered_.assign(static_cast<std::size_t>(border_.layout().n_local()) * Flow::B, 0.0);
    for (int i = 0; i < mesh().n_owned_nodes() * Flow::B; ++i) R_bordered_[i] = this->R_[i] + spread_[i];
    if (border_.n_here() > 0) add_further_residual();
  }

  void assemble_matrix() {
    this->system_.constraints().eliminate(this->K_);
    if (scale_ == 0.0) scale_ = mean_diagonal();
    border_.extend(this->K_, scale_, K_bordered_);
    std::vector<Mat<double, n>> K_r;
    for (const Immersed& body : bodies_) K_r.push_back(body.motion.tangent());
    constraint_.fill(border_, P_, K_r, scale_, scale_);
    constraints_.eliminate(constraint_.matrix(), false);
  }

  /// Constraints, and the balance of forces and moments on the bodies.
  void add_further_residual() {
    const auto at = [&](int node, int i) -> double& {
      return R_bordered_[border_.local(node) * Flow::B + i];
    };
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto R = bodies_[b].motion.residual();
      for (int j = 0; j < n; ++j)
        at(constraint_.node_of(static_cast<int>(b), j), Constraint::component_of(j)) = R[j];
    }
    for (int p = 0; p < constraint_.n_points(); ++p)
      for (int i = 0; i < Flow::dim; ++i) {
        at(p, i) = scale_ * alpha_f_ * gaps_[p][i];
        for (int j = 0; j < n; ++j)
          at(constraint_.node_of(constraint_.body_of(p), j), Constraint::component_of(j)) -=
              P_[p](i, j) * lambda_[p][i];
      }
    constraints_.project(border_.layout().n_owned(), R_bordered_);
  }

  /// Mean diagonal entry of the fluid's momentum rows near the bodies.
  [[nodiscard]] double mean_diagonal() const {
    double sums[2] = {};
    for (int p : C_.owned_points())
      for (long node : C_.row(p).node) {
        const long local = node - mesh().nodes.first_global();
        if (local < 0 || local >= mesh().n_owned_nodes()) continue;
        const int row = static_cast<int>(local);
        sums[0] += this->K_.at(this->K_.find(row, row))[Flow::B * Flow::dim - Flow::B + Flow::dim - 1];
        sums[1] += 1.0;
      }
    mesh().comm.sum_in_place(sums, 2);
    return sums[0] / sums[1];
  }

  /// The fluid's parts; the further rows are diagonal rows.
  [[nodiscard]] SchurParts schur_parts() const {
    SchurParts parts = this->system_.schur_parts(this->fields(), this->fluid_);
    const auto extend = [&](BlockCsr<1>& matrix, double diagonal) {
      BlockCsr<1> extended;
      border_.extend(matrix, diagonal, extended);
      matrix = std::move(extended);
    };
    extend(parts.mass, 1.0), extend(parts.laplacian, 1.0), extend(parts.convection, 0.0);
    return parts;
  }

  template <class Visit>
  void for_each_array(Visit&& visit) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      bodies_[b].motion.for_each_array([&](const char* name, double* x, int count) {
        visit("rigid" + std::to_string(b) + "." + name, x, count);
      });
  }
  static std::vector<long> numbers(int count) {
    std::vector<long> result(count);
    std::iota(result.begin(), result.end(), 0L);
    return result;
  }

  RigidFsiOptions rigid_;
  std::vector<Immersed> bodies_;
  Interpolation<Element> C_;
  CutCells<Element> cut_;
  Constraint constraint_;
  Border border_;
  BlockCsr<Flow::B> K_bordered_;
  Constraints<Flow::B> constraints_;  ///< of the layout of the constraint's matrix
  PatchedSolver<Flow::B> patched_;
  std::vector<Mat<double, Flow::dim, n>> P_;  ///< rigid velocity at each point
  std::vector<Mat<double, Flow::dim>> free_;  ///< projector of each point's constraint
  std::vector<Point> lambda_, gaps_;          ///< multipliers; violation of the constraints at n + 1
  std::vector<double> new_v_, spread_, R_bordered_, update_bordered_, further_;
  double spread_norm_ = 0.0, scale_ = 0.0, alpha_f_ = 1.0;
  long revision_ = -1;
};

}  // namespace ifsi
