#include "ifsi/simulation/flow_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/expect_error.hpp"
#include "io/scratch_folder.hpp"

namespace ifsi {
namespace {

using test::expect_error;
using test::ScratchFolder;

TEST(FlowCurve, IsSmoothThroughItsPointsAndRestsWhereTheyRest) {
  const ScratchFolder folder;
  const FlowCurve curve(folder.write("q.csv", "# comment\nt [s],q\n0,0\n1,0\n2,3\n3,4\n4,4\n"));
  for (const auto& [t, q] : {std::pair{0.0, 0.0},
                             {1.0, 0.0},
                             {2.0, 3.0},
                             {3.0, 4.0},
                             {4.0, 4.0},
                             {0.5, 0.0},
                             {3.5, 4.0},
                             {-1.0, 0.0},
                             {9.0, 4.0}})
    EXPECT_NEAR(curve(t), q, 1e-14) << t;
  for (double t : {1.0, 2.0, 3.0})  // no kink: slopes from both sides agree
    EXPECT_NEAR((curve(t + 1e-6) - curve(t)) / 1e-6, (curve(t) - curve(t - 1e-6)) / 1e-6, 1e-4) << t;
  EXPECT_EQ(curve.max(), 4.0);
}

TEST(FlowCurve, TheBeatOfTheCaseHasTheVolumesItsFileStates) {
  const FlowCurve curve(IFSI_DATA_DIR "/curves/aortic_flow.csv");
  EXPECT_NEAR(curve.volumes().forward, 72.7, 0.05);
  EXPECT_NEAR(curve.volumes().backward, 3.03, 0.01);
  EXPECT_EQ(curve.max(), 390.0);
  EXPECT_EQ(curve(0.0), 0.0);
  EXPECT_EQ(curve(0.7), 0.0);
}

TEST(FlowCurve, RefusesBadFilesNamingTheLine) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& rows, const std::vector<std::string>& parts) {
    const std::string file = folder.write("q.csv", "# a comment\nt,q\n" + rows);
    expect_error([&] { FlowCurve curve(file); }, ExitCode::file, parts);
  };
  refused("0,0\n0.2,1\n0.1,2\n", {"q.csv:5", "time 0.1", "ascending"});
  refused("0,0\n0.1,1\n0.1,2\n", {"q.csv:5", "ascending"});
  refused("0,0\n0.1,1\n0.9,2\n", {"q.csv:5", "gap", "0.8"});
  refused("0,0\n0.1,\n0.2,2\n", {"q.csv:4", "finite number in column 2"});
  refused("0,0\n0.1,nan\n0.2,2\n", {"q.csv:4", "finite number in column 2"});
  refused("0,0\nsoon,1\n", {"q.csv:4", "column 1"});
  refused("0,0\n", {"1 points", "at least 2"});
  expect_error([] { FlowCurve curve("nowhere.csv"); }, ExitCode::file, {"nowhere.csv", "cannot be read"});
}

}  // namespace
}  // namespace ifsi
