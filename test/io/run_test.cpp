// A run as a driver and its user see it: exit codes, files, messages. One rank.
#include "ifsi/io/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>

#include "ifsi/io/checkpoint.hpp"
#include "json.hpp"
#include "scratch_folder.hpp"

namespace ifsi {
namespace {

using test::Json;
using test::read_json;

class RunCase : public testing::Test {
 protected:
  using Run = ifsi::Run;  // not testing::Test::Run
  test::ScratchFolder folder;
  std::string out, err;
  double re = 40.0;

  /// Runs a driver with one parameter, Re; keeps what it prints.
  int run(std::vector<std::string> arguments, const std::function<void(Run&)>& body = {}) {
    if (std::find(arguments.begin(), arguments.end(), "--out") == arguments.end())
      arguments.insert(arguments.end(), {"--out", folder.path()});
    arguments.insert(arguments.begin(), "sample");
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code =
        run_case(static_cast<int>(argv.size()), argv.data(), {"sample", "a case for tests"}, [&](Run& r) {
          r.params.add("Re", re, "-", "Reynolds number", {1.0, 1e4});
          r.parse();
          if (body) body(r);
        });
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return code;
  }
  [[nodiscard]] Json summary() const { return read_json(folder.read("summary.json")); }
};

TEST_F(RunCase, SummaryHasExactlyTheseFields) {
  EXPECT_EQ(run({"--set", "Re=100"},
                [](Run& r) {
                  auto timing = r.timers.scope("solve");
                  r.totals = {1000, 10, 30, 90};
                  r.metric("v_l2", 0.25, "m/s");
                  r.check("cd", 5.58, 5.5795, 1e-3, "Nabh 1998 \"table\"");
                }),
            0)
      << err;
  const Json s = summary();
  EXPECT_EQ(s.names(),
            (std::vector<std::string>{"case",         "ranks",       "threads",   "dofs",    "steps",
                                      "newton_total", "gmres_total", "wall_s",    "cpu_s",   "peak_rss_mb",
                                      "metrics",      "checks",      "timers",    "version", "commit",
                                      "compiler",     "flags",       "processor", "date",    "parameters"}));
  EXPECT_EQ(s["case"].string, "sample");
  EXPECT_EQ(s["dofs"].number, 1000);
  EXPECT_EQ(s["steps"].number, 10);
  EXPECT_EQ(s["newton_total"].number, 30);
  EXPECT_EQ(s["gmres_total"].number, 90);
  EXPECT_EQ(s["metrics"]["v_l2"].number, 0.25);
  EXPECT_EQ(s["parameters"]["Re"].number, 100);
  EXPECT_GE(s["timers"]["solve"].number, 0.0);
  EXPECT_GT(s["cpu_s"].number, 0.0);
  EXPECT_GT(s["peak_rss_mb"].number, 1.0);
  EXPECT_NE(s["compiler"].string, "");
  const Json& check = s["checks"].members.at(0).second;
  EXPECT_EQ(check.names(),
            (std::vector<std::string>{"name", "value", "reference", "tolerance", "pass", "source"}));
  EXPECT_TRUE(check["pass"].boolean);
  EXPECT_EQ(check["tolerance"].number, 1e-3);
  EXPECT_EQ(check["source"].string, "Nabh 1998 \"table\"");
}

TEST_F(RunCase, ChecksDecideTheExitCode) {
  const auto code = [&](const std::function<bool(Run&)>& check, bool holds) {
    return run({}, [&](Run& r) { EXPECT_EQ(check(r), holds); });
  };
  EXPECT_EQ(code([](Run& r) { return r.check("a", 1.0099, 1.0, 0.01, ""); }, true), 0);
  EXPECT_EQ(code([](Run& r) { return r.check("a", 1.0101, 1.0, 0.01, ""); }, false), 7);
  EXPECT_EQ(code([](Run& r) { return r.check("a", -2.01, -2.0, 0.01, ""); }, true), 0);
  EXPECT_EQ(code([](Run& r) { return r.check("a", 0.02, 0.0, 0.01, ""); }, false), 7);
  EXPECT_EQ(code([](Run& r) { return r.check("a", std::nan(""), 1.0, 0.01, ""); }, false), 7);
  EXPECT_EQ(code([](Run& r) { return r.check_between("a", 0.31, 0.295, 0.305, ""); }, false), 7);
  EXPECT_EQ(code([](Run& r) { return r.check_between("a", 0.3, 0.295, 0.305, ""); }, true), 0);
  EXPECT_EQ(code([](Run& r) { return r.check_at_most("a", 1.0, 1.0, ""); }, true), 0);
  EXPECT_EQ(code([](Run& r) { return r.check_at_most("a", 1.1, 1.0, ""); }, false), 7);
  EXPECT_EQ(code([](Run& r) { return r.check_at_least("order", 1.9, 2.0, ""); }, false), 7);
  EXPECT_EQ(code([](Run& r) { return r.check_at_least("order", std::nan(""), 2.0, ""); }, false), 7);
  EXPECT_FALSE(summary()["checks"].members.at(0).second["pass"].boolean) << "a failed check is recorded";
}

TEST_F(RunCase, MetricsThatAreNotFiniteFailTheRunAndStayValidJson) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(run({}, [&](Run& r) { r.metric("v_l2", bad); }), 5);
    EXPECT_EQ(summary()["metrics"]["v_l2"].kind, Json::Kind::null);
    EXPECT_NE(err.find("v_l2"), std::string::npos);
  }
}

