#pragma once
/// \file
/// Graph partition.

#include <vector>

namespace ifsi {

/// Part in [0, n_parts) of each vertex of a graph in adjacency form (neighbours of i: from
/// adjacency[begin[i]] to before adjacency[begin[i + 1]]), by METIS k-way: equal parts, few cut edges, the
/// same answer for the same input. Every part has a vertex. Throws Error(configuration) when there are more
/// parts than vertices.
std::vector<int> partition_graph(const std::vector<int>& begin, const std::vector<int>& adjacency,
                                 int n_parts);

}  // namespace ifsi
