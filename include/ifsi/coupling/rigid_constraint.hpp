#pragma once
/// \file
/// The equations that tie rigid bodies to the fluid: matrix of the multipliers and of the rigid motions.

#include <algorithm>
#include <memory>
#include <vector>

#include "ifsi/core/projector.hpp"
#include "ifsi/coupling/interpolation.hpp"
#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/bordered.hpp"

namespace ifsi {

/// The rows and columns that (eq. 22) adds to the fluid's matrix, in a layout of their own whose owned nodes
/// are those of the border: fluid nodes, then one node per multiplier, then those of the rigid motions, dim
/// degrees of freedom each.
///
///     [ .     a C    .   ]       a: a scale that gives multipliers and constraints the size of momentum
///     [ a C^T .   - a P  ]
///     [ .   - a P^T  K_r ]
///
/// \tparam n degrees of freedom of one rigid body.
template <class Element, int n>
class RigidConstraint {
 public:
  static constexpr int dim = Element::dim, B = dim + 1, nodes_per_body = (n + dim - 1) / dim;
  using Motion = Mat<double, dim, n>;

  /// \param body_of the body of each point of C
  RigidConstraint(const Interpolation<Element>& C, std::vector<int> body_of, int n_bodies)
      : C_(C), body_of_(std::move(body_of)), n_bodies_(n_bodies) {}

  [[nodiscard]] int n_extra() const { return n_points() + n_bodies_ * nodes_per_body; }
  [[nodiscard]] int n_points() const { return static_cast<int>(body_of_.size()); }
  /// Which further node, and which component of it, holds degree of freedom `dof` of a body.
  [[nodiscard]] int node_of(int body, int dof) const {
    return n_points() + body * nodes_per_body + dof / dim;
  }
  static int component_of(int dof) { return dof % dim; }
  [[nodiscard]] int body_of(std::size_t point) const { return body_of_[point]; }

  /// Collective. Makes the pattern for the points' present cells.
  void make_pattern(const Border& border) {
    std::vector<std::vector<long>> rows(border.layout().n_owned());
    for (int p = 0; p < n_points(); ++p) add_point(border, p, rows);
    for (int k = n_points(); k < n_extra() && border.n_here() > 0; ++k) {
      const int body = (k - n_points()) / nodes_per_body;
      for (int m = 0; m < nodes_per_body; ++m)
        rows[border.local(k)].push_back(border.global(n_points() + body * nodes_per_body + m));
    }
    matrix_ = BlockCsr<B>(pattern_of(border.layout(), rows));
  }

  /// Fills in the values. \param P rigid velocity at each point, \param K_r rigid tangent of each body,
  /// \param scale a, \param diagonal what the border's matrix holds in the further rows: it is taken away.
  void fill(const Border& border, const std::vector<Motion>& P, const std::vector<Mat<double, n>>& K_r,
            double scale, double diagonal) {
    matrix_.set_zero();
    for (int p = 0; p < n_points(); ++p) {
      const auto& row = C_.row(p);
      for (int b = 0; row.found() && b < Element::n_nodes; ++b) {
        add_identity(border, row.node[b], border.global(p), scale * row.N[b]);
        add_identity(border, border.global(p), row.node[b], scale * row.N[b]);
      }
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < dim; ++i) {
          const long rigid = border.global(node_of(body_of_[p], j));
          add(border, border.global(p), rigid, i, component_of(j), -scale * P[p](i, j));
          add(border, rigid, border.global(p), component_of(j), i, -scale * P[p](i, j));
        }
    }
    for (int body = 0; body < n_bodies_; ++body)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          add(border, border.global(node_of(body, i)), border.global(node_of(body, j)), component_of(i),
              component_of(j), K_r[body](i, j));
    for (int k = 0; k < n_extra(); ++k)
      for (int i = 0; i < B; ++i) add(border, border.global(k), border.global(k), i, i, -diagonal);
  }

  [[nodiscard]] BlockCsr<B>& matrix() { return matrix_; }
  [[nodiscard]] const BlockCsr<B>& matrix() const { return matrix_; }

