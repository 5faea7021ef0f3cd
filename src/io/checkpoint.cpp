#include "ifsi/io/checkpoint.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "atomic_file.hpp"
#include "checkpoint_format.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/io/root.hpp"

namespace ifsi {
namespace {

namespace fs = std::filesystem;

/// Checkpoints of a folder, oldest step first.
std::vector<fs::path> checkpoints(const std::string& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("checkpoint_", 0) == 0 && entry.path().extension() == ".ifsi")
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Deletes all but the new file and the one before it. Later ones belong to a run that was taken up again
/// earlier.
void delete_others(const std::string& folder, const fs::path& newest) {
  const std::vector<fs::path> all = checkpoints(folder);
  const auto here = std::find(all.begin(), all.end(), newest);
  for (auto it = all.begin(); it != all.end(); ++it)
    if (it != here && it + 1 != here) fs::remove(*it);
}

template <class T>
std::vector<T> gather_on_root(const Communicator& comm, const T* mine, std::size_t n, MPI_Datatype type) {
  const int count = static_cast<int>(n);
  std::vector<int> counts(comm.size()), starts(comm.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm.handle());
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  std::vector<T> all(comm.is_root() ? static_cast<std::size_t>(starts.back() + counts.back()) : 0);
  MPI_Gatherv(mine, count, type, all.data(), counts.data(), starts.data(), type, 0, comm.handle());
  return all;
}

/// Values ordered by key. NaN marks the keys nobody filed, so it cannot be a value.
std::vector<double> by_key(const std::string& name, const std::vector<double>& values, std::size_t block,
                           const std::vector<long>& keys) {
  const long n = keys.empty() ? 0 : *std::max_element(keys.begin(), keys.end()) + 1;
  std::vector<double> sorted(static_cast<std::size_t>(n) * block, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t c = 0; c < block; ++c) {
      const double value = values[i * block + c];
      double& slot = sorted[static_cast<std::size_t>(keys[i]) * block + c];
      if (std::isnan(value))
        throw Error(
            ExitCode::invalid_state,
            fmt::format("no checkpoint written: '{}' is NaN in component {} of entry {}", name, c, keys[i]));
      if (!std::isnan(slot))
        throw std::logic_error(fmt::format("checkpoint: two entries {} of '{}'", keys[i], name));
      slot = value;
    }
  return sorted;
}

}  // namespace

CheckpointWriter::CheckpointWriter(Communicator comm) : comm_(comm), bytes_(detail::checkpoint_head()) {}

void CheckpointWriter::record(char kind, const std::string& name, int block, const void* payload,
                              std::size_t size) {
  if (comm_.is_root()) bytes_ += detail::checkpoint_record(kind, name, block, payload, size);
}

void CheckpointWriter::number(const std::string& name, double value) {
  record('n', name, 1, &value, sizeof value);
}

void CheckpointWriter::text(const std::string& name, const std::string& value) {
  record('t', name, 1, value.data(), value.size());
}

void CheckpointWriter::array(const std::string& name, const double* values, int block,
                             const std::vector<long>& keys) {
  const auto width = static_cast<std::size_t>(block);
  const auto all_keys = gather_on_root(comm_, keys.data(), keys.size(), MPI_LONG);
  const auto all_values = gather_on_root(comm_, values, keys.size() * width, MPI_DOUBLE);
  on_root(comm_, [&] {
    const std::vector<double> sorted = by_key(name, all_values, width, all_keys);
    record('a', name, block, sorted.data(), sorted.size() * sizeof(double));
  });
}

std::string CheckpointWriter::save(const std::string& folder, long step) const {
  const fs::path file = fs::path(folder) / fmt::format("checkpoint_{:09}.ifsi", step);
  on_root(comm_, [&] {
    detail::write_atomically(file.string(), bytes_ + detail::checkpoint_record('e', "", 1, "", 0));
    delete_others(folder, file);
  });
  return file.string();
}

std::string latest_checkpoint(const std::string& folder) {
  const std::vector<fs::path> found = checkpoints(folder);
  if (found.empty())
    throw Error(ExitCode::file, "no checkpoint in '" + folder +
                                    "'; expected checkpoint_<step>.ifsi there, or --restart=FILE");
  return found.back().string();
}

}  // namespace ifsi
