#pragma once
// A small flow-like saddle system on a grid of Q1 cells of the unit square or cube, spread over the ranks in
// slabs: K = [A G; D L] with A = c M + nu (grad, grad) + (b.grad), D = (q, div v), G = -D^T, L = tau (grad,
// grad). Built from one-dimensional mass, stiffness and first-derivative matrices, so the oracle needs no
// elements.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/linalg/block_csr.hpp"

namespace ifsi::test {

struct StokesOptions {
  int cells = 6;      // per direction
  double rho_c = 10;  // rho / (gamma dt)
  double viscosity = 1;
  double wind = 0;        // convection with the constant velocity wind * (1, .5, .25)
  bool enclosed = false;  // true: velocity prescribed on the whole boundary; else free at x = 1
};

/// Slab distribution of (n+1)^dim grid nodes along the last axis.
template <int dim>
struct Grid {
  Communicator comm;
  int n;            // nodes per direction
  int first, last;  // owned planes [first, last)
  Layout layout;
  std::vector<std::array<int, dim>> node;  // grid position of each local node
  std::vector<std::array<int, 1 << dim>> cells;

  explicit Grid(int n_cells) : n(n_cells + 1) {
    first = n * comm.rank() / comm.size();
    last = n * (comm.rank() + 1) / comm.size();
    for (int k = first; k < last; ++k) add_plane(k);
    std::vector<long> ghosts;
    for (int k : {first - 1, last})
      if (k >= 0 && k < n) {
        for (int i = 0; i < plane(); ++i) ghosts.push_back(static_cast<long>(k) * plane() + i);
        add_plane(k);
      }
    layout = Layout(comm, (last - first) * plane(), ghosts);
    for (int k = std::max(first - 1, 0); k < std::min(last, n - 1); ++k) add_cells(k);
  }
  int plane() const { return dim == 2 ? n : n * n; }
  int local(int k, int in_plane) const {
    if (k >= first && k < last) return (k - first) * plane() + in_plane;
    const int low = first > 0 ? plane() : 0;
    return (last - first) * plane() + (k < first ? 0 : low) + in_plane;
  }
  void add_plane(int k) {
    for (int i = 0; i < plane(); ++i) {
      std::array<int, dim> p;
      p[0] = i % n;
      if constexpr (dim == 3) p[1] = i / n;
      p[dim - 1] = k;
      node.push_back(p);
    }
  }
  void add_cells(int k) {
    for (int i = 0; i < plane(); ++i) {
      if (i % n == n - 1 || (dim == 3 && i / n == n - 1)) continue;
      std::array<int, 1 << dim> cell;
      for (int v = 0; v < 1 << dim; ++v) {
        const int in_plane = i + (v & 1) + (dim == 3 ? n * ((v >> 1) & 1) : 0);
        cell[v] = local(k + ((v >> (dim - 1)) & 1), in_plane);
      }
      cells.push_back(cell);
    }
  }
};

/// One-dimensional linear elements on n nodes of [0, 1]: int N_i^(p) N_j^(q), p and q the derivative orders.
inline double matrix_1d(int n, int i, int j, int p, int q) {
  const double h = 1.0 / (n - 1);
  double sum = 0;
  for (int cell : {i - 1, i}) {
    if (cell < 0 || cell >= n - 1 || j < cell || j > cell + 1) continue;
    const double si = i == cell ? -1 : 1, sj = j == cell ? -1 : 1;
    if (p == 0 && q == 0) sum += i == j ? h / 3 : h / 6;
    if (p == 1 && q == 1) sum += si * sj / h;
    if (p == 0 && q == 1) sum += sj / 2;
    if (p == 1 && q == 0) sum += si / 2;
  }
  return sum;
}

template <int dim>
struct StokesModel {
  static constexpr int B = dim + 1;
  Grid<dim> grid;
  StokesOptions options;
  BlockCsr<B> K;
  BlockCsr<1> laplacian;   // 1/(rho c) grad grad
  BlockCsr<1> mass;        // over the viscosity
  BlockCsr<1> convection;  // over viscosity and rho c

