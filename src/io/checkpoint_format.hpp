#pragma once
/// \file
/// Bytes of a checkpoint file; see ifsi/io/checkpoint.hpp for the layout.

#include <cstdint>
#include <fstream>
#include <map>
#include <string>

namespace ifsi::detail {

std::string checkpoint_head();
std::string checkpoint_record(char kind, const std::string& name, int block, const void* payload,
                              std::size_t size);

/// Index of the records of a file. The constructor reads all of it once and checks every CRC; throws
/// Error(file).
class CheckpointIndex {
 public:
  struct Record {
    char kind;
    std::uint64_t block;
    std::streamoff start;  ///< of the payload
    std::uint64_t size;    ///< of the payload in bytes
  };

  explicit CheckpointIndex(const std::string& file);
  [[nodiscard]] bool has(const std::string& name) const { return records_.count(name) > 0; }
  /// Throws Error(file) when there is no record of this name and kind.
  [[nodiscard]] const Record& find(const std::string& name, char kind) const;
  /// Reads a payload of record.size bytes.
  void read(const Record& record, void* payload);
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  template <class T>
  T take(std::uint32_t& crc);
  std::string take_bytes(std::uint64_t n, std::uint32_t& crc);
  void skip_payload(std::uint64_t n, std::uint32_t& crc);
  bool next_record();
  [[noreturn]] void fail(const std::string& what) const;

  std::string file_;
  std::ifstream stream_;
  std::map<std::string, Record> records_;
};

}  // namespace ifsi::detail
