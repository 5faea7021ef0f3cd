#pragma once
/// \file
/// The solids of a scene in motion: nodal kinematics, forces and tangents of all bodies together.

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ifsi/assembly/solid_body.hpp"
#include "ifsi/coupling/solid_cells.hpp"
#include "ifsi/coupling/solid_tie.hpp"
#include "ifsi/coupling/surface_contact.hpp"
#include "ifsi/coupling/surface_seal.hpp"
#include "ifsi/time/generalized_alpha.hpp"

namespace ifsi {

/// Nodal displacement, velocity and acceleration of all bodies, and their levels within a step (eq. 15).
/// Everything follows from the velocity that the fluid gives the nodes. Nodes are numbered body after body.
template <class Body>
class ImmersedSolids {
 public:
  static constexpr int dim = Body::dim;
  using Point = Vec<double, dim>;

  explicit ImmersedSolids(std::vector<Body> bodies) : bodies_(std::move(bodies)) {
    for (const Body& body : bodies_) {
      first_node_.push_back(static_cast<int>(X_.size()));
      first_cell_.push_back(cells_.size());
      body.list_cells(cells_, first_node_.back());
      X_.insert(X_.end(), body.mesh().points.begin(), body.mesh().points.end());
    }
    n_body_cells_ = first_link_ = first_tie_ = cells_.size();
    for (auto* x : {&u_, &v_, &a_, &u_old_, &v_old_, &a_old_, &u_alpha_, &v_alpha_, &a_alpha_})
      x->assign(X_.size() * dim, 0.0);
  }

  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  [[nodiscard]] std::vector<Body>& bodies() { return bodies_; }
  /// The cells of all bodies, then the contacts, the links of the seal and the ties, which couple nodes as
  /// cells do.
  [[nodiscard]] const SolidCells& cells() const { return cells_; }
  [[nodiscard]] int n_nodes() const { return static_cast<int>(X_.size()); }
  /// Nodes and, behind them, the gap points of the seal and the points of the tie.
  [[nodiscard]] int n_points() const { return first_tie_point() + (tie_ ? tie_->n_points() : 0); }
  [[nodiscard]] int first_node(int body) const { return first_node_[body]; }
  /// Displacement and velocity of the last completed level, dim numbers per node.
  [[nodiscard]] std::span<const double> displacement() const { return u_old_; }
  [[nodiscard]] std::span<const double> velocity() const { return v_old_; }
  [[nodiscard]] Point displacement(int node) const {
    Point u;
    for (int i = 0; i < dim; ++i) u[i] = u_old_[node * dim + i];
    return u;
  }

  /// Positions predicted for the end of a step: X + u + dt v + dt^2/2 a of the last level.
  [[nodiscard]] std::vector<Point> predicted(double dt) const {
    std::vector<Point> x = X_;
    for (std::size_t k = 0; k < u_.size(); ++k)
      x[k / dim][k % dim] += u_old_[k] + dt * v_old_[k] + 0.5 * dt * dt * a_old_[k];
    return x;
  }
  [[nodiscard]] std::vector<Point> positions() const { return predicted(0.0); }
  /// Positions and velocities at n + 1 as the last set_velocity() left them.
  [[nodiscard]] std::vector<Point> new_positions() const { return points(u_, X_); }
  [[nodiscard]] std::vector<Point> new_velocity() const {
    return points(v_, std::vector<Point>(X_.size(), Point::zero()));
  }

  /// Starts with these velocities, undeformed.
  void start(std::span<const Point> v) {
    for (std::size_t k = 0; k < v_.size(); ++k) v_[k] = v_old_[k] = v[k / dim][k % dim];
  }

  /// \param levels alpha_m and alpha_f of the fluid; \param rates beta and gamma of the solid.
  void begin_step(const GeneralizedAlpha& levels, const GeneralizedAlpha& rates, double dt) {
    levels_ = levels, rates_ = rates, dt_ = dt;
  }
  /// Changes of the state at its levels per change of the fluid velocity at alpha_f (eq. 16).
  [[nodiscard]] StateSlopes slopes() const {
    return {.u = rates_.beta * dt_ / rates_.gamma,
            .v = 1.0,
            .a = levels_.alpha_m / (rates_.gamma * dt_ * levels_.alpha_f)};
  }