  /// Projector onto the velocities that the fluid is free to take at each point: at a symmetry plane those
  /// along it. \param projector of the velocity of a local fluid node. Collective.
  template <class ProjectorOf>
  [[nodiscard]] std::vector<Mat<double, dim>> free_directions(const ProjectorOf& projector) const {
    std::vector<Mat<double, dim>> freedom(n_points(), Mat<double, dim>::zero());
    const Mesh<Element>& mesh = C_.mesh();
    for (int p = 0; p < n_points(); ++p)
      for (int b = 0; C_.row(p).found() && b < Element::n_nodes; ++b) {
        const long local = C_.row(p).node[b] - mesh.nodes.first_global();
        if (local < 0 || local >= mesh.n_owned_nodes()) continue;
        freedom[p] += C_.row(p).N[b] * projector(static_cast<int>(local));
      }
    if (n_points() > 0) mesh.comm.sum_in_place(freedom[0].data, n_points() * dim * dim);
    for (Mat<double, dim>& F : freedom) F = projector_onto_range(F, 1e-3);
    return freedom;
  }

 private:
  void add_point(const Border& border, int p, std::vector<std::vector<long>>& rows) const {
    const auto& row = C_.row(p);
    const long first = border.layout().first_global(), here = border.global(p);
    for (int b = 0; row.found() && b < Element::n_nodes; ++b) {
      const long local = row.node[b] - first;
      if (local >= 0 && local < border.n_mesh_owned()) rows[local].push_back(here);
      if (border.n_here() > 0) rows[border.local(p)].push_back(row.node[b]);
    }
    if (border.n_here() == 0) return;
    rows[border.local(p)].push_back(here);
    for (int m = 0; m < nodes_per_body; ++m) {
      const int rigid = n_points() + body_of_[p] * nodes_per_body + m;
      rows[border.local(p)].push_back(border.global(rigid));
      rows[border.local(rigid)].push_back(here);
    }
  }

  static std::shared_ptr<const Pattern> pattern_of(const Layout& owned,
                                                   std::vector<std::vector<long>>& rows) {
    const long first = owned.first_global(), last = first + owned.n_owned();
    std::vector<long> ghosts;
    for (const auto& row : rows)
      for (long column : row)
        if (column < first || column >= last) ghosts.push_back(column);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    auto pattern =
        std::make_shared<Pattern>(Pattern{Layout(owned.communicator(), owned.n_owned(), ghosts), {0}, {}});
    for (auto& row : rows) {
      std::vector<int> cols;
      for (long column : row)
        cols.push_back(
            static_cast<int>(column >= first && column < last
                                 ? column - first
                                 : owned.n_owned() + (std::lower_bound(ghosts.begin(), ghosts.end(), column) -
                                                      ghosts.begin())));
      std::sort(cols.begin(), cols.end());
      cols.erase(std::unique(cols.begin(), cols.end()), cols.end());
      pattern->cols.insert(pattern->cols.end(), cols.begin(), cols.end());
      pattern->row_ptr.push_back(pattern->n_blocks());
    }
    return pattern;
  }

  void add_identity(const Border& border, long row, long column, double value) {
    for (int i = 0; i < dim; ++i) add(border, row, column, i, i, value);
  }
  /// Adds to the entry (i, j) of a block, where this rank has the row.
  void add(const Border& border, long row, long column, int i, int j, double value) {
    const Layout& layout = matrix_.layout();
    const long local = row - layout.first_global();
    if (local < 0 || local >= border.layout().n_owned()) return;
    long col = column - layout.first_global();
    if (col < 0 || col >= layout.n_owned()) col = ghost(column);
    matrix_.at(matrix_.find(static_cast<int>(local), static_cast<int>(col)))[i * B + j] += value;
  }
  /// Local index of a ghost; ghosts are ascending.
  [[nodiscard]] long ghost(long column) const {
    const Layout& layout = matrix_.layout();
    int low = layout.n_owned(), high = layout.n_local();
    while (low < high) {
      const int middle = (low + high) / 2;
      layout.global(middle) < column ? low = middle + 1 : high = middle;
    }
    return low;
  }

  const Interpolation<Element>& C_;
  std::vector<int> body_of_;
  int n_bodies_;
  BlockCsr<B> matrix_;
};

}  // namespace ifsi
