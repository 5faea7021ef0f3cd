#pragma once
/// \file
/// C^lambda: the fluid's velocity at the solid's nodes, and the solid's nodal forces on the fluid.
///
///     v_A = sum_B N_B(x_A) v_B   (C^T)        f_B = sum_A N_B(x_A) f_A   (C)
///
/// Method: Black et al. (arXiv 2601.08266), appendix A.

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/coupling/point_locator.hpp"
#include "ifsi/element/geometry.hpp"
#include "ifsi/element/instantiate.hpp"
#include "ifsi/mesh/mesh.hpp"

namespace ifsi {

/// What C knows of one solid node: one row of C^T. All ranks hold the same rows, to the last bit.
template <class Element>
struct CouplingRow {
  static constexpr int n_nodes = Element::n_nodes, dim = Element::dim;

  int point = -1;                                  ///< solid node
  int holder = -1;                                 ///< the rank that evaluates C^T v for it
  long cell = -1;                                  ///< input number of the fluid cell that holds it; -1: lost
  std::array<long, n_nodes> node{};                ///< global fluid nodes B of that cell
  std::array<double, n_nodes> N{};                 ///< N_B(x_A)
  std::array<Vec<double, dim>, n_nodes> grad_N{};  ///< grad N_B(x_A), per length

  [[nodiscard]] bool found() const { return cell >= 0; }
};

/// C^lambda for the nodes of all solids of a scene. The nodes are replicated: every rank passes the same
/// positions and forces, and gets the same velocities. A node outside the mesh is *lost*: its row is empty,
/// it takes no velocity (it is held at its place) and spreads no force.
template <class Element>
class Interpolation {
 public:
  static constexpr int dim = Element::dim, n_nodes = Element::n_nodes;
  using Point = Vec<double, dim>;
  using Row = CouplingRow<Element>;

  /// What a call of locate() found.
  struct Report {
    int n_moved = 0;         ///< nodes whose position differs from the call before
    int n_changed_cell = 0;  ///< nodes in another cell than before, newly found and newly lost ones included
    int n_lost = 0;          ///< nodes outside the mesh now
  };

  /// A node outside the mesh.
  struct LostPoint {
    int point;
    Point position;
    double distance;  ///< to the nearest cell
  };

  /// The mesh must outlive this object.
  explicit Interpolation(const Mesh<Element>& mesh) : mesh_(mesh), locator_(mesh) {}

  /// Evaluates C at the positions x of the solid nodes (the same on all ranks). Collective. A node that has
  /// not moved costs a comparison; one that has moved within its cell or into the next, one inverse map and
  /// its row's message. Throws Error(invalid_state) for a position that is not finite.
  Report locate(std::span<const Point> x) {
    Report report;
    const std::vector<int> moved = note_positions(x);
    report.n_moved = static_cast<int>(moved.size());
    std::vector<char> settled(rows_.size(), 0);
    for (const Row& row : mesh_.comm.all_gather(tracked_rows(moved))) {
      settled[row.point] = 1;
      report.n_changed_cell += replace(row);
    }
    std::vector<int> open;
    for (int p : moved)
      if (!settled[p]) open.push_back(p);
    if (!open.empty())
      for (const Row& row : searched_rows(open)) report.n_changed_cell += replace(row);
    if (report.n_moved > 0) list_points();
    if (report.n_changed_cell > 0) ++revision_;
    report.n_lost = static_cast<int>(lost_.size());
    return report;
  }

  [[nodiscard]] int n_points() const { return static_cast<int>(rows_.size()); }
  [[nodiscard]] const Row& row(int point) const { return rows_[point]; }
  [[nodiscard]] const std::vector<Point>& positions() const { return x_; }
  /// Changes whenever a node changed its cell, and with it the places of the nonzeros of C.
  [[nodiscard]] long revision() const { return revision_; }
  /// Nodes outside the mesh.
  [[nodiscard]] const std::vector<int>& lost() const { return lost_; }
  /// Nodes whose row has an entry on a fluid node owned by this rank.
  [[nodiscard]] const std::vector<int>& owned_points() const { return owned_; }
  [[nodiscard]] const Mesh<Element>& mesh() const { return mesh_; }

