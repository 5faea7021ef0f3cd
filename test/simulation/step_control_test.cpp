// The control of the time step: cuts, recovery, adaptive growth.
#include <gtest/gtest.h>

#include "ifsi/simulation/time_loop.hpp"
#include "io/scratch_folder.hpp"

namespace ifsi {
namespace {

TimeOptions options(bool adaptive) {
  TimeOptions time;
  time.dt = 0.01;
  time.dt_min_factor = 0.1;
  time.adaptive = adaptive;
  time.dt_max = 0.05;
  return time;
}

TEST(StepControl, CutsAndReturnsAfterEightGoodSteps) {
  StepControl control(options(false));
  control.rejected(0.0, "no reason");
  EXPECT_DOUBLE_EQ(control.next(0.0, 1.0), 0.005);
  for (int k = 0; k < 7; ++k) control.accepted(0.005, 0.0);
  EXPECT_DOUBLE_EQ(control.next(0.0, 1.0), 0.005);
  control.accepted(0.005, 0.0);
  EXPECT_DOUBLE_EQ(control.next(0.0, 1.0), 0.01);
  for (int k = 0; k < 20; ++k) control.accepted(0.01, 1e-9);
  EXPECT_DOUBLE_EQ(control.next(0.0, 1.0), 0.01);  // never above what was asked for
}

TEST(StepControl, GivesUpWithTheReason) {
  StepControl control(options(false));
  try {
    for (int k = 0; k < 10; ++k) control.rejected(0.3, "the sky is falling");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::nonlinear);
    EXPECT_NE(std::string(error.what()).find("the sky is falling"), std::string::npos);
  }
}

TEST(StepControl, MeetsTheEndWithoutACrumb) {
  const StepControl control(options(false));
  EXPECT_NEAR(control.next(0.995, 1.0), 0.005, 1e-12);
  EXPECT_NEAR(control.next(0.985, 1.0), 0.0075, 1e-12);
}

// The change is of third order in dt: steps settle where it is half of the tolerated one.
TEST(StepControl, AdaptiveStepsSettleAtHalfTheToleratedChange) {
  StepControl control(options(true));
  const auto change = [](double dt) { return std::pow(dt / 0.04, 3); };
  double dt = 0.01;
  for (int k = 0; k < 60; ++k) {
    dt = control.next(0.0, 1e3);
    control.accepted(dt, change(dt));
  }
  EXPECT_GT(change(dt), 0.2);
  EXPECT_LT(change(dt), 0.6);
  control.accepted(dt, 4.0);  // suddenly hard: at most halved
  EXPECT_DOUBLE_EQ(control.next(0.0, 1e3), 0.5 * dt);
  for (int k = 0; k < 200; ++k) control.accepted(control.next(0.0, 1e3), 0.0);
  EXPECT_DOUBLE_EQ(control.next(0.0, 1e3), 0.05);  // dt_max
}

// Each sign of a coarse time step by itself; a flow without bodies knows of none.
// What a run was doing goes on after a restart: three of four good steps, then a fourth.
TEST(StepControl, ARestartGoesOnWithTheSameSteps) {
  const test::ScratchFolder folder;
  TimeOptions time;
  time.dt = 0.1, time.end = 100.0, time.adaptive = true;
  StepControl control(time);
  for (int k = 0; k < 7; ++k) control.accepted(control.next(0.0, 100.0), 1e-3);
  const Communicator comm(MPI_COMM_SELF);
  CheckpointWriter out(comm);
  control.save(out);
  const Checkpoint in(comm, out.save(folder.path() + "/", 1));
  StepControl next(time);
  next.restore(in);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(next.next(0.0, 100.0), control.next(0.0, 100.0));
    EXPECT_NE(next.next(0.0, 100.0), 0.1);
    next.accepted(next.next(0.0, 100.0), 1e-3), control.accepted(control.next(0.0, 100.0), 1e-3);
  }
  time.adaptive = false;  // now
  StepControl constant(time);
  constant.restore(in);
  EXPECT_EQ(constant.next(0.0, 100.0), 0.1);
  time.dt = 0.05;  // asked for anew
  StepControl other(time);
  other.restore(in);
  EXPECT_EQ(other.next(0.0, 100.0), 0.05);
}

TEST(StepRecords, WarnOfWhatWasSeenToBeWrong) {
  EXPECT_TRUE(warnings_of({.steps = 500, .rejected = 5, .largest_change = 0.6}).empty());
  EXPECT_TRUE(warnings_of({.steps = 5, .rejected = 3, .largest_change = 0.0}).empty());
  EXPECT_TRUE(warnings_of({.steps = 5, .largest_change = 0.1, .from_start = false}).empty());
  const auto only = [](const StepRecord& record) {
    const auto warnings = warnings_of(record);
    return warnings.size() == 1 ? warnings.front() : "none, or several";
  };
  EXPECT_NE(only({.steps = 50, .rejected = 0, .largest_change = 0.7}).find("0.7"), std::string::npos);
  EXPECT_EQ(only({.steps = 54, .rejected = 1, .largest_change = 0.2}).find("steps rejected: 1, accepted: 54"),
            0u);
  EXPECT_EQ(only({.steps = 10, .rejected = 0, .largest_change = 0.1}).find("only 10"), 0u);
}

}  // namespace
}  // namespace ifsi
