#pragma once
/// \file
/// Reads the .vtu files ifsi writes the way VTK does: XML header, then appended compressed blocks.

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace ifsi::test {

class VtuReader {
 public:
  explicit VtuReader(std::string bytes) : bytes_(std::move(bytes)) {
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    data_ = bytes_.find(mark);
    if (data_ == std::string::npos) throw std::runtime_error("no appended data");
    data_ += mark.size();
  }

  /// Attribute of the first tag that has `where` in it.
  [[nodiscard]] std::string attribute(const std::string& where, const std::string& name) const {
    const std::size_t tag = bytes_.rfind('<', bytes_.find(where));
    const std::string text = bytes_.substr(tag, bytes_.find('>', tag) - tag);
    const std::size_t start = text.find(name + "=\"") + name.size() + 2;
    return text.substr(start, text.find('"', start) - start);
  }
  [[nodiscard]] long count(const std::string& attribute_name) const {
    return std::stol(attribute("<Piece", attribute_name));
  }

  template <class T>
  [[nodiscard]] std::vector<T> array(const std::string& name) const {
    const std::size_t at = data_ + std::stoul(attribute("Name=\"" + name + "\"", "offset"));
    const std::string raw = unpack(bytes_.data() + at);
    std::vector<T> values(raw.size() / sizeof(T));
    if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }

 private:
  static std::string unpack(const char* from) {
    std::uint64_t head[3];
    std::memcpy(head, from, sizeof head);
    const auto [n_blocks, size, last_size] = head;
    std::vector<std::uint64_t> packed(n_blocks);
    if (n_blocks > 0) std::memcpy(packed.data(), from + sizeof head, n_blocks * 8);
    const char* block = from + sizeof head + n_blocks * 8;
    std::string raw;
    for (std::uint64_t b = 0; b < n_blocks; ++b) {
      uLongf n = b + 1 == n_blocks && last_size > 0 ? last_size : size;
      const uLongf expected = n;
      std::string piece(n, '\0');
      const int status = uncompress(reinterpret_cast<Bytef*>(piece.data()), &n,
                                    reinterpret_cast<const Bytef*>(block), packed[b]);
      if (status != Z_OK || n != expected) throw std::runtime_error("block does not unpack");
      raw += piece;
      block += packed[b];
    }
    return raw;
  }

  std::string bytes_;
  std::size_t data_;
};

}  // namespace ifsi::test