  /// Kinematics from the nodal velocity v = C^T v_f at n + 1 (eq. 15).
  void set_velocity(std::span<const Point> v) {
    const double dt = dt_, beta = rates_.beta;
    for (std::size_t k = 0; k < u_.size(); ++k) {
      v_[k] = v[k / dim][k % dim];
      a_[k] = rates_.rate(v_[k], v_old_[k], a_old_[k], dt);
      u_[k] = u_old_[k] + dt * v_old_[k] + dt * dt * ((0.5 - beta) * a_old_[k] + beta * a_[k]);
      u_alpha_[k] = u_old_[k] + levels_.alpha_f * (u_[k] - u_old_[k]);
      v_alpha_[k] = v_old_[k] + levels_.alpha_f * (v_[k] - v_old_[k]);
      a_alpha_[k] = a_old_[k] + levels_.alpha_m * (a_[k] - a_old_[k]);
    }
  }
  /// Makes the surfaces repel each other from `range` on, see SurfaceContact.
  /// \throws Error (configuration) when a range is less than the size of the faces of a surface.
  void set_contact(double range, double pressure) {
    check_surfaces(range);
    contact_.emplace(surface_points(), range, pressure);
  }
  [[nodiscard]] const std::optional<SurfaceContact<dim>>& contact() const { return contact_; }
  /// Energy and least distance of the contacts at the last completed level.
  [[nodiscard]] typename SurfaceContact<dim>::Totals contact_totals() const {
    return contact_->totals(points(u_old_, X_));
  }
  void add_plane(const ContactPlane<dim>& plane) { contact_->add_plane(plane); }
  /// Finds the contacts for the level where the equations hold; says whether cells() has changed.
  bool update_contact() {
    if (!contact_ || !contact_->update(points(u_alpha_, X_))) return false;
    list_cells();
    return true;
  }

  /// Holds the fluid back in narrow gaps between surfaces, see SurfaceSeal.
  void set_seal(SurfaceSeal<dim> seal) { seal_.emplace(std::move(seal)); }
  [[nodiscard]] const std::optional<SurfaceSeal<dim>>& seal() const { return seal_; }
  void add_mirror(const ContactPlane<dim>& plane) { seal_->add_mirror(plane); }
  /// Ties the fluid to the solids between their nodes, see SolidTie.
  void set_tie(SolidTie<dim> tie) { tie_.emplace(std::move(tie)); }
  [[nodiscard]] const std::optional<SolidTie<dim>>& tie() const { return tie_; }

  /// Appends gap points and points of the tie to these positions of the nodes.
  [[nodiscard]] std::vector<Point> with_friction_points(std::vector<Point> x) {
    std::vector<Point> more = seal_ ? seal_->find(x) : std::vector<Point>{};
    if (tie_) {
      const std::vector<Point> in_cells = tie_->find(x);
      more.insert(more.end(), in_cells.begin(), in_cells.end());
    }
    x.insert(x.end(), more.begin(), more.end());
    return x;
  }
  /// Lists what friction couples; says whether cells() has changed.
  bool link_friction() {
    if (!seal_ && !tie_) return false;
    const SolidCells old = cells_;
    list_cells();
    return cells_ != old;
  }
  /// Gives up points of friction, by their numbers among all points, that lie outside of the fluid, and takes
  /// them to nodes. \param x positions of all points
  void give_up(std::span<const int> outside, std::span<Point> x) {
    std::vector<char> no_gap(seal_ ? seal_->n_gap_points() : 0, 0);
    for (int p : outside) {
      const int k = p - first_tie_point();
      if (k >= 0) tie_->leave_out(k);
      if (k < 0) no_gap[p - n_nodes()] = 1;
      x[p] = x[k >= 0 ? tie_->home(k) : seal_->node(p - n_nodes())];
    }
    if (seal_) seal_->keep_links([&](int gap) { return !no_gap[gap]; });
  }
  /// Velocities of the fluid, where the equations hold, at all points; those beyond the nodes are kept.
  void set_friction_velocity(std::span<const Point> v) { friction_v_.assign(v.begin() + n_nodes(), v.end()); }
  [[nodiscard]] bool has_friction() const { return seal_ || tie_; }
  /// What friction in the gaps takes per time, where the equations hold.
  [[nodiscard]] double seal_power() const {
    double power = 0.0;
    if (seal_)
      for (const auto& link : seal_->links())
        power += SurfaceSeal<dim>::term(link, velocities_alpha(seal_->nodes(link, n_nodes()))).power;
    return power;
  }
  /// What friction with the tied points takes.
  [[nodiscard]] double tie_power() const {
    double power = 0.0;
    for (int c = 0; tie_ && c < tie_->n_cells(); ++c) {
      const auto v = velocities_alpha(tie_->nodes(c, first_tie_point()));
      std::vector<Point> R(v.size());
      power += tie_->add(c, v, R, {});
    }
    return power;
  }
  /// Nodes on the surfaces of all bodies.
  [[nodiscard]] std::vector<SurfacePoint<dim>> surface_points() const {
    std::vector<SurfacePoint<dim>> surface;
    std::vector<double> area(X_.size(), 0.0);
    for_each_face([&](int, std::span<const int> nodes, std::span<const double> areas) {
      for (std::size_t a = 0; a < nodes.size(); ++a) area[nodes[a]] += areas[a];
    });
    for (int b = 0; b < static_cast<int>(bodies_.size()); ++b)
      for (int a = first_node_[b]; a < first_node_[b] + bodies_[b].n_nodes(); ++a)
        if (area[a] > 0.0) surface.push_back({a, b, area[a], X_[a]});
    return surface;
  }

