#include "atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "ifsi/core/error.hpp"

namespace ifsi::detail {
namespace {

bool write_all(int descriptor, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return fsync(descriptor) == 0;
}

}  // namespace

void write_atomically(const std::string& file, const std::string& bytes) {
  const std::string partial = file + ".part";
  const int descriptor = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  bool written = descriptor >= 0 && write_all(descriptor, bytes);
  int reason = errno;
  if (descriptor >= 0 && ::close(descriptor) != 0) written = false;
  if (written && std::rename(partial.c_str(), file.c_str()) == 0) return;
  if (written) reason = errno;
  ::unlink(partial.c_str());
  throw Error(ExitCode::file, "cannot write '" + file + "': " + std::strerror(reason));
}

}  // namespace ifsi::detail