TEST_F(RunCase, FailuresEndWithTheirCodeAndOneMessageAndNoSummary) {
  folder.write("summary.json", "{}");
  EXPECT_EQ(run({}, [](Run&) { throw Error(ExitCode::nonlinear, "Newton: no convergence"); }), 4);
  EXPECT_EQ(err, "sample: error: Newton: no convergence\n");
  EXPECT_FALSE(folder.has("summary.json")) << "the summary of an earlier run must not pass for this one's";
  EXPECT_NE(folder.read("log.txt").find("Newton: no convergence"), std::string::npos);
  EXPECT_EQ(run({}, [](Run&) { throw std::out_of_range("vector"); }), 1);
  EXPECT_EQ(err, "sample: error: internal error: vector\n");
}

TEST_F(RunCase, BadCommandLines) {
  EXPECT_EQ(run({"--frobnicate"}), 1);
  EXPECT_NE(err.find("--frobnicate"), std::string::npos);
  EXPECT_EQ(run({"--config"}), 1);
  EXPECT_EQ(run({"--set", "Ree=3"}), 1);
  EXPECT_NE(err.find("did you mean 'Re'"), std::string::npos);
  EXPECT_EQ(run({"--config", folder.file("none.toml")}), 2);
  EXPECT_EQ(run({"--out", "/proc/none"}), 2);
  EXPECT_NE(err.find("/proc/none"), std::string::npos);
  EXPECT_EQ(run({"--restart"}), 2);
  EXPECT_NE(err.find("no checkpoint"), std::string::npos);
}

TEST_F(RunCase, OptionsThatPrintAndEnd) {
  const auto never = [](Run&) { FAIL() << "the body must not run"; };
  const std::vector<std::pair<std::string, std::string>> options{{"--help", "--restart"},
                                                                 {"--describe", "sample: a case for tests"},
                                                                 {"--params", "Reynolds number"},
                                                                 {"--print-config", "Re = 7"},
                                                                 {"--check", "valid"}};
  for (const auto& [option, printed] : options) {
    EXPECT_EQ(run({option, "--set", "Re=7"}, never), 0) << option;
    EXPECT_NE(out.find(printed), std::string::npos) << option << ": " << out;
  }
  EXPECT_EQ(run({"--check", "--set", "Re=-7"}, never), 1);
  EXPECT_FALSE(folder.has("log.txt"));
}

