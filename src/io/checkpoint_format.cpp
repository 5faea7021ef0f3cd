#include "checkpoint_format.hpp"

#include <zlib.h>

#include <algorithm>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/core/suggestion.hpp"

namespace ifsi::detail {
namespace {

constexpr char magic[] = "IFSICKPT";
constexpr std::uint32_t byte_order_mark = 0x01020304, version = 1;
constexpr std::uint64_t longest_name = 4096;

template <class T>
void put(std::string& bytes, T x) {
  bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
}

std::uint32_t crc_of(std::uint32_t crc, const void* data, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(crc, static_cast<const Bytef*>(data), size));
}

}  // namespace

std::string checkpoint_head() {
  std::string bytes(magic);
  put(bytes, byte_order_mark);
  put(bytes, version);
  return bytes;
}

std::string checkpoint_record(char kind, const std::string& name, int block, const void* payload,
                              std::size_t size) {
  std::string bytes(1, kind);
  put(bytes, static_cast<std::uint32_t>(name.size()));
  bytes += name;
  put(bytes, static_cast<std::uint64_t>(block));
  put(bytes, static_cast<std::uint64_t>(size));
  bytes.append(static_cast<const char*>(payload), size);
  put(bytes, crc_of(0, bytes.data(), bytes.size()));
  return bytes;
}

CheckpointIndex::CheckpointIndex(const std::string& file) : file_(file), stream_(file, std::ios::binary) {
  if (!stream_) throw Error(ExitCode::file, "cannot read the checkpoint '" + file + "'");
  std::uint32_t unused = 0;
  const std::string start = take_bytes(8, unused);
  if (start != magic) fail("is no checkpoint: it does not begin with " + std::string(magic));
  if (take<std::uint32_t>(unused) != byte_order_mark) fail("comes from a machine with another byte order");
  const auto found = take<std::uint32_t>(unused);
  if (found != version)
    fail("has version " + std::to_string(found) + "; expected " + std::to_string(version));
  while (next_record()) {
  }
}

void CheckpointIndex::fail(const std::string& what) const {
  throw Error(ExitCode::file, "checkpoint '" + file_ + "' " + what);
}

std::string CheckpointIndex::take_bytes(std::uint64_t n, std::uint32_t& crc) {
  std::string bytes(n, '\0');
  if (!stream_.read(bytes.data(), static_cast<std::streamsize>(n)))
    fail("is cut short; the one before it may be whole (--restart=FILE)");
  crc = crc_of(crc, bytes.data(), bytes.size());
  return bytes;
}

template <class T>
T CheckpointIndex::take(std::uint32_t& crc) {
  T x{};
  take_bytes(sizeof x, crc).copy(reinterpret_cast<char*>(&x), sizeof x);
  return x;
}

void CheckpointIndex::skip_payload(std::uint64_t n, std::uint32_t& crc) {
  constexpr std::uint64_t chunk = 1 << 20;
  for (; n > 0; n -= std::min(n, chunk)) take_bytes(std::min(n, chunk), crc);
}

bool CheckpointIndex::next_record() {
  const char* damaged = "is damaged (a CRC does not fit); the one before it may be whole (--restart=FILE)";
  std::uint32_t crc = 0, unused = 0;
  const char kind = take<char>(crc);
  const auto name_size = take<std::uint32_t>(crc);
  if (name_size > longest_name) fail(damaged);
  const std::string name = take_bytes(name_size, crc);
  const auto block = take<std::uint64_t>(crc);
  const auto size = take<std::uint64_t>(crc);
  const std::streamoff start = stream_.tellg();
  skip_payload(size, crc);
  if (take<std::uint32_t>(unused) != crc) fail(damaged);
  if (kind != 'e') records_[name] = {kind, block, start, size};
  return kind != 'e';
}

const CheckpointIndex::Record& CheckpointIndex::find(const std::string& name, char kind) const {
  std::vector<std::string> names;
  for (const auto& [known, record] : records_) names.push_back(known);
  const auto it = records_.find(name);
  if (it == records_.end()) fail("has no '" + name + "'" + suggestion(name, names));
  if (it->second.kind != kind) fail("holds '" + name + "' as another kind of record");
  return it->second;
}

void CheckpointIndex::read(const Record& record, void* payload) {
  stream_.seekg(record.start);
  if (!stream_.read(static_cast<char*>(payload), static_cast<std::streamsize>(record.size)))
    fail("cannot be read");
}

}  // namespace ifsi::detail
