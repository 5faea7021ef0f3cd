// Parameters: every kind of bad input ends with a message that names origin, value, and what was expected.
#include "ifsi/io/parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expect_error.hpp"
#include "ifsi/core/suggestion.hpp"
#include "scratch_folder.hpp"

namespace ifsi {
namespace {

using test::expect_error;

/// One key of every type.
struct Sample {
  double re = 40.0, dt = 0.1;
  int cells = 8;
  long steps = 100;
  bool steady = false;
  std::string method = "auto", title = "a \"quoted\" \\ title";
  std::vector<double> velocity{1.0, 0.5};
  Parameters params;

  Sample() {
    params.add("Re", re, "-", "Reynolds number", {1.0, 1e4});
    params.add("time.dt", dt, "s", "time step", positive);
    params.add("cells", cells, "-", "cells per side", {1});
    params.add("steps", steps, "-", "number of steps", non_negative);
    params.add("steady", steady, "-", "no time derivative");
    params.add_choice("linear.method", method, {"auto", "direct", "gmres"}, "linear solver");
    params.add("title", title, "-", "free text");
    params.add("velocity", velocity, "m/s", "at the inlet", {-10.0, 10.0});
  }
};

class ParametersFile : public testing::Test {
 protected:
  test::ScratchFolder folder;
  Sample s;
  std::string read(const std::string& text) {
    const std::string file = folder.write("case.toml", text);
    s.params.read_toml(file);
    return file;
  }
  void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { read(text); }, ExitCode::configuration, parts);
  }
};

TEST_F(ParametersFile, SetsEveryType) {
  read(
      "Re = 100\ncells = 16\nsteps = 5\nsteady = true\ntitle = 'x'\nvelocity = [1, -2.5]\n"
      "[time]\ndt = 1e-3\n[linear]\nmethod = 'gmres'\n");
  EXPECT_EQ(s.re, 100.0);
  EXPECT_EQ(s.dt, 1e-3);
  EXPECT_EQ(s.cells, 16);
  EXPECT_EQ(s.steps, 5);
  EXPECT_TRUE(s.steady);
  EXPECT_EQ(s.title, "x");
  EXPECT_EQ(s.method, "gmres");
  EXPECT_EQ(s.velocity, (std::vector<double>{1.0, -2.5}));
}

TEST_F(ParametersFile, UnknownKeyNamesLineAndNearestKey) {
  expect_refused("Re = 100\n\n[time]\ndtt = 0.1\n", {"case.toml:4", "'time.dtt'", "did you mean 'time.dt'"});
}
TEST_F(ParametersFile, WrongTypeNamesLineValueAndType) {
  expect_refused("Re = true\n", {"case.toml:1", "Re = true", "a number"});
  expect_refused("\ncells = 1.5\n", {"case.toml:2", "cells = 1.5", "an integer", ">= 1"});
  expect_refused("steady = 1\n", {"steady = 1", "true or false"});
  expect_refused("title = 3\n", {"title = 3", "a string"});
  expect_refused("velocity = 'fast'\n", {"velocity", "list of numbers", "m/s"});
  expect_refused("velocity = [1, 'a']\n", {"case.toml:1", "numbers only"});
  expect_refused("cells = 3000000000\n", {"cells = 3000000000", "an integer"});
  expect_refused("Re = 1979-05-27\n", {"case.toml:1", "dates"});
}
TEST_F(ParametersFile, OutOfRangeNamesValueAndRange) {
  expect_refused("Re = 0.5\n", {"case.toml:1", "Re = 0.5", "[1, 10000]"});
  expect_refused("time.dt = 0.0\n", {"time.dt = 0", "> 0", "unit: s"});
  expect_refused("velocity = [0, 11]\n", {"velocity = [0, 11]", "[-10, 10]"});
  EXPECT_EQ(s.re, 40.0) << "a refused value must not stay";
  EXPECT_EQ(s.velocity, (std::vector<double>{1.0, 0.5}));
}
TEST_F(ParametersFile, NotANumberIsRefused) {
  expect_refused("Re = nan\n", {"case.toml:1", "Re = nan", "finite"});
  expect_refused("time.dt = inf\n", {"time.dt = inf", "finite"});
  expect_refused("velocity = [nan, 0]\n", {"velocity", "finite"});
}
TEST_F(ParametersFile, WrongChoiceNamesTheChoices) {
  expect_refused("linear.method = 'dirct'\n", {"dirct", "did you mean 'direct'", "auto, direct, gmres"});
  EXPECT_EQ(s.method, "auto");
}
TEST_F(ParametersFile, SyntaxErrorNamesLine) {
  expect_refused("Re = 3\nx = = 2\n", {"case.toml:2", "not valid TOML"});
}
TEST_F(ParametersFile, MissingFile) {
  expect_error([&] { s.params.read_toml(folder.file("none.toml")); }, ExitCode::file, {"none.toml", "TOML"});
  expect_error([&] { s.params.read_toml(folder.path()); }, ExitCode::file, {folder.path()});
}

