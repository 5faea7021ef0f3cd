#pragma once
/// \file
/// The sparsity pattern of node matrices: built once from the cells, shared by all matrices on a mesh.

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "ifsi/linalg/layout.hpp"

namespace ifsi {

/// Compressed rows. Row i (an owned node) has the columns cols[row_ptr[i]] .. cols[row_ptr[i+1]-1]: local
/// nodes, owned or ghost, ascending, its own diagonal among them.
struct Pattern {
  Layout layout;
  std::vector<int> row_ptr;
  std::vector<int> cols;

  [[nodiscard]] int n_rows() const { return static_cast<int>(row_ptr.size()) - 1; }
  [[nodiscard]] int n_blocks() const { return static_cast<int>(cols.size()); }
  /// Position of (row, col) in cols, or -1 when the pattern lacks it.
  [[nodiscard]] int find(int row, int col) const {
    const auto begin = cols.begin() + row_ptr[row], end = cols.begin() + row_ptr[row + 1];
    const auto it = std::lower_bound(begin, end, col);
    return it != end && *it == col ? static_cast<int>(it - cols.begin()) : -1;
  }
};

/// The pattern that couples all nodes of a cell. \param cells local node numbers of every local cell; each
/// cell that touches an owned node must be there.
template <class Cells>
[[nodiscard]] std::shared_ptr<const Pattern> build_pattern(const Layout& layout, const Cells& cells) {
  const int n_owned = layout.n_owned();
  std::vector<int> start(n_owned + 1, 0), incident;
  for (const auto& cell : cells)
    for (int node : cell)
      if (node < n_owned) ++start[node + 1];
  for (int i = 0; i < n_owned; ++i) start[i + 1] += start[i];
  incident.resize(start[n_owned]);
  std::vector<int> next(start.begin(), start.end() - 1);
  for (int c = 0; c < static_cast<int>(cells.size()); ++c)
    for (int node : cells[c])
      if (node < n_owned) incident[next[node]++] = c;

  auto pattern = std::make_shared<Pattern>(Pattern{layout, {0}, {}});
  std::vector<int> seen_in_row(layout.n_local(), -1), row;
  for (int i = 0; i < n_owned; ++i) {
    row.assign(1, i);
    seen_in_row[i] = i;
    for (int k = start[i]; k < start[i + 1]; ++k)
      for (int node : cells[incident[k]])
        if (std::exchange(seen_in_row[node], i) != i) row.push_back(node);
    std::sort(row.begin(), row.end());
    pattern->cols.insert(pattern->cols.end(), row.begin(), row.end());
    pattern->row_ptr.push_back(pattern->n_blocks());
  }
  return pattern;
}

/// Where the node pairs of each cell live in the pattern: map[c][a * n + b] is the block of (node a, node b)
/// of cell c, or -1 when this rank does not own row a.
template <std::size_t n>
[[nodiscard]] std::vector<std::array<int, n * n>> cell_block_map(
    const Pattern& pattern, const std::vector<std::array<int, n>>& cells) {
  std::vector<std::array<int, n * n>> map(cells.size());
  const int n_owned = pattern.layout.n_owned();
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        map[c][a * n + b] = cells[c][a] < n_owned ? pattern.find(cells[c][a], cells[c][b]) : -1;
  return map;
}

}  // namespace ifsi