  /// The nodes outside the mesh with their distance to it, for a report. Collective.
  [[nodiscard]] std::vector<LostPoint> lost_points() const {
    std::vector<LostPoint> points;
    for (int p : lost_) points.push_back({p, x_[p], mesh_.comm.min(locator_.distance(x_[p]))});
    return points;
  }

  /// Throws Error(configuration) when some node lies outside the mesh. Collective. \param what the nodes are
  void require_all_found(const std::string& what) const {
    if (lost_.empty()) return;
    const LostPoint lost = lost_points()[0];
    std::string at;
    for (double x : lost.position.data) at.append(" ").append(std::to_string(x));
    throw Error(ExitCode::configuration, std::to_string(lost_.size()) + " " + what +
                                             " lie outside of the fluid mesh, number " +
                                             std::to_string(lost.point) + " at" + at + " by " +
                                             std::to_string(lost.distance) + "; expected all inside");
  }

  /// C^T v. \param v local nodal values, ghosts up to date, `stride` numbers per node, the velocity first.
  /// \return velocities of all solid nodes, on every rank; zero for lost ones. Collective.
  [[nodiscard]] std::vector<Point> velocities(const double* v, int stride) const {
    std::vector<Point> v_s(rows_.size(), Point::zero());
    for (int p : held_)
      for (int b = 0; b < n_nodes; ++b)
        for (int i = 0; i < dim; ++i) v_s[p][i] += rows_[p].N[b] * v[index(p, b) * stride + i];
    sum_over_ranks(v_s);
    return v_s;
  }

  /// (grad v)(x_A), entry (i, j) = dv_i/dx_j. Parameters and result as for velocities(). Collective.
  [[nodiscard]] std::vector<Mat<double, dim>> velocity_gradients(const double* v, int stride) const {
    std::vector<Mat<double, dim>> grad_v(rows_.size(), Mat<double, dim>::zero());
    for (int p : held_)
      for (int b = 0; b < n_nodes; ++b)
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            grad_v[p](i, j) += v[index(p, b) * stride + i] * rows_[p].grad_N[b][j];
    sum_over_ranks(grad_v);
    return grad_v;
  }

  /// Adds C f to the rows of the owned fluid nodes. \param f forces on the solid nodes; only those of
  /// owned_points() are read. \param r owned nodal values, `stride` numbers per node, the momentum first.
  void spread(std::span<const Point> f, double* r, int stride) const {
    for (int p : owned_)
      for (int b = 0; b < n_nodes; ++b)
        if (is_owned(local_nodes_[p][b]))
          for (int i = 0; i < dim; ++i) r[index(p, b) * stride + i] += rows_[p].N[b] * f[p][i];
  }

 private:
  [[nodiscard]] long index(int point, int b) const { return local_nodes_[point][b]; }
  [[nodiscard]] bool is_owned(int node) const { return node >= 0 && node < mesh_.nodes.n_owned(); }

  /// Takes over the positions; returns the nodes that are not where they were.
  std::vector<int> note_positions(std::span<const Point> x) {
    require_finite(x);
    const bool restart = x.size() != x_.size();
    if (restart) {
      x_.assign(x.begin(), x.end());
      rows_.assign(x.size(), Row{});
      local_nodes_.assign(x.size(), no_nodes());
      local_cell_.assign(x.size(), -1);
      list_points();
      ++revision_;
    }
    std::vector<int> moved;
    for (size_t p = 0; p < x.size(); ++p) {
      if (!restart && x[p] == x_[p]) continue;
      x_[p] = x[p];
      moved.push_back(static_cast<int>(p));
    }
    return moved;
  }

  static void require_finite(std::span<const Point> x) {
    for (size_t p = 0; p < x.size(); ++p)
      for (int i = 0; i < dim; ++i)
        if (!std::isfinite(x[p][i]))
          throw Error(ExitCode::invalid_state, "solid node " + std::to_string(p) + ": coordinate " +
                                                   std::to_string(i) + " is " + std::to_string(x[p][i]) +
                                                   "; expected a finite number");
  }

  /// New rows of the nodes this rank holds and finds in the interior of a cell near the old one.
  std::vector<Row> tracked_rows(const std::vector<int>& points) {
    std::vector<Row> rows;
    for (int p : points)
      if (rows_[p].holder == mesh_.comm.rank()) {
        const auto location = locator_.track(x_[p], local_cell_[p]);
        if (location.found()) rows.push_back(evaluate(p, location));
      }
    return rows;
  }

