#pragma once
/// \file
/// Checkpoints: named numbers, texts and arrays in one file that any number of ranks can read back.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "ifsi/core/communicator.hpp"

namespace ifsi {

/// Collects what a checkpoint holds and writes it. Array entries are filed under keys (numbers from 0 that do
/// not depend on the distribution, such as those of the points of the input mesh), so that another number of
/// ranks finds them. Rank 0 collects the whole file in memory.
///
/// The file: the 8 bytes "IFSICKPT"; uint32 0x01020304 (tells the byte order); uint32 version (1); then
/// records of uint8 kind ('n' number, 't' text, 'a' array, 'e' end), uint32 length of the name, the name,
/// uint64 block, uint64 length of the payload in bytes, the payload, and uint32 CRC-32 of the record up to
/// here. The payload of an array is float64 [key * block + component], NaN where no entry was filed. The last
/// record is of kind 'e'.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(Communicator comm);

  void number(const std::string& name, double value);
  void text(const std::string& name, const std::string& value);
  /// Collective. values[i * block + c], c < block, is filed under keys[i]; each key comes from one rank only.
  /// Throws Error(invalid_state) when a value is NaN: a state that cannot be continued must not replace one
  /// that can.
  void array(const std::string& name, const double* values, int block, const std::vector<long>& keys);

  /// Collective. Writes `folder/checkpoint_<step>.ifsi` (whole or not at all) and returns its path; of the
  /// others keeps only the one before. Throws Error(file).
  std::string save(const std::string& folder, long step) const;

 private:
  void record(char kind, const std::string& name, int block, const void* payload, std::size_t size);
  Communicator comm_;
  std::string bytes_;  // on rank 0
};

/// An open checkpoint. Errors (no such file, not a checkpoint, cut short, damaged, no such name, other sizes)
/// are Error(file) and say which. All members are collective.
class Checkpoint {
 public:
  /// Checks the whole file.
  Checkpoint(Communicator comm, const std::string& file);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;
  [[nodiscard]] std::string text(const std::string& name) const;
  /// values[i * block + c] for the keys[i] this rank asks for; ranks may ask for the same.
  void array(const std::string& name, double* values, int block, const std::vector<long>& keys) const;

 private:
  struct Reader;
  Communicator comm_;
  std::unique_ptr<Reader> reader_;  // on rank 0
};

/// The newest checkpoint in a folder; throws Error(file) when there is none.
[[nodiscard]] std::string latest_checkpoint(const std::string& folder);

}  // namespace ifsi
