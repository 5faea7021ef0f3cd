// A run on several ranks.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "ifsi/io/checkpoint.hpp"
#include "ifsi/io/run.hpp"
#include "scratch_folder.hpp"

namespace ifsi {
namespace {

void run_in(const test::ScratchFolder& folder, std::vector<std::string> arguments,
            const std::function<void(Run&)>& body) {
  arguments.insert(arguments.begin(), "sample");
  arguments.insert(arguments.end(), {"--out", folder.path()});
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  testing::internal::CaptureStdout();
  const int code = run_case(static_cast<int>(argv.size()), argv.data(), {"sample", "a case for tests"},
                            [&](Run& run) { run.parse(), body(run); });
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(code, 0);
}

// The first rank writes the table anew as soon as it has read it itself.
TEST(RunOnRanks, ARestartKeepsTheTableUntilAllRanksHaveReadIt) {
  const test::ScratchFolder folder;
  run_in(folder, {}, [](ifsi::Run& run) {
    CsvFile history = run.csv("history.csv", {{"t", "s"}});
    for (double t : {0.1, 0.2, 0.3}) history.row({t});
    CheckpointWriter(run.comm()).save(run.path(""), 1);
  });
  run_in(folder, {"--restart"}, [&](ifsi::Run& run) {
    if (!run.comm().is_root()) std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(folder.read("history.csv"), "t [s]\n0.1\n0.2\n0.3\n");
    run.csv("history.csv", {{"t", "s"}}, 0.1).row({0.15});
  });
  if (Communicator(MPI_COMM_WORLD).is_root()) EXPECT_EQ(folder.read("history.csv"), "t [s]\n0.1\n0.15\n");
}

}  // namespace
}  // namespace ifsi