  explicit StokesModel(StokesOptions o)
      : grid(o.cells),
        options(o),
        K(build_pattern(grid.layout, grid.cells)),
        laplacian(K.shared_pattern()),
        mass(laplacian),
        convection(laplacian) {
    for (int i = 0; i < K.n_rows(); ++i)
      for (int k = K.row_ptr()[i]; k < K.row_ptr()[i + 1]; ++k) {
        fill(i, K.cols()[k], K.at(k), *laplacian.at(k), *convection.at(k));
        *mass.at(k) = product(i, K.cols()[k], -1, -1) / options.viscosity;
      }
  }

  /// int d_p N_i d_q N_j; -1: no derivative.
  double product(int i, int j, int p, int q) const {
    double r = 1;
    for (int d = 0; d < dim; ++d) r *= matrix_1d(grid.n, grid.node[i][d], grid.node[j][d], d == p, d == q);
    return r;
  }
  bool is_fixed(int i) const {
    for (int d = 0; d < dim; ++d) {
      if (grid.node[i][d] == 0) return true;
      if (grid.node[i][d] == grid.n - 1 && (d > 0 || options.enclosed)) return true;
    }
    return false;
  }
  void fill(int i, int j, double* block, double& lap, double& conv) const {
    double stiffness = 0, transport = 0;
    for (int d = 0; d < dim; ++d) {
      stiffness += product(i, j, d, d);
      transport += options.wind / (1 << d) * product(i, j, -1, d);
    }
    const double h = 1.0 / options.cells;
    const double tau = 1 / std::sqrt(4 * options.rho_c * options.rho_c + std::pow(2 * options.wind / h, 2) +
                                     std::pow(12 * options.viscosity / (h * h), 2));
    const double a = options.rho_c * product(i, j, -1, -1) + options.viscosity * stiffness + transport;
    for (int c = 0; c < dim; ++c) {
      const bool fixed = is_fixed(i);
      for (int e = 0; e < dim; ++e) block[c * B + e] = c != e ? 0.0 : fixed ? (i == j ? 1.0 : 0.0) : a;
      block[c * B + dim] = fixed ? 0.0 : -product(i, j, c, -1);
      block[dim * B + c] = product(i, j, -1, c);
    }
    block[dim * B + dim] = tau * stiffness;
    lap = stiffness / options.rho_c;
    conv = transport / (options.viscosity * options.rho_c);
  }

  /// A right-hand side with a known solution: x (returned), b = K x; prescribed velocities are zero, and so
  /// is the mean pressure.
  std::vector<double> exact() const {
    std::vector<double> x(static_cast<std::size_t>(grid.layout.n_local()) * B);
    double mean = 0;
    for (int i = 0; i < grid.layout.n_owned(); ++i)
      for (int c = 0; c < B; ++c) {
        const double value = std::sin(1.0 + 1.7 * static_cast<double>(grid.layout.global(i)) + c);
        x[i * B + c] = c < dim && is_fixed(i) ? 0.0 : value;
        if (c == dim) mean += value;
      }
    mean = grid.comm.sum(mean) / static_cast<double>(grid.layout.n_global());
    if (options.enclosed)
      for (int i = 0; i < grid.layout.n_owned(); ++i) x[i * B + dim] -= mean;
    return x;
  }
};

/// A preconditioner of the velocity block names the node whose row is zero.
template <class Preconditioner>
void tells_where_a_block_is_singular() {
  StokesModel<2> model({.cells = 6});
  for (int k = model.K.row_ptr()[5]; k < model.K.row_ptr()[6]; ++k) std::fill_n(model.K.at(k), 9, 0.0);
  Preconditioner preconditioner;
  try {
    preconditioner.update(model.K);
    FAIL() << "expected an Error";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("node 5"), std::string::npos) << e.what();
  }
}

}  // namespace ifsi::test
