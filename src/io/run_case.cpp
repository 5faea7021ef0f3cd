#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

#include "ifsi/core/error.hpp"
#include "ifsi/io/run.hpp"
#include "run_end.hpp"

namespace ifsi {
namespace {

using namespace std::chrono_literals;

/// MPI for the time of a run, unless the caller has started it already; with a communicator for failures
/// alone.
class Session {
 public:
  Session(int argc, char** argv) {
    int started = 0;
    MPI_Initialized(&started);
    owned_ = started == 0;
    if (owned_) MPI_Init(&argc, &argv);
    MPI_Comm_dup(MPI_COMM_WORLD, &failures_);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    MPI_Comm_free(&failures_);
    if (owned_) MPI_Finalize();
  }
  [[nodiscard]] Communicator failures() const { return Communicator(failures_); }

 private:
  bool owned_ = false;
  MPI_Comm failures_ = MPI_COMM_NULL;
};

/// Whether every rank came here within some time; the ranks wait in turn, so that one of them speaks first.
bool all_failed(const Communicator& comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(comm.handle(), &request);
  const auto patience = 1s + std::min(comm.rank(), 40) * 250ms;
  const auto deadline = std::chrono::steady_clock::now() + patience;
  int arrived = 0;
  while (MPI_Test(&request, &arrived, MPI_STATUS_IGNORE), arrived == 0) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

int fail(const Session& session, const std::string& name, Run* run, ExitCode code,
         const std::string& message) {
  const Communicator comm = session.failures();
  const bool together = all_failed(comm);
  if (!together || comm.is_root()) {
    if (run != nullptr) run->log_failure(message);
    std::fprintf(stderr, "%s: error: %s\n", name.c_str(), message.c_str());
  }
  if (!together) MPI_Abort(comm.handle(), static_cast<int>(code));
  return static_cast<int>(code);
}

}  // namespace

int run_case(int argc, char** argv, const CaseInfo& info, const std::function<void(Run&)>& body) {
  const Session session(argc, argv);
  std::optional<Run> run;
  try {
    run.emplace(argc, argv, info);
    body(*run);
    return static_cast<int>(run->finish());
  } catch (const detail::EndedByOption&) {
    return 0;
  } catch (const Error& e) {
    return fail(session, info.name, run ? &*run : nullptr, e.code(), e.what());
  } catch (const std::exception& e) {
    return fail(session, info.name, run ? &*run : nullptr, ExitCode::configuration,
                std::string("internal error: ") + e.what());
  }
}

}  // namespace ifsi
