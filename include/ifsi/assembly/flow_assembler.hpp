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
  std::span<const double> fraction;  ///< weight per local cell: the part that is fluid (eq. 20); empty: 1
  std::array<double, 3> gravity{};   ///< constant body force per unit mass, used when f is empty
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
    for (int a = 0; a < n; ++a)
      for (int l = 0; l < lanes; ++l) gather_node(batch.cell[l], a, l, fields, data);
    gather_scales(batch, fields, data);
    return data;
  }

  void gather_node(int c, int a, int l, const FlowFields& fields, FlowCellData<Element, T>& data) const {
    const int node = mesh_.cells[c][a];
    const auto& X = mesh_.points[mesh_.cell_points[c][a]];
    const double *u = &fields.u[node * B], *u_dot = &fields.u_dot[node * B];
    for (int i = 0; i < dim; ++i) {
      data.X[a][i].set(l, X[i]);
      data.v[a][i].set(l, u[i]);
      data.v_dot[a][i].set(l, u_dot[i]);
    }
    data.p[a].set(l, u[dim]);
  }

  /// Body force, s, k_p and fraction: constant when their fields are empty.
  void gather_scales(const Batch& batch, const FlowFields& fields, FlowCellData<Element, T>& data) const {
    for (int a = 0; a < n; ++a) {
      for (int i = 0; i < dim; ++i) data.f[a][i] = T(fields.gravity[i]);
      data.s[a] = T(1.0);
    }
    data.k_p = T(1.0);
    for (int l = 0; l < lanes; ++l) {
      const int c = batch.cell[l];
      for (int a = 0; a < n && !fields.f.empty(); ++a)
        for (int i = 0; i < dim; ++i) data.f[a][i].set(l, fields.f[mesh_.cells[c][a] * dim + i]);
      for (int a = 0; a < n && !fields.s.empty(); ++a) data.s[a].set(l, fields.s[mesh_.cells[c][a]]);
      if (!fields.k_p.empty()) data.k_p.set(l, fields.k_p[c]);
      if (!fields.fraction.empty()) data.fraction.set(l, fields.fraction[c]);
    }
  }

  /// Where the rows of node a of the batch's cells begin in a field of `block` numbers per node; null for
  /// nodes of other ranks and for repeated cells.
  [[nodiscard]] std::array<double*, lanes> rows_of(const Batch& batch, int a, int block,
                                                   double* field) const {
    std::array<double*, lanes> to{};
    for (int l = 0; l < batch.n_cells; ++l) {
      const int node = mesh_.cells[batch.cell[l]][a];
      if (node < mesh_.nodes.n_owned()) to[l] = field + static_cast<std::size_t>(node) * block;
    }
    return to;
  }

  /// The same for the blocks of the node pair (a, b) in a matrix.
  template <int block>
  [[nodiscard]] std::array<double*, lanes> blocks_of(const Batch& batch, int a, int b,
                                                     BlockCsr<block>& K) const {
    std::array<double*, lanes> to{};
    for (int l = 0; l < batch.n_cells; ++l) {
      const int k = blocks_[batch.cell[l]][a * n + b];
      if (k >= 0) to[l] = K.at(k);
    }
    return to;
  }

  void add_residual(const Kernel& kernel, const Batch& batch, std::span<double> R) const {
    for (int a = 0; a < n; ++a) add_lanes<B>(kernel.residual(a).data, rows_of(batch, a, B, R.data()).data());
  }

  /// One more than the last row that the batch adds to, and at least `rows`.
  [[nodiscard]] int rows_needed(const Batch& batch, int rows) const {
    for (int l = 0; l < batch.n_cells; ++l)
      for (int node : mesh_.cells[batch.cell[l]])
        if (node < mesh_.nodes.n_owned()) rows = std::max(rows, node + 1);
    return rows;
  }

  /// Sets the rows from `begin` up to `end` to zero, and begin = end. Done row by row ahead of the cells,
  /// instead of for the whole matrix at once, it finds and leaves the rows in the cache.
  static void zero_rows(BlockCsr<B>& K, int& begin, int end) {
    const auto first_block = [&](int row) {
      return K.values.begin() + static_cast<std::ptrdiff_t>(K.row_ptr()[row]) * B * B;
    };
    std::fill(first_block(begin), first_block(end), 0.0);
    begin = end;
  }

  /// Asks the memory for the blocks of row a, which the kernel computes next.
  void prefetch_row(const Batch& batch, int a, const BlockCsr<B>& K) const {
    constexpr int line = 8;  // doubles per cache line
    for (int l = 0; l < batch.n_cells; ++l)
      for (int b = 0; b < n; ++b) {
        const double* block = K.at(std::max(0, blocks_[batch.cell[l]][a * n + b]));
        for (int k = 0; k < B * B; k += line) __builtin_prefetch(block + k, 1);
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
  for_each_batch(fields, fluid,
                 [&](const Kernel& kernel, const Batch& batch) { add_residual(kernel, batch, R); });
}

template <class Element, class Model, class Rule, int lanes>
void FlowAssembler<Element, Model, Rule, lanes>::residual_and_tangent(const FlowFields& fields,
                                                                      const Parameters& fluid,
                                                                      std::span<double> R,
                                                                      BlockCsr<B>& K) const {
  std::fill_n(R.begin(), mesh_.nodes.n_owned() * B, 0.0);
  int zeroed = 0;
  for_each_batch(fields, fluid, [&](const Kernel& kernel, const Batch& batch) {
    zero_rows(K, zeroed, rows_needed(batch, zeroed));
    add_residual(kernel, batch, R);
    kernel.tangent([&](int a, int b, const Mat<T, B>& K_ab) {
      if (b == 0) prefetch_row(batch, a, K);
      add_lanes<B * B>(K_ab.data, blocks_of(batch, a, b, K).data());
    });
  });
  zero_rows(K, zeroed, mesh_.nodes.n_owned());
}

template <class Element, class Model, class Rule, int lanes>
SchurParts FlowAssembler<Element, Model, Rule, lanes>::schur_parts(const FlowFields& fields,
                                                                   const Parameters& fluid) const {
  const bool steady = fluid.c_inertia == 0.0;
  const double rho_c = fluid.rho * fluid.c_inertia, inverse_rho_c = 1.0 / (steady ? fluid.rho : rho_c);
  SchurParts parts{.mass = BlockCsr<1>(pattern_),
                   .laplacian = BlockCsr<1>(pattern_),
                   .convection = BlockCsr<1>(pattern_),
                   .viscous_number = 0.0,
                   .bulk_number = 0.0,
                   .order = Element::order,
                   .steady = steady};
  for_each_batch(fields, fluid, [&](const Kernel& kernel, const Batch& batch) {
    for (int q = 0; q < Rule::n; ++q) {
      const auto& point = kernel.point(q);
      const auto& N = BasisTable<Element, Rule>::N[q];
      const T weight = point.JxW() / (2.0 * point.mu() + point.rho_tau_C());
      for (int a = 0; a < n; ++a) {
        const auto grad_a = inverse_rho_c * point.JxW() * kernel.trial(a, q).grad;
        for (int b = 0; b < n; ++b) {
          const auto& trial = kernel.trial(b, q);
          const T mass = N[a] * N[b] * weight;
          const T laplacian = dot(grad_a, trial.grad);
          const T convection = inverse_rho_c * N[a] * weight * (trial.transport - rho_c * N[b]);
          add_lanes<1>(&mass, blocks_of(batch, a, b, parts.mass).data());
          add_lanes<1>(&laplacian, blocks_of(batch, a, b, parts.laplacian).data());
          add_lanes<1>(&convection, blocks_of(batch, a, b, parts.convection).data());
        }
      }
      const T trace_G = fluid.rho / (point.rho_tau_C() * point.tau_M());  // 4 dim / h^2 (eq. 5, 6)
      const T per_h2 = inverse_rho_c / (4.0 * dim) * trace_G;
      for (int l = 0; l < batch.n_cells; ++l) {
        parts.viscous_number = std::max(parts.viscous_number, point.mu()[l] * per_h2[l]);
        parts.bulk_number = std::max(parts.bulk_number, point.rho_tau_C()[l] * per_h2[l]);
      }
    }
  });
  // h is the distance of nodes; for order 2 half of it, since ILU(0) fails there at a quarter of the number.
  constexpr int cells_per_h2 = Element::order == 1 ? 1 : 16;
  parts.viscous_number = cells_per_h2 * mesh_.comm.max(parts.viscous_number);
  parts.bulk_number = mesh_.comm.max(parts.bulk_number);
  if (steady) parts.viscous_number = std::numeric_limits<double>::infinity();
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
