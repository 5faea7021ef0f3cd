#pragma once
/// \file
/// A rank's part of a matrix with one layer of overlap: the rows of its ghosts beside its own.

#include <vector>

#include "ifsi/linalg/pattern.hpp"

namespace ifsi {

/// Compressed rows of all local nodes, owned before ghosts, with those columns that are local nodes too. The
/// order is the local one; `blocks` says where the values of the ghosts' rows come from.
struct OverlapPattern {
  std::vector<int> row_ptr, cols;
  std::vector<int> diagonal;  ///< position of the diagonal block of each row
  Layout blocks;              ///< of the matrix blocks: owned are those of the owned rows, in their order

  [[nodiscard]] int n_rows() const { return static_cast<int>(diagonal.size()); }
};

/// Collective: every rank learns the rows of its ghosts from their owners.
[[nodiscard]] OverlapPattern make_overlap(const Pattern& pattern);

}  // namespace ifsi