  [[nodiscard]] double alpha_f() const { return levels_.alpha_f; }
  void end_step() { u_old_ = u_, v_old_ = v_, a_old_ = a_; }

  /// Residual (and tangent, when `matrix` takes it) of the listed cells: R, of all points, is added to,
  /// `matrix(i, K)` receives the place i in the list and the cell's blocks.
  template <class MatrixSink>
  DeformationReport assemble(std::span<const int> cells, std::span<Point> R, bool tangent,
                             MatrixSink&& matrix) const {
    DeformationReport worst;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto [list, offset] = cells_of(static_cast<int>(b), cells);
      const int n = bodies_[b].n_dofs(), first = first_node_[b] * dim;
      const auto part = [&](const std::vector<double>& x) {
        return std::span<const double>(x).subspan(first, n);
      };
      const SolidState state{part(u_alpha_), part(v_alpha_), part(a_alpha_)};
      std::size_t i = offset;
      const auto add_residual = [&](int cell, std::span<const double> R_e) {
        const auto nodes = cells_[first_cell_[b] + cell];
        for (std::size_t a = 0; a < nodes.size(); ++a)
          for (int k = 0; k < dim; ++k) R[nodes[a]][k] += R_e[a * dim + k];
      };
      DeformationReport report;
      if (tangent)
        report = bodies_[b].residual_and_tangent(
            state, slopes(), list, [&](int cell, std::span<const double> R_e, std::span<const double> K_e) {
              add_residual(cell, R_e);
              while (cells[i] != first_cell_[b] + cell) ++i;
              matrix(static_cast<int>(i), reinterpret_cast<const Mat<double, dim>*>(K_e.data()));
            });
      else
        report = bodies_[b].residual(state, list, add_residual);
      if (report.cell >= 0) worst.merge(report.min_det_F, first_cell_[b] + report.cell);
      if constexpr (!Body::is_surface) add_loads(static_cast<int>(b), list, offset, R, tangent, matrix);
    }
    if (contact_) add_contact(cells, R, tangent, matrix);
    if (seal_) add_seal(cells, R, tangent, matrix);
    if (tie_) add_tie(cells, R, tangent, matrix);
    return worst;
  }

