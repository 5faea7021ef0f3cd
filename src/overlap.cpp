#include "ifsi/linalg/overlap.hpp"

#include <unordered_map>

namespace ifsi {
namespace {

/// Where a row lies in the numbering of all blocks of all ranks.
struct RowPlace {
  long first, size;
};

/// A block of a ghost's row: its column, and its number among the blocks of all ranks.
struct RemoteBlock {
  long column, number;
};

/// The blocks of the ghosts' rows, row after row; columns are global numbers. start[g] is where the row of
/// ghost g begins.
std::vector<RemoteBlock> rows_of_ghosts(const Pattern& pattern, std::vector<int>& start) {
  const Layout& nodes = pattern.layout;
  const Layout blocks(nodes.communicator(), pattern.n_blocks());
  std::vector<RowPlace> rows(nodes.n_local());
  for (int i = 0; i < pattern.n_rows(); ++i)
    rows[i] = {blocks.first_global() + pattern.row_ptr[i], pattern.row_ptr[i + 1] - pattern.row_ptr[i]};
  nodes.update_ghosts(rows.data());
  std::vector<long> numbers;
  start.assign(1, 0);
  for (int i = nodes.n_owned(); i < nodes.n_local(); ++i) {
    for (long k = 0; k < rows[i].size; ++k) numbers.push_back(rows[i].first + k);
    start.push_back(static_cast<int>(numbers.size()));
  }
  const Layout with_ghosts(nodes.communicator(), pattern.n_blocks(), numbers);
  std::vector<long> columns(with_ghosts.n_local());
  for (int k = 0; k < pattern.n_blocks(); ++k) columns[k] = nodes.global(pattern.cols[k]);
  with_ghosts.update_ghosts(columns.data());
  std::vector<RemoteBlock> result(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) result[k] = {columns[pattern.n_blocks() + k], numbers[k]};
  return result;
}

}  // namespace

OverlapPattern make_overlap(const Pattern& pattern) {
  const Layout& nodes = pattern.layout;
  OverlapPattern overlap{pattern.row_ptr, pattern.cols, {}, {}};
  std::unordered_map<long, int> ghosts;
  for (int i = nodes.n_owned(); i < nodes.n_local(); ++i) ghosts[nodes.global(i)] = i;
  const auto local = [&](long global) {
    const long i = global - nodes.first_global();
    if (i >= 0 && i < nodes.n_owned()) return static_cast<int>(i);
    const auto it = ghosts.find(global);
    return it != ghosts.end() ? it->second : -1;
  };
  std::vector<int> start;
  const std::vector<RemoteBlock> remote = rows_of_ghosts(pattern, start);
  std::vector<long> wanted;
  for (int g = 0; g < nodes.n_ghost(); ++g) {
    std::vector<std::pair<int, long>> row;
    for (int k = start[g]; k < start[g + 1]; ++k)
      if (const int column = local(remote[k].column); column >= 0) row.emplace_back(column, remote[k].number);
    std::sort(row.begin(), row.end());
    for (const auto& [column, number] : row) overlap.cols.push_back(column), wanted.push_back(number);
    overlap.row_ptr.push_back(static_cast<int>(overlap.cols.size()));
  }
  overlap.blocks = Layout(nodes.communicator(), pattern.n_blocks(), wanted);
  for (int i = 0; i < nodes.n_local(); ++i) {
    const auto begin = overlap.cols.begin();
    overlap.diagonal.push_back(static_cast<int>(
        std::lower_bound(begin + overlap.row_ptr[i], begin + overlap.row_ptr[i + 1], i) - begin));
  }
  return overlap;
}

}  // namespace ifsi
