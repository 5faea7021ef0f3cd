#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "checkpoint_format.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/io/checkpoint.hpp"
#include "ifsi/io/root.hpp"

namespace ifsi {

namespace {

void broadcast(const Communicator& comm, std::vector<double>& values) {
  long size = static_cast<long>(values.size());
  MPI_Bcast(&size, 1, MPI_LONG, 0, comm.handle());
  values.resize(static_cast<std::size_t>(size));
  MPI_Bcast(values.data(), static_cast<int>(size), MPI_DOUBLE, 0, comm.handle());
}

/// Copies the entries of the keys; returns a key that has none, or -1.
long pick(const std::vector<double>& all, int block, const std::vector<long>& keys, double* values) {
  const auto width = static_cast<std::size_t>(block);
  for (const long key : keys) {
    const std::size_t start = static_cast<std::size_t>(key) * width;
    for (std::size_t at = start; at < start + width; ++at) {
      if (at >= all.size() || std::isnan(all[at])) return key;
      *values++ = all[at];
    }
  }
  return -1;
}

}  // namespace

struct Checkpoint::Reader {
  detail::CheckpointIndex index;
};

Checkpoint::Checkpoint(Communicator comm, const std::string& file) : comm_(comm) {
  on_root(comm_, [&] { reader_ = std::make_unique<Reader>(Reader{detail::CheckpointIndex(file)}); });
}

Checkpoint::~Checkpoint() = default;

bool Checkpoint::has(const std::string& name) const {
  return comm_.any(comm_.is_root() && reader_->index.has(name));
}

double Checkpoint::number(const std::string& name) const {
  double value = 0.0;
  on_root(comm_, [&] { reader_->index.read(reader_->index.find(name, 'n'), &value); });
  MPI_Bcast(&value, 1, MPI_DOUBLE, 0, comm_.handle());
  return value;
}

std::string Checkpoint::text(const std::string& name) const {
  std::string value;
  on_root(comm_, [&] {
    const auto& record = reader_->index.find(name, 't');
    value.resize(record.size);
    reader_->index.read(record, value.data());
  });
  return broadcast(comm_, value);
}

void Checkpoint::array(const std::string& name, double* values, int block,
                       const std::vector<long>& keys) const {
  std::vector<double> all;
  on_root(comm_, [&] {
    const auto& record = reader_->index.find(name, 'a');
    if (record.block != static_cast<std::uint64_t>(block))
      throw Error(ExitCode::file, fmt::format("checkpoint '{}': '{}' has {} values per entry; expected {}",
                                              reader_->index.file(), name, record.block, block));
    all.resize(record.size / sizeof(double));
    reader_->index.read(record, all.data());
  });
  broadcast(comm_, all);
  const long missing = comm_.max(pick(all, block, keys, values));
  if (missing >= 0)
    throw Error(ExitCode::file,
                fmt::format("checkpoint: '{}' has no entry {}; expected the mesh it was written with", name,
                            missing));
}

}  // namespace ifsi