  /// Volumes, energies and the worst deformation of all bodies at the last completed level.
  [[nodiscard]] SolidTotals<dim> totals() const {
    SolidTotals<dim> sum;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const int n = bodies_[b].n_dofs(), first = first_node_[b] * dim;
      const auto part = [&](const std::vector<double>& x) {
        return std::span<const double>(x).subspan(first, n);
      };
      const auto t = bodies_[b].totals({part(u_old_), part(v_old_), part(a_old_)}, bodies_[b].all_cells());
      sum.volume += t.volume, sum.reference_volume += t.reference_volume;
      sum.elastic_energy += t.elastic_energy, sum.kinetic_energy += t.kinetic_energy;
      sum.momentum += t.momentum;
      sum.deformation.merge(t.deformation.min_det_F, first_cell_[b] + t.deformation.cell);
    }
    return sum;
  }

  /// Largest principal stress and strain at all quadrature points at the last completed level.
  [[nodiscard]] PrincipalSamples principal_samples() const {
    PrincipalSamples samples;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      bodies_[b].add_principal_samples(
          std::span<const double>(u_old_).subspan(first_node_[b] * dim, bodies_[b].n_dofs()), samples);
    return samples;
  }

  /// Rate of change of the momentum of all bodies less their weight, at the level where the equations hold.
  [[nodiscard]] Point rate_of_momentum() const {
    auto sum = Point::zero();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const int n = bodies_[b].n_dofs(), first = first_node_[b] * dim;
      std::vector<double> a(a_alpha_.begin() + first, a_alpha_.begin() + first + n);
      for (int k = 0; k < n; ++k) a[k] -= bodies_[b].parameters.gravity[k % dim];
      const SolidState state{std::span<const double>(u_alpha_).subspan(first, n), a, {}};
      sum += bodies_[b].totals(state, bodies_[b].all_cells()).momentum;  // linear in the velocity
    }
    return sum;
  }

  /// Calls visit(name, array) for what a restart needs.
  template <class Visit>
  void for_each_array(Visit&& visit) {
    visit("displacement", u_old_), visit("velocity", v_old_), visit("acceleration", a_old_);
  }

 private:
  /// origin + x, dim numbers per node as points.
  [[nodiscard]] static std::vector<Point> points(const std::vector<double>& x, std::vector<Point> origin) {
    for (std::size_t k = 0; k < x.size(); ++k) origin[k / dim][k % dim] += x[k];
    return origin;
  }

  /// Surface loads of a body on the faces of the listed cells (its own numbers), which begin at `offset` of
  /// the list that `matrix` knows.
  template <class MatrixSink>
  void add_loads(int body, std::span<const int> list, std::size_t offset, std::span<Point> R, bool tangent,
                 MatrixSink&& matrix) const {
    constexpr int n = Body::n;
    const std::span<const double> u(u_alpha_.data() + first_node_[body] * dim, bodies_[body].n_dofs());
    bodies_[body].add_loads(
        1.0, u, slopes(),
        [&](int cell, std::span<const int> nodes, std::span<const double> R_f, std::span<const double> K_f) {
          const auto at = std::lower_bound(list.begin(), list.end(), cell);
          if (at == list.end() || *at != cell) return;
          for (std::size_t k = 0; k < R_f.size(); ++k)
            R[first_node_[body] + nodes[k / dim]][k % dim] += R_f[k];
          if (!tangent || K_f.empty()) return;
          const auto& of_cell = bodies_[body].mesh().cells[cell];
          std::array<Mat<double, dim>, n * n> K;
          K.fill(Mat<double, dim>::zero());
          const auto place = [&](int node) {
            return std::find(of_cell.begin(), of_cell.end(), node) - of_cell.begin();
          };
          for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t b = 0; b < nodes.size(); ++b)
              std::copy_n(&K_f[(a * nodes.size() + b) * dim * dim], dim * dim,
                          K[place(nodes[a]) * n + place(nodes[b])].data);
          matrix(static_cast<int>(offset + (at - list.begin())), K.data());
        });
  }

  /// Those of the listed cells that are contacts (eq. 32, eq. 34).
  template <class MatrixSink>
  void add_contact(std::span<const int> cells, std::span<Point> R, bool tangent, MatrixSink&& matrix) const {
    const std::vector<Point> x = points(u_alpha_, X_);
    const auto first = std::lower_bound(cells.begin(), cells.end(), n_body_cells_) - cells.begin();
    for (std::size_t i = first; i < cells.size() && cells[i] < first_link_; ++i) {
      auto term = contact_->term(cells[i] - n_body_cells_, x);
      const auto nodes = cells_[cells[i]];
      for (std::size_t a = 0; a < nodes.size(); ++a) R[nodes[a]] += term.R[a];
      if (!tangent || term.energy == 0.0) continue;  // beyond the range
      for (auto& K : term.K) K = slopes().u * K;
      matrix(static_cast<int>(i), term.K.data());
    }
  }

  /// Those of the listed cells that are links of the seal (eq. 42).
  template <class MatrixSink>
  void add_seal(std::span<const int> cells, std::span<Point> R, bool tangent, MatrixSink&& matrix) const {
    const auto first = std::lower_bound(cells.begin(), cells.end(), first_link_) - cells.begin();
    for (std::size_t i = first; i < cells.size() && cells[i] < first_tie_; ++i) {
      const auto nodes = cells_[cells[i]];
      auto term = SurfaceSeal<dim>::term(seal_->links()[cells[i] - first_link_], velocities_alpha(nodes));
      for (std::size_t a = 0; a < nodes.size(); ++a) R[nodes[a]] += term.R[a];
      if (!tangent) continue;
      for (auto& K : term.K) K = slopes().v * K;
      matrix(static_cast<int>(i), term.K.data());
    }
  }
  /// Those of the listed cells that are ties (eq. 44).
  template <class MatrixSink>
  void add_tie(std::span<const int> cells, std::span<Point> R, bool tangent, MatrixSink&& matrix) const {
    std::vector<Point> R_c;
    std::vector<Mat<double, dim>> K;
    const auto first = std::lower_bound(cells.begin(), cells.end(), first_tie_) - cells.begin();
    for (std::size_t i = first; i < cells.size(); ++i) {
      const auto nodes = cells_[cells[i]];
      R_c.assign(nodes.size(), Point::zero());
      K.assign(tangent ? nodes.size() * nodes.size() : 0, Mat<double, dim>::zero());
      tie_->add(cells[i] - first_tie_, velocities_alpha(nodes), R_c, K);
      for (std::size_t a = 0; a < nodes.size(); ++a) R[nodes[a]] += R_c[a];
      if (tangent) matrix(static_cast<int>(i), K.data());
    }
  }
  /// Velocities of points where the equations hold.
  [[nodiscard]] std::vector<Point> velocities_alpha(std::span<const int> nodes) const {
    std::vector<Point> v;
    for (int p : nodes) {
      v.push_back(p < n_nodes() ? Point{} : friction_v_[p - n_nodes()]);
      for (int k = 0; p < n_nodes() && k < dim; ++k) v.back()[k] = v_alpha_[p * dim + k];
    }
    return v;
  }

  /// What couples nodes beside the bodies' own cells.
  void list_cells() {
    cells_.truncate(n_body_cells_);
    if (contact_) cells_.append(contact_->pairs()), cells_.append(contact_->singles());
    first_link_ = cells_.size();
    if (seal_)
      for (const auto& link : seal_->links()) cells_.append(seal_->nodes(link, n_nodes()));
    first_tie_ = cells_.size();
    for (int c = 0; tie_ && c < tie_->n_cells(); ++c) cells_.append(tie_->nodes(c, first_tie_point()));
  }
  [[nodiscard]] int first_tie_point() const { return n_nodes() + (seal_ ? seal_->n_gap_points() : 0); }

  /// Calls visit(body, nodes, area of each) for the faces of all surfaces.
  template <class Visit>
  void for_each_face(Visit&& visit) const {
    for (int b = 0; b < static_cast<int>(bodies_.size()); ++b)
      bodies_[b].for_each_face([&](std::span<const int> of_body, std::span<const double> areas) {
        std::vector<int> nodes(of_body.begin(), of_body.end());
        for (int& a : nodes) a += first_node_[b];
        visit(b, std::span<const int>(nodes), areas);
      });
  }

  /// Points further apart than the range would let each other through.
  void check_surfaces(double range) const {
    for_each_face([&](int body, std::span<const int> nodes, std::span<const double>) {
      for (int a : nodes)
        for (int b : nodes)
          if (const double d = std::sqrt(dot(X_[a] - X_[b], X_[a] - X_[b])); d > range)
            throw Error(ExitCode::configuration,
                        "contact range of " + std::to_string(range) +
                            " length: nodes of a surface face of solid '" + bodies_[body].name() + "' are " +
                            std::to_string(d) +
                            " apart and would let other surfaces through; expected at most the range");
    });
  }

  /// The part of a sorted list of cells that belongs to a body, in the body's numbers, and where it begins.
  [[nodiscard]] std::pair<std::vector<int>, std::size_t> cells_of(int body,
                                                                  std::span<const int> cells) const {
    const int first = first_cell_[body], end = first + bodies_[body].n_cells();
    const auto from = std::lower_bound(cells.begin(), cells.end(), first);
    std::vector<int> list(from, std::lower_bound(from, cells.end(), end));
    for (int& c : list) c -= first;
    return {std::move(list), static_cast<std::size_t>(from - cells.begin())};
  }

  std::vector<Body> bodies_;
  std::vector<int> first_node_, first_cell_;
  SolidCells cells_;
  int n_body_cells_ = 0, first_link_ = 0, first_tie_ = 0;
  std::optional<SurfaceContact<dim>> contact_;
  std::optional<SurfaceSeal<dim>> seal_;
  std::optional<SolidTie<dim>> tie_;
  std::vector<Point> friction_v_;  ///< of the fluid at the points beyond the nodes
  std::vector<Point> X_;
  GeneralizedAlpha levels_, rates_;
  double dt_ = 1.0;
  std::vector<double> u_, v_, a_;                    ///< level n + 1
  std::vector<double> u_old_, v_old_, a_old_;        ///< level n
  std::vector<double> u_alpha_, v_alpha_, a_alpha_;  ///< where the equations hold
};

}  // namespace ifsi
