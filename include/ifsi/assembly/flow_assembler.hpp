#pragma once
/// \file
/// Assembly of the flow: gather nodal data of W cells, run the kernel, scatter to the rows of owned nodes.

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "ifsi/assembly/scatter.hpp"
#include "ifsi/core/pack.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/fluid/flow_cell.hpp"
#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/schur_parts.hpp"
#include "ifsi/mesh/mesh.hpp"
#include "ifsi/quadrature/quadrature.hpp"

namespace ifsi {

/// Nodal fields an assembly reads; all local (owned and ghost) nodes, ghosts up to date.
/// Interleaved fields hold dim + 1 numbers per node: velocity, then pressure.
struct FlowFields {
  std::span<const double> u;      ///< (v, p) at alpha_f
  std::span<const double> u_dot;  ///< (dv/dt, unused) at alpha_m
  std::span<const double> f;      ///< body force per unit mass, dim numbers per node; empty: the constant one
  std::span<const double> s;      ///< stabilisation scale per node; empty: 1
  std::span<const double> k_p;    ///< PSPG scale per local cell; empty: 1
  std::array<double, 3> gravity{};  ///< constant body force per unit mass, used when f is empty
};

/// Loops over the cells of a mesh with the flow kernel of a model. Every cell that touches an owned node is
/// local, so the rows of owned nodes are complete without communication.
template <class Element, class Model = FluidModel<>, class Rule = DefaultQuadrature<Element>,
          int lanes = default_lanes>
class FlowAssembler {
 public:
  static constexpr int dim = Element::dim, n = Element::n_nodes, B = dim + 1;
  using Parameters = FluidParameters<typename Model::Rheology>;

  explicit FlowAssembler(const Mesh<Element>& mesh);

  /// A zero matrix with the sparsity of the mesh: rows of owned nodes, columns of their neighbours.
  [[nodiscard]] BlockCsr<B> make_matrix() const { return BlockCsr<B>(pattern_); }

  /// Residual (eq. 3) of the owned nodes, n_owned x B numbers; what else R holds is left alone.
  void residual(const FlowFields& fields, const Parameters& fluid, std::span<double> R) const;

  /// Residual and tangent (eq. 7). K must come from make_matrix.
  void residual_and_tangent(const FlowFields& fields, const Parameters& fluid, std::span<double> R,
                            BlockCsr<B>& K) const;

  /// The parts of the pressure Schur complement that the matrix alone does not hold (eq. 14).
  [[nodiscard]] SchurParts schur_parts(const FlowFields& fields, const Parameters& fluid) const;

 private:
  using T = Pack<lanes>;
  using Kernel = FlowCell<Element, Rule, Model, T>;
  /// W cells worked on together; the last batch repeats its last cell and drops the repetitions.
  struct Batch {
    std::array<int, lanes> cell;
    int n_cells;
  };

  template <class Visit>
  void for_each_batch(const FlowFields& fields, const Parameters& fluid, Visit&& visit) const {
    const int n_cells = static_cast<int>(mesh_.cells.size());
    for (int first = 0; first < n_cells; first += lanes) {
      Batch batch;
      batch.n_cells = std::min(lanes, n_cells - first);
      for (int l = 0; l < lanes; ++l) batch.cell[l] = first + std::min(l, batch.n_cells - 1);
      visit(Kernel(gather(batch, fields), fluid), batch);
    }
  }

  [[nodiscard]] FlowCellData<Element, T> gather(const Batch& batch, const FlowFields& fields) const {
    FlowCellData<Element, T> data;
    for (int l = 0; l < lanes; ++l) {
      const int c = batch.cell[l];
      for (int a = 0; a < n; ++a) {
        const int node = mesh_.cells[c][a];
        const auto& X = mesh_.points[mesh_.cell_points[c][a]];
        for (int i = 0; i < dim; ++i) {
          data.X[a][i].set(l, X[i]);
          data.v[a][i].set(l, fields.u[node * B + i]);
          data.v_dot[a][i].set(l, fields.u_dot[node * B + i]);
          data.f[a][i].set(l, fields.f.empty() ? fields.gravity[i] : fields.f[node * dim + i]);
        }
        data.p[a].set(l, fields.u[node * B + dim]);
        data.s[a].set(l, fields.s.empty() ? 1.0 : fields.s[node]);
      }
      data.k_p.set(l, fields.k_p.empty() ? 1.0 : fields.k_p[c]);
    }
    return data;
  }

  void scatter_residual(const Batch& batch, int a, const Vec<T, B>& R_a, std::span<double> R) const {
    std::array<double*, lanes> to{};
    for (int l = 0; l < batch.n_cells; ++l) {
      const int node = mesh_.cells[batch.cell[l]][a];
      if (node < mesh_.nodes.n_owned()) to[l] = &R[node * B];
    }
    add_lanes<B>(R_a.data, to.data());
  }

  void scatter_block(const Batch& batch, int a, int b, const Mat<T, B>& K_ab, BlockCsr<B>& K) const {
    std::array<double*, lanes> to{};
    for (int l = 0; l < batch.n_cells; ++l) {
      const int block = blocks_[batch.cell[l]][a * n + b];
      if (block >= 0) to[l] = K.at(block);
    }
    add_lanes<B * B>(K_ab.data, to.data());
  }