TEST_F(RunCase, ConfigurationFileThenCommandLine) {
  const std::string file = folder.write("case.toml", "Re = 7\n");
  EXPECT_EQ(run({"--config", file}), 0);
  EXPECT_EQ(re, 7.0);
  EXPECT_EQ(run({"--config", file, "--set", "Re=8", "--set", "Re=9"}), 0);
  EXPECT_EQ(re, 9.0);
}

TEST_F(RunCase, SignalOrStopFileAsksToStopOnce) {
  EXPECT_EQ(run({},
                [&](Run& r) {
                  EXPECT_FALSE(r.stop_requested());
                  folder.write("STOP", "");
                  EXPECT_TRUE(r.stop_requested());
                  EXPECT_FALSE(r.stop_requested())
                      << "the file is taken away, or the next run would stop too";
                }),
            0);
  EXPECT_EQ(run({},
                [&](Run& r) {
                  EXPECT_FALSE(r.stop_requested());
                  std::raise(SIGTERM);
                  EXPECT_TRUE(r.stop_requested());
                  throw Error(ExitCode::stopped, "stopped at step 3");
                }),
            6);
}

TEST_F(RunCase, LogKeepsEveryLineAndTheTerminalFewOfTheSteps) {
  EXPECT_EQ(run({},
                [](Run& r) {
                  for (int i = 1; i <= 1000; ++i) r.progress(i / 1000.0, "step " + std::to_string(i) + ".");
                  r.detail("newton 1");
                  r.log("a note");
                }),
            0);
  const std::string log = folder.read("log.txt");
  for (const char* line : {"step 1.", "step 777.", "newton 1", "a note"})
    EXPECT_NE(log.find(line), std::string::npos) << line;
  EXPECT_EQ(out.find("newton 1"), std::string::npos);
  EXPECT_NE(out.find("a note"), std::string::npos);
  EXPECT_NE(out.find("step 1000."), std::string::npos) << "the last step is always shown";
  EXPECT_LE(std::count(out.begin(), out.end(), '\n'), 60);
}

TEST_F(RunCase, TerminalShowsProgressInPlaceWithTimeLeft) {
  setenv("IFSI_TERMINAL", "1", 1);
  EXPECT_EQ(run({},
                [](Run& r) {
                  r.progress(0.25, "t=1");
                  r.progress(0.5, "t=2");
                }),
            0);
  unsetenv("IFSI_TERMINAL");
  EXPECT_NE(out.find("\r\033[K 50 %  t=2  ETA 0 s"), std::string::npos) << out;
}

TEST_F(RunCase, RestartFindsTheLatestCheckpointAndContinuesTheHistory) {
  EXPECT_EQ(run({},
                [](Run& r) {
                  EXPECT_FALSE(r.restarted());
                  CsvFile history = r.csv("history.csv", {{"t", "s"}});
                  history.row({0.1});
                  history.row({0.2});
                  CheckpointWriter(r.comm()).save(r.path(""), 1);
                }),
            0);
  EXPECT_EQ(run({"--restart"},
                [](Run& r) {
                  EXPECT_TRUE(r.restarted());
                  EXPECT_EQ(r.restart_file(), r.path("checkpoint_000000001.ifsi"));
                  r.csv("history.csv", {{"t", "s"}}, 0.1).row({0.15});
                }),
            0)
      << err;
  EXPECT_EQ(folder.read("history.csv"), "t [s]\n0.1\n0.15\n");
  EXPECT_EQ(run({"--restart=other"}, [](Run& r) { EXPECT_EQ(r.restart_file(), "other"); }), 0);
}

TEST(Timers, SumCallsBySection) {
  Timers timers;
  for (int i = 0; i < 3; ++i) auto timing = timers.scope("solve");
  { auto timing = timers.scope("output"); }
  ASSERT_EQ(timers.sections().size(), 2u);
  EXPECT_EQ(timers.sections()[0].name, "solve");
  EXPECT_EQ(timers.sections()[0].calls, 3);
  EXPECT_GT(timers.seconds("solve"), 0.0);
  EXPECT_EQ(timers.seconds("never"), 0.0);
}

}  // namespace
}  // namespace ifsi
