#include "ifsi/io/run_gmsh.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "io/expect_error.hpp"
#include "io/scratch_folder.hpp"

namespace ifsi {
namespace {

using test::expect_error;
using test::ScratchFolder;

/// A PATH of one folder, whose `gmsh` is a script of the test or missing.
class RunGmsh : public testing::Test {
 protected:
  RunGmsh() : old_path_(std::getenv("PATH")) {
    std::filesystem::create_directory(folder_.file("bin"));
    setenv("PATH", folder_.file("bin").c_str(), 1);
    script_ = folder_.write("box.geo", "a script");
  }
  ~RunGmsh() override { setenv("PATH", old_path_.c_str(), 1); }
  void install(const std::string& body) {
    const std::string file = folder_.write("bin/gmsh", "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  std::string run(double h) { return run_gmsh(Communicator(), script_, {{"h", h}}, folder_.path()); }

  ScratchFolder folder_;
  std::string old_path_, script_;
};

TEST_F(RunGmsh, SaysHowToGetIt) {
  expect_error([&] { run(0.1); }, ExitCode::configuration, {"gmsh", "apt-get install gmsh"});
}

TEST_F(RunGmsh, IsGivenTheNumbersAndKeepsTheMesh) {
  install("echo \"$*\" >$4; echo made >>" + folder_.file("calls"));
  const std::string mesh = run(0.125);
  EXPECT_NE(folder_.read(std::filesystem::path(mesh).filename()).find("-setnumber h 0.125"),
            std::string::npos);
  EXPECT_EQ(run(0.125), mesh);
  EXPECT_EQ(folder_.read("calls"), "made\n");
  EXPECT_NE(run(0.25), mesh);
  EXPECT_EQ(folder_.read("calls"), "made\nmade\n");
  folder_.write("box.geo", "another script");
  EXPECT_NE(run(0.125), mesh);
}

TEST_F(RunGmsh, NamesWhatFailed) {
  install("echo wrong; exit 1");
  expect_error([&] { run(0.1); }, ExitCode::file, {"box.geo", "gmsh.log"});
  EXPECT_EQ(folder_.read("gmsh.log"), "wrong\n");
  install("exit 0");  // says it is well, but made nothing
  expect_error([&] { run(0.1); }, ExitCode::file, {"made no mesh"});
  script_ = "nowhere.geo";
  expect_error([&] { run(0.1); }, ExitCode::file, {"nowhere.geo", "cannot be read"});
}

}  // namespace
}  // namespace ifsi
