#include "ifsi/io/root.hpp"

#include "ifsi/core/error.hpp"

namespace ifsi {

std::string broadcast(const Communicator& comm, std::string text) {
  if (comm.size() == 1) return text;
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm.handle());
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, comm.handle());
  return text;
}

void on_root(const Communicator& comm, const std::function<void()>& work) {
  int code = 0;
  std::string message;
  if (comm.is_root()) {
    try {
      work();
    } catch (const Error& e) {
      code = static_cast<int>(e.code());
      message = e.what();
    } catch (const std::exception& e) {
      code = static_cast<int>(ExitCode::configuration);
      message = std::string("internal error: ") + e.what();
    }
  }
  code = static_cast<int>(comm.max(static_cast<long>(code)));
  if (code == 0) return;
  throw Error(static_cast<ExitCode>(code), broadcast(comm, message));
}

}  // namespace ifsi
