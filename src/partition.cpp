/// \file
/// METIS behind a plain interface.

#include "ifsi/mesh/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <string>

#include "ifsi/core/error.hpp"

namespace ifsi {

namespace {

/// Gives every empty part one vertex of the largest part.
void fill_empty_parts(std::vector<int>& part, int n_parts) {
  std::vector<int> size(n_parts, 0);
  for (int p : part) ++size[p];
  for (int empty = 0; empty < n_parts; ++empty) {
    if (size[empty] > 0) continue;
    const int largest = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
    *std::find(part.begin(), part.end(), largest) = empty;
    --size[largest];
    ++size[empty];
  }
}

}  // namespace

std::vector<int> partition_graph(const std::vector<int>& begin, const std::vector<int>& adjacency,
                                 int n_parts) {
  const int n = static_cast<int>(begin.size()) - 1;
  if (n_parts < 1 || n_parts > n)
    throw Error(ExitCode::configuration, "partition: found " + std::to_string(n_parts) + " parts for " +
                                             std::to_string(n) +
                                             " cells; expected between one and that many");
  std::vector<int> result(n, 0);
  if (n_parts == 1) return result;
  std::vector<idx_t> xadj(begin.begin(), begin.end()), adjncy(adjacency.begin(), adjacency.end()), part(n, 0);
  idx_t vertices = n, constraints = 1, parts = n_parts, cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status =
      METIS_PartGraphKway(&vertices, &constraints, xadj.data(), adjncy.data(), nullptr, nullptr, nullptr,
                          &parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK)
    throw Error(ExitCode::configuration, "partition: METIS failed with status " + std::to_string(status));
  std::copy(part.begin(), part.end(), result.begin());
  fill_empty_parts(result, n_parts);
  return result;
}

}  // namespace ifsi
