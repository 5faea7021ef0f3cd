#pragma once
/// \file
/// The solid's tangent seen by the fluid: C K_s C^T, and what the exact linearisation of C adds to it.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ifsi/coupling/interpolation.hpp"
#include "ifsi/coupling/solid_cells.hpp"
#include "ifsi/linalg/block_csr.hpp"
#include "ifsi/linalg/layout.hpp"

namespace ifsi {

/// Block matrix of the fluid's size: rows are the owned fluid nodes, blocks (dim+1) x (dim+1) of which the
/// velocity part is filled. Its columns reach as far as solid cells do, beyond the ghost nodes of the mesh:
/// they are numbered by a layout of its own, owned nodes first as in the mesh, then this matrix's ghosts by
/// global number.
///
/// Each rank needs, and sums, the element matrices of relevant_cells() alone. Sums run over the solid cells
/// in ascending order, whatever the partition. Use: update(); set_zero(); add(i, K) for each relevant cell i.
template <class Element>
class CouplingMatrix {
 public:
  static constexpr int dim = Element::dim, B = dim + 1;
  using Block = Mat<double, dim>;

  /// The interpolation must outlive this object. Collective, as update().
  CouplingMatrix(const Interpolation<Element>& C, SolidCells cells) : C_(C), cells_(std::move(cells)) {}

  /// Makes the pattern anew if some solid node has changed its cell since it was made, and says whether it
  /// did. Values are lost then. Collective.
  bool update() {
    if (revision_ == C_.revision()) return false;
    revision_ = C_.revision();
    collect_supports();
    make_pattern(number_columns());
    return true;
  }

  /// Other cells from now on: the next update() makes the pattern anew.
  void set_cells(SolidCells cells) { cells_ = std::move(cells), revision_ = -1; }

  /// The solid cells that reach an owned fluid node, ascending: those whose matrices this rank has to add.
  [[nodiscard]] const std::vector<int>& relevant_cells() const { return relevant_; }
  [[nodiscard]] const SolidCells& cells() const { return cells_; }
  /// The matrix, with columns numbered by its own layout(). Rows that no solid cell reaches are empty.
  [[nodiscard]] const BlockCsr<B>& matrix() const { return matrix_; }
  /// The rows that are not empty, ascending.
  [[nodiscard]] const std::vector<int>& rows() const { return rows_; }

  void set_zero() { matrix_.set_zero(); }

  /// Adds C K C^T of one cell. \param i place of the cell in relevant_cells(). \param K n x n blocks, row by
  /// row, of the cell's n nodes.
  void add(int i, const Block* K) {
    const std::span<const int> points = cells_[relevant_[i]];
    const int n = static_cast<int>(points.size());
    multiply_by_columns(cell_data_[i], points, [&](int a, int b) -> const Block& { return K[a * n + b]; });
    add_rows(cell_data_[i], points);
  }

  /// Adds C K P C^T of one cell. \param P one matrix per solid node (not: per node of the cell), applied to
  /// its velocity: du_A = P_A (C^T dv)_A of the exact linearisation.
  void add(int i, const Block* K, std::span<const Block> P) {
    const std::span<const int> points = cells_[relevant_[i]];
    const int n = static_cast<int>(points.size());
    multiply_by_columns(cell_data_[i], points, [&](int a, int b) { return K[a * n + b] * P[points[b]]; });
    add_rows(cell_data_[i], points);
  }

  /// Adds the change of the spreading itself, sum_A R_A (x) (P_A^T grad N_B(x_A)) N_B'(x_A): with du_A = P_A
  /// (C^T dv)_A the change of (C R)_B that the motion of the nodes makes. Nodes of no cell are taken to carry
  /// no force. \param R nodal forces, \param P as above; of both only the entries of
  /// Interpolation::owned_points() are read.
  void add_spreading(std::span<const Vec<double, dim>> R, std::span<const Block> P) {
    for (const Place& at : places_) {
      const auto& row = C_.row(at.point);
      const Cell& cell = cell_data_[at.cell];
      const std::uint16_t* slot = &slots_[cell.slots + at.node * n_fluid];
      for (int b = 0; b < n_fluid; ++b) {
        if (slot[b] >= cell.n_rows) continue;
        const Block left = outer(R[at.point], row.grad_N[b]) * P[at.point];
        const int* block = &blocks_[cell.blocks + static_cast<long>(slot[b]) * cell.n_support];
        for (int c = 0; c < n_fluid; ++c) add_block(block[slot[c]], row.N[c] * left);
      }
    }
  }