  /// New rows found by all ranks, one for each of the points. Each rank offers the lowest of its owned cells
  /// that holds the point, and the lowest of all is taken.
  std::vector<Row> searched_rows(const std::vector<int>& points) {
    std::vector<Row> offers;
    for (int p : points) {
      const auto location = locator_.find(x_[p], local_cell_[p]);
      if (location.found()) offers.push_back(evaluate(p, location));
    }
    std::vector<Row> best(rows_.size());
    for (const Row& offer : mesh_.comm.all_gather(offers))
      if (!best[offer.point].found() || offer.cell < best[offer.point].cell) best[offer.point] = offer;
    std::vector<Row> rows;
    for (int p : points) rows.push_back(best[p].found() ? best[p] : lost_row(p));
    return rows;
  }

  static Row lost_row(int point) {
    Row row;
    row.point = point;
    return row;
  }

  Row evaluate(int point, const typename PointLocator<Element>::Location& at) {
    local_cell_[point] = at.cell;
    Row row;
    row.point = point;
    row.holder = mesh_.comm.rank();
    row.cell = mesh_.input_cell[at.cell];
    for (int b = 0; b < n_nodes; ++b) row.node[b] = mesh_.nodes.global(mesh_.cells[at.cell][b]);
    std::array<Point, n_nodes> dN;
    Element::shape_functions(at.xi, row.N);
    Element::gradients(at.xi, dN);
    row.grad_N = physical_gradients(dN, inverse(jacobian(dN, mesh_.cell_coordinates(at.cell))));
    return row;
  }

  /// Takes a new row; says whether it lies in another cell than the old one.
  bool replace(const Row& row) {
    Row& old = rows_[row.point];
    const bool changed = row.cell != old.cell;
    if (changed || row.holder != old.holder) local_nodes_[row.point] = local_nodes(row);
    old = row;
    return changed;
  }

  static std::array<int, n_nodes> no_nodes() {
    std::array<int, n_nodes> none;
    none.fill(-1);
    return none;
  }

  /// Local numbers of a row's nodes: all of them on its holder, the owned ones elsewhere.
  [[nodiscard]] std::array<int, n_nodes> local_nodes(const Row& row) const {
    if (row.holder == mesh_.comm.rank()) return mesh_.cells[local_cell_[row.point]];
    std::array<int, n_nodes> local = no_nodes();
    if (!row.found()) return local;
    for (int b = 0; b < n_nodes; ++b) {
      const long owned = row.node[b] - mesh_.nodes.first_global();
      if (owned >= 0 && owned < mesh_.nodes.n_owned()) local[b] = static_cast<int>(owned);
    }
    return local;
  }

  void list_points() {
    held_.clear(), owned_.clear(), lost_.clear();
    for (int p = 0; p < n_points(); ++p) {
      if (!rows_[p].found()) lost_.push_back(p);
      if (rows_[p].holder == mesh_.comm.rank()) held_.push_back(p);
      if (std::any_of(local_nodes_[p].begin(), local_nodes_[p].end(), [&](int b) { return is_owned(b); }))
        owned_.push_back(p);
    }
  }

  /// One rank has the value and the others have zero: the sum is that value on all ranks, in any order.
  template <class Value>
  void sum_over_ranks(std::vector<Value>& values) const {
    mesh_.comm.sum_in_place(values.empty() ? nullptr : values[0].data,
                            static_cast<int>(values.size() * sizeof(Value) / sizeof(double)));
  }

  const Mesh<Element>& mesh_;
  PointLocator<Element> locator_;
  std::vector<Point> x_;
  std::vector<Row> rows_;
  std::vector<std::array<int, n_nodes>> local_nodes_;  ///< of each row; -1 where unknown to this rank
  std::vector<int> local_cell_;                        ///< where this rank found the node last; -1: nowhere
  std::vector<int> held_, owned_, lost_;
  long revision_ = 0;
};

// Compiled once for each element, in src/instantiate.
#define IFSI_INTERPOLATION(Element, external) external template class Interpolation<Element>;
IFSI_FOR_EACH_PLANE_CELL(IFSI_INTERPOLATION, extern)
IFSI_FOR_EACH_SPACE_CELL(IFSI_INTERPOLATION, extern)

}  // namespace ifsi
