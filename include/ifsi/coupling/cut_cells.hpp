#pragma once
/// \file
/// Fluid cells that hold solid nodes, and the stabilisation scale s around them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ifsi/coupling/interpolation.hpp"
#include "ifsi/mesh/mesh.hpp"

namespace ifsi {

/// Shape of the nodal field s: s_max on the nodes of the cut cells and on `rings` further layers of nodes,
/// then down to 1 over `transition` layers. Layer k + 1: the nodes that share a cell with layer k.
struct StabilisationScale {
  double s_max = 1.0;
  int rings = 1;
  int transition = 1;

  /// s on layer k (0: the nodes of the cut cells). ln s falls as a cubic with zero slope at both ends, since
  /// tau_M goes like s^(-1/2); with transition = 1 the shape functions alone make the passage from s_max
  /// to 1.
  [[nodiscard]] double at_layer(int k) const {
    if (k <= rings) return s_max;
    const double t = static_cast<double>(k - rings) / transition;
    return t >= 1.0 ? 1.0 : std::pow(s_max, (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t));
  }
};

/// The local fluid cells, ghosts included, that hold a solid node. A node on a face is held by one cell
/// alone, the one of its row in C; the flags of a cell are the same on all ranks that have it.
template <class Element>
class CutCells {
 public:
  explicit CutCells(const Mesh<Element>& mesh) : mesh_(mesh), flags_(mesh.n_cells(), 0) {
    for (int c = 0; c < mesh.n_cells(); ++c) cells_by_input_.emplace_back(mesh.input_cell[c], c);
    std::sort(cells_by_input_.begin(), cells_by_input_.end());
  }

  /// Flags the cells that hold a node of C as it is now.
  void update(const Interpolation<Element>& C) {
    for (int c : cells_) flags_[c] = 0;
    cells_.clear();
    for (int p = 0; p < C.n_points(); ++p) {
      const int cell = local_cell(C.row(p).cell);
      if (cell >= 0 && !std::exchange(flags_[cell], 1)) cells_.push_back(cell);
    }
    std::sort(cells_.begin(), cells_.end());
  }

  [[nodiscard]] bool operator[](int cell) const { return flags_[cell] != 0; }
  /// The flagged local cells, ascending.
  [[nodiscard]] const std::vector<int>& cells() const { return cells_; }

  /// The flagged cells and `rings` layers of cells around them, each those that share a node with the layer
  /// before; ascending, alike on all ranks. Collective.
  [[nodiscard]] std::vector<int> with_rings(int rings) const {
    if (rings == 0) return cells_;
    const std::vector<int> layer = layers(rings - 1);
    std::vector<int> cells;
    for (int c = 0; c < mesh_.n_cells(); ++c)
      if (std::any_of(mesh_.cells[c].begin(), mesh_.cells[c].end(),
                      [&](int node) { return layer[node] < rings; }))
        cells.push_back(c);
    return cells;
  }

  /// The field s at all local nodes. Collective.
  [[nodiscard]] std::vector<double> stabilisation(const StabilisationScale& scale) const {
    const std::vector<int> layer = layers(scale.rings + scale.transition - 1);
    std::vector<double> s(layer.size());
    for (size_t i = 0; i < s.size(); ++i) s[i] = scale.at_layer(layer[i]);
    return s;
  }

  /// Layer of each local node, 0 for the nodes of the flagged cells; those behind `last` have a very large
  /// number. Collective.
  [[nodiscard]] std::vector<int> layers(int last) const {
    constexpr int far = std::numeric_limits<int>::max();
    std::vector<int> layer(mesh_.n_nodes(), far);
    for (int c : cells_)
      for (int node : mesh_.cells[c]) layer[node] = 0;
    for (int k = 0; k < last; ++k) {
      // Owned nodes have all their cells here; ghosts have not, and learn from their owners.
      mesh_.nodes.update_ghosts(layer.data());
      for (const auto& cell : mesh_.cells)
        if (std::any_of(cell.begin(), cell.end(), [&](int node) { return layer[node] == k; }))
          for (int node : cell) layer[node] = std::min(layer[node], k + 1);
    }
    mesh_.nodes.update_ghosts(layer.data());
    return layer;
  }

 private:
  [[nodiscard]] int local_cell(long input) const {
    const auto it = std::lower_bound(cells_by_input_.begin(), cells_by_input_.end(), std::pair(input, -1));
    return it != cells_by_input_.end() && it->first == input ? it->second : -1;
  }

  const Mesh<Element>& mesh_;
  std::vector<std::pair<long, int>> cells_by_input_;  ///< (input number, local cell), sorted
  std::vector<char> flags_;
  std::vector<int> cells_;
};

}  // namespace ifsi