  /// y += C K_s C^T x. \param x, y owned nodal values, dim + 1 per node. Collective.
  void add_product(const double* x, double* y) const {
    AlignedVector<double> with_ghosts;
    const Layout& layout = matrix_.layout();
    if (layout.communicator().size() > 1) {
      with_ghosts.resize(static_cast<size_t>(layout.n_local()) * B);
      std::copy_n(x, static_cast<size_t>(layout.n_owned()) * B, with_ghosts.begin());
      layout.update_ghosts(with_ghosts.data(), B);
      x = with_ghosts.data();
    }
    for (int row : rows_)
      for (int k = matrix_.row_ptr()[row]; k < matrix_.row_ptr()[row + 1]; ++k)
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            y[static_cast<long>(row) * B + i] +=
                matrix_.at(k)[i * B + j] * x[static_cast<long>(matrix_.cols()[k]) * B + j];
  }

 private:
  static constexpr int n_fluid = Element::n_nodes;
  /// Sorts nodes of other ranks behind the owned ones.
  static constexpr long behind_owned = 1L << 48;

  /// What a relevant cell couples: its support, the fluid nodes its solid nodes touch, owned ones first.
  struct Cell {
    int n_support;
    int n_rows;    ///< how many of them are owned
    long support;  ///< where its part of support_ begins
    long slots;   ///< of slots_: for each solid node a and node b of its fluid cell, the place in the support
    long blocks;  ///< of blocks_: for each owned row and each column of the support, the block of the matrix
  };
  /// A solid node with an owned fluid node, found in a relevant cell.
  struct Place {
    int point, cell, node;
  };

  /// A fluid node as number that sorts like the columns of the matrix.
  [[nodiscard]] long sort_key(long global) const {
    const long owned = global - C_.mesh().nodes.first_global();
    return owned >= 0 && owned < C_.mesh().nodes.n_owned() ? owned : behind_owned + global;
  }

  void collect_supports() {
    relevant_.clear(), cell_data_.clear(), support_.clear(), slots_.clear(), places_.clear();
    std::vector<char> is_open(C_.n_points(), 0);
    for (int p : C_.owned_points()) is_open[p] = 1;
    const std::vector<char> is_owned = is_open;
    long n_blocks = 0;
    for (int c = 0; c < cells_.size(); ++c) {
      const std::span<const int> points = cells_[c];
      if (std::none_of(points.begin(), points.end(), [&](int p) { return is_owned[p]; })) continue;
      relevant_.push_back(c);
      append_cell(points, n_blocks);
      n_blocks += static_cast<long>(cell_data_.back().n_rows) * cell_data_.back().n_support;
      for (int a = 0; a < static_cast<int>(points.size()); ++a)
        if (std::exchange(is_open[points[a]], 0))
          places_.push_back({points[a], static_cast<int>(relevant_.size()) - 1, a});
    }
    blocks_.resize(n_blocks);
  }

  void append_cell(std::span<const int> points, long first_block) {
    std::vector<long> keys;
    for (int p : points)
      if (C_.row(p).found())
        for (long global : C_.row(p).node) keys.push_back(sort_key(global));
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    const auto place = [&](long key) {
      return std::lower_bound(keys.begin(), keys.end(), key) - keys.begin();
    };
    cell_data_.push_back({static_cast<int>(keys.size()), static_cast<int>(place(behind_owned)),
                          static_cast<long>(support_.size()), static_cast<long>(slots_.size()), first_block});
    for (int p : points)
      for (long global : C_.row(p).node)
        slots_.push_back(static_cast<std::uint16_t>(C_.row(p).found() ? place(sort_key(global)) : 0));
    support_.insert(support_.end(), keys.begin(), keys.end());
  }

  /// Turns the sort keys of the supports into columns; returns the layout of the columns.
  Layout number_columns() {
    const Layout& nodes = C_.mesh().nodes;
    std::vector<long> ghosts;
    for (long key : support_)
      if (key >= behind_owned) ghosts.push_back(key - behind_owned);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    for (long& key : support_)
      if (key >= behind_owned)
        key = nodes.n_owned() +
              (std::lower_bound(ghosts.begin(), ghosts.end(), key - behind_owned) - ghosts.begin());
    return Layout(nodes.communicator(), nodes.n_owned(), std::move(ghosts));
  }

  /// The columns a cell couples, ascending.
  [[nodiscard]] std::span<const long> columns(const Cell& cell) const {
    return {&support_[cell.support], static_cast<size_t>(cell.n_support)};
  }