TEST_F(ParametersFile, PresetWinsOverFileAndCommandLineOverBoth) {
  const std::string file = folder.write("case.toml",
                                        "Re = 10\ncells = 4\nsteps = 7\npreset = 'fine'\n"
                                        "[presets.fine]\ncells = 64\ntime.dt = 0.01\nRe = 20\n"
                                        "[presets.2D-1]\ncells = 2\n");
  s.params.load(file, {"Re=30"});
  EXPECT_EQ(s.cells, 64);
  EXPECT_EQ(s.dt, 0.01);
  EXPECT_EQ(s.re, 30.0);
  EXPECT_EQ(s.steps, 7);
  Sample other;
  other.params.load(file, {"preset=2D-1"});
  EXPECT_EQ(other.cells, 2);
  EXPECT_EQ(other.re, 10.0);
  expect_error([&] { Sample().params.load(file, {"preset=finer"}); }, ExitCode::configuration,
               {"finer", "did you mean 'fine'"});
}
TEST_F(ParametersFile, PresetsAreCheckedEvenWhenNotPicked) {
  expect_refused("[presets.a]\ncels = 3\n", {"case.toml:2", "did you mean 'cells'"});
  expect_refused("[presets]\na = 3\n", {"case.toml:2", "[presets.<name>]"});
}

TEST_F(ParametersFile, WrittenValuesReadBackTheSame) {
  s.re = 1.0 / 3.0 + 1.0;
  s.velocity = {1e-17, -0.1};
  const std::string text = s.params.to_toml();
  const std::string title = s.title;
  s.re = 2.0;
  s.velocity = {};
  s.title = "";
  read(text);
  EXPECT_EQ(s.re, 1.0 / 3.0 + 1.0);
  EXPECT_EQ(s.velocity, (std::vector<double>{1e-17, -0.1}));
  EXPECT_EQ(s.title, title);
}

TEST(ParametersSet, ReadsTextAsTheTypeOfTheKey) {
  Sample s;
  for (const char* a :
       {"Re=1e2", " cells = +3 ", "steady=true", "title=a=b", "velocity=1,2", "linear.method=direct"})
    s.params.set(a);
  EXPECT_EQ(s.re, 100.0);
  EXPECT_EQ(s.cells, 3);
  EXPECT_TRUE(s.steady);
  EXPECT_EQ(s.title, "a=b");
  EXPECT_EQ(s.velocity, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(s.method, "direct");
  s.params.set("velocity=[3.5]");
  EXPECT_EQ(s.velocity, (std::vector<double>{3.5}));
  s.params.set("title=\"4\"");
  EXPECT_EQ(s.title, "4");
}

TEST(ParametersSet, RefusesWithTheSameCare) {
  Sample s;
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    expect_error([&] { s.params.set(text); }, ExitCode::configuration, parts);
  };
  refused("Re", {"--set", "'Re'", "key=value"});
  refused("=3", {"key=value"});
  refused("time.dtt=3", {"--set", "did you mean 'time.dt'"});
  refused("Re=abc", {"--set: Re = \"abc\"", "a number"});
  refused("Re=12x", {"a number"});
  refused("cells=1.5", {"an integer"});
  refused("cells=99999999999", {"an integer"});
  refused("steady=yes", {"true or false"});
  refused("velocity=1,,2", {"list of numbers"});
  refused("Re=nan", {"finite"});
}

TEST(ParametersTable, NamesKeyDefaultUnitRangeAndHelp) {
  const std::string table = Sample().params.table();
  for (const char* part :
       {"time.dt", "0.1", "> 0", "time step", "[1, 10000]", "auto | direct | gmres", "m/s"})
    EXPECT_NE(table.find(part), std::string::npos) << part;
}

TEST(ParametersDeclaration, TheSameKeyTwiceIsAMistakeOfTheDriver) {
  Sample s;
  EXPECT_THROW(s.params.add("Re", s.re, "-", "again"), std::logic_error);
}

TEST(Bounds, OpenEndsAreExcluded) {
  EXPECT_FALSE(positive.contain(0.0));
  EXPECT_TRUE(non_negative.contain(0.0));
  const Bounds half_open{0.0, 1.0, false, true};
  EXPECT_TRUE(half_open.contain(0.0));
  EXPECT_FALSE(half_open.contain(1.0));
  EXPECT_FALSE(half_open.contain(std::nan("")));
}

TEST(Suggestion, NearestNameOrNone) {
  const std::vector<std::string> names{"inlet", "outlet", "walls"};
  EXPECT_EQ(nearest_name("Inlet", names), "inlet");
  EXPECT_EQ(nearest_name("outlte", names), "outlet");
  EXPECT_EQ(nearest_name("cylinder", names), "");
  EXPECT_EQ(suggestion("wall", names), "; did you mean 'walls'? there are: inlet, outlet, walls");
  EXPECT_EQ(suggestion("x", {}), "; there are none");
}

}  // namespace
}  // namespace ifsi