  void add_at_node(const Batch& batch, int a, T value, std::vector<double>& to) const {
    for (int l = 0; l < batch.n_cells; ++l) {
      const int node = mesh_.cells[batch.cell[l]][a];
      if (node < mesh_.nodes.n_owned()) to[node] += value[l];
    }
  }

  void add_at_pair(const Batch& batch, int a, int b, T value, BlockCsr<1>& to) const {
    for (int l = 0; l < batch.n_cells; ++l) {
      const int block = blocks_[batch.cell[l]][a * n + b];
      if (block >= 0) *to.at(block) += value[l];
    }
  }

  const Mesh<Element>& mesh_;
  std::shared_ptr<const Pattern> pattern_;
  std::vector<std::array<int, n * n>> blocks_;  ///< per cell and node pair: block of K, or -1 when not owned
};

template <class Element, class Model, class Rule, int lanes>
FlowAssembler<Element, Model, Rule, lanes>::FlowAssembler(const Mesh<Element>& mesh)
    : mesh_(mesh),
      pattern_(build_pattern(mesh.nodes, mesh.cells)),
      blocks_(cell_block_map(*pattern_, mesh.cells)) {}

template <class Element, class Model, class Rule, int lanes>
void FlowAssembler<Element, Model, Rule, lanes>::residual(const FlowFields& fields, const Parameters& fluid,
                                                          std::span<double> R) const {
  std::fill_n(R.begin(), mesh_.nodes.n_owned() * B, 0.0);
  for_each_batch(fields, fluid, [&](const Kernel& kernel, const Batch& batch) {
    kernel.residual([&](int a, const Vec<T, B>& R_a) { scatter_residual(batch, a, R_a, R); });
  });
}

template <class Element, class Model, class Rule, int lanes>
void FlowAssembler<Element, Model, Rule, lanes>::residual_and_tangent(const FlowFields& fields,
                                                                      const Parameters& fluid,
                                                                      std::span<double> R,
                                                                      BlockCsr<B>& K) const {
  std::fill_n(R.begin(), mesh_.nodes.n_owned() * B, 0.0);
  K.set_zero();
  for_each_batch(fields, fluid, [&](const Kernel& kernel, const Batch& batch) {
    kernel.residual_and_tangent(
        [&](int a, const Vec<T, B>& R_a) { scatter_residual(batch, a, R_a, R); },
        [&](int a, int b, const Mat<T, B>& K_ab) { scatter_block(batch, a, b, K_ab, K); });
  });
}

template <class Element, class Model, class Rule, int lanes>
SchurParts FlowAssembler<Element, Model, Rule, lanes>::schur_parts(const FlowFields& fields,
                                                                   const Parameters& fluid) const {
  SchurParts parts{std::vector<double>(mesh_.nodes.n_owned(), 0.0), BlockCsr<1>(pattern_), 0.0,
                   BlockCsr<1>(pattern_), fluid.c_inertia == 0.0};
  const double inverse_rho_c = fluid.c_inertia > 0.0 ? 1.0 / (fluid.rho * fluid.c_inertia) : 1.0 / fluid.rho;
  for_each_batch(fields, fluid, [&](const Kernel& kernel, const Batch& batch) {
    for (int q = 0; q < Rule::n; ++q) {
      const auto& point = kernel.point(q);
      const T mass = point.JxW() / (2.0 * point.mu() + point.rho_tau_C());
      const T trace_G = fluid.rho / (point.rho_tau_C() * point.tau_M());
      for (int a = 0; a < n; ++a) {
        add_at_node(batch, a, BasisTable<Element, Rule>::N[q][a] * mass, parts.mass);
        for (int b = 0; b < n; ++b)
          add_at_pair(batch, a, b,
                      inverse_rho_c * point.JxW() * dot(kernel.trial(a, q).grad, kernel.trial(b, q).grad),
                      parts.laplacian);
        for (int b = 0; b < n; ++b)
          add_at_pair(
              batch, a, b,
              BasisTable<Element, Rule>::N[q][a] * mass *
                  (kernel.trial(b, q).D - fluid.rho * fluid.c_inertia * BasisTable<Element, Rule>::N[q][b]) *
                  inverse_rho_c,
              parts.convection);
      }
      for (int l = 0; l < batch.n_cells; ++l)
        parts.viscous_number =
            std::max(parts.viscous_number, point.mu()[l] * trace_G[l] * inverse_rho_c / (4.0 * dim));
    }
  });
  parts.viscous_number = mesh_.comm.max(parts.viscous_number);
  if (fluid.c_inertia == 0.0) parts.viscous_number = std::numeric_limits<double>::infinity();
  return parts;
}

// The scenes every driver may name are compiled once, in src/instantiate.
extern template class FlowAssembler<Tri1>;
extern template class FlowAssembler<Tri2>;
extern template class FlowAssembler<Quad1>;
extern template class FlowAssembler<Quad2>;
extern template class FlowAssembler<Tet1>;
extern template class FlowAssembler<Tet2>;
extern template class FlowAssembler<Hex1>;
extern template class FlowAssembler<Hex2>;
extern template class FlowAssembler<Wedge1>;

}  // namespace ifsi