  /// For each owned row, the cells that fill it: (cell, place of the row in its support), row after row.
  struct RowCells {
    std::vector<int> begin;
    std::vector<std::array<int, 2>> entries;
  };
  [[nodiscard]] RowCells cells_of_rows(int n_rows) const {
    RowCells of{std::vector<int>(n_rows + 1, 0), {}};
    for (const Cell& cell : cell_data_)
      for (int r = 0; r < cell.n_rows; ++r) ++of.begin[support_[cell.support + r] + 1];
    for (size_t r = 1; r < of.begin.size(); ++r) of.begin[r] += of.begin[r - 1];
    of.entries.resize(of.begin.back());
    std::vector<int> next = of.begin;
    for (int i = 0; i < static_cast<int>(cell_data_.size()); ++i)
      for (int r = 0; r < cell_data_[i].n_rows; ++r)
        of.entries[next[support_[cell_data_[i].support + r]]++] = {i, r};
    return of;
  }

  /// Row by row: the union of the supports of its cells, and from it the places of the cells' blocks.
  void make_pattern(const Layout& layout) {
    const RowCells of = cells_of_rows(layout.n_owned());
    rows_.clear();
    std::vector<int> row_ptr{0}, cols, block_of_column(layout.n_local(), -1);
    for (int row = 0; row < layout.n_owned(); ++row) {
      const std::span entries(of.entries.data() + of.begin[row], of.entries.data() + of.begin[row + 1]);
      const size_t first = cols.size();
      for (auto [i, r] : entries)
        for (long column : columns(cell_data_[i]))
          if (std::exchange(block_of_column[column], 0) < 0) cols.push_back(static_cast<int>(column));
      std::sort(cols.begin() + first, cols.end());
      for (size_t k = first; k < cols.size(); ++k) block_of_column[cols[k]] = static_cast<int>(k);
      for (auto [i, r] : entries) {
        int* block = &blocks_[cell_data_[i].blocks + static_cast<long>(r) * cell_data_[i].n_support];
        for (long column : columns(cell_data_[i])) *block++ = block_of_column[column];
      }
      for (size_t k = first; k < cols.size(); ++k) block_of_column[cols[k]] = -1;
      if (cols.size() > first) rows_.push_back(row);
      row_ptr.push_back(static_cast<int>(cols.size()));
    }
    matrix_ = BlockCsr<B>(layout, std::move(row_ptr), std::move(cols));
  }

  /// T = K C^T, n x n_support blocks.
  template <class BlockOf>
  void multiply_by_columns(const Cell& cell, std::span<const int> points, BlockOf&& K) {
    const int n = static_cast<int>(points.size());
    T_.assign(static_cast<size_t>(n) * cell.n_support, Block::zero());
    for (int b = 0; b < n; ++b) {
      const auto& row = C_.row(points[b]);
      if (!row.found()) continue;
      const std::uint16_t* slot = &slots_[cell.slots + b * n_fluid];
      for (int a = 0; a < n; ++a) {
        const Block K_ab = K(a, b);
        for (int k = 0; k < n_fluid; ++k) T_[a * cell.n_support + slot[k]] += row.N[k] * K_ab;
      }
    }
  }

  /// C T, its owned rows, into the matrix.
  void add_rows(const Cell& cell, std::span<const int> points) {
    Z_.assign(static_cast<size_t>(cell.n_rows) * cell.n_support, Block::zero());
    for (size_t a = 0; a < points.size(); ++a) {
      const auto& row = C_.row(points[a]);
      if (!row.found()) continue;
      const std::uint16_t* slot = &slots_[cell.slots + a * n_fluid];
      const double* T = T_[a * cell.n_support].data;
      for (int k = 0; k < n_fluid; ++k) {
        if (slot[k] >= cell.n_rows) continue;
        double* Z = Z_[slot[k] * cell.n_support].data;
        for (int t = 0; t < cell.n_support * dim * dim; ++t) Z[t] += row.N[k] * T[t];
      }
    }
    for (size_t k = 0; k < Z_.size(); ++k) add_block(blocks_[cell.blocks + k], Z_[k]);
  }

  void add_block(int block, const Block& value) {
    double* entries = matrix_.at(block);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) entries[i * B + j] += value(i, j);
  }

  const Interpolation<Element>& C_;
  SolidCells cells_;
  long revision_ = -1;
  std::vector<int> relevant_;
  std::vector<Cell> cell_data_;  ///< of the relevant cells
  std::vector<long> support_;    ///< columns, one cell after the other
  std::vector<std::uint16_t> slots_;
  std::vector<int> blocks_;
  std::vector<Place> places_;
  BlockCsr<B> matrix_;
  std::vector<int> rows_;
  std::vector<Block> T_, Z_;  ///< products of one cell
};

}  // namespace ifsi
