#pragma once
/// \file
/// Nodal vectors of a distributed mesh in checkpoints.

#include <algorithm>
#include <string>
#include <vector>

#include "ifsi/io/checkpoint.hpp"
#include "ifsi/mesh/mesh.hpp"

namespace ifsi {

/// Key of each owned node: the least number its points have in the input mesh, whatever the distribution. An
/// owned node has all its cells on this rank, hence all its points.
template <class Element>
[[nodiscard]] std::vector<long> node_keys(const Mesh<Element>& mesh) {
  std::vector<long> keys(mesh.n_owned_nodes(), -1);
  for (int i = 0; i < mesh.n_points(); ++i) {
    const int node = mesh.point_node[i];
    if (node >= mesh.n_owned_nodes()) continue;
    const long point = mesh.input_point[i];
    keys[node] = keys[node] < 0 ? point : std::min(keys[node], point);
  }
  return keys;
}

/// Collective. Adds values[node * block + c] of the nodes.
template <class Element>
void write_nodes(CheckpointWriter& checkpoint, const std::string& name, const Mesh<Element>& mesh,
                 const double* values, int block) {
  checkpoint.array(name, values, block, node_keys(mesh));
}

/// Collective. Reads values[node * block + c] of owned nodes and ghosts.
template <class Element>
void read_nodes(const Checkpoint& checkpoint, const std::string& name, const Mesh<Element>& mesh,
                double* values, int block) {
  checkpoint.array(name, values, block, node_keys(mesh));
  mesh.nodes.update_ghosts(values, block);
}

}  // namespace ifsi
