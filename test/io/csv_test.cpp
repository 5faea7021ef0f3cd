// Tables over time: what a reader finds in the file while it grows, and after a restart.
#include "ifsi/io/csv.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "expect_error.hpp"
#include "scratch_folder.hpp"

namespace ifsi {
namespace {

const std::vector<Column> columns{{"t", "s"}, {"drag", "N"}};

TEST(CsvFile, EachRowIsInTheFileAtOnceAndExact) {
  const test::ScratchFolder folder;
  CsvFile csv(folder.file("a.csv"), columns);
  EXPECT_EQ(folder.read("a.csv"), "t [s],drag [N]\n");
  csv.row({0.1, 1.0 / 3.0});
  EXPECT_EQ(folder.read("a.csv"), "t [s],drag [N]\n0.1,0.3333333333333333\n");
}

TEST(CsvFile, ResumeKeepsRowsUpToTheRestart) {
  const test::ScratchFolder folder;
  folder.write("a.csv", "t [s],drag [N]\n0.1,1\n0.2,2\n0.30000000000000004,3\n0.4,4\n");
  CsvFile csv(folder.file("a.csv"), columns, 0.3);
  csv.row({0.35, 5});
  EXPECT_EQ(folder.read("a.csv"), "t [s],drag [N]\n0.1,1\n0.2,2\n0.30000000000000004,3\n0.35,5\n");
}

TEST(CsvFile, ResumeWithoutAnEarlierFileStartsOne) {
  const test::ScratchFolder folder;
  CsvFile csv(folder.file("a.csv"), columns, 0.3);
  EXPECT_EQ(folder.read("a.csv"), "t [s],drag [N]\n");
}

TEST(CsvFile, ResumeRefusesOtherColumns) {
  const test::ScratchFolder folder;
  folder.write("a.csv", "t [s],lift [N]\n0.1,1\n");
  test::expect_error([&] { CsvFile(folder.file("a.csv"), columns, 0.3); }, ExitCode::file,
                     {"a.csv:1", "lift [N]", "drag [N]"});
}

TEST(CsvFile, WrongNumberOfValuesIsAMistakeOfTheCaller) {
  const test::ScratchFolder folder;
  CsvFile csv(folder.file("a.csv"), columns);
  EXPECT_THROW(csv.row({1.0}), std::logic_error);
}

TEST(CsvFile, UnwritableFolder) {
  test::expect_error([] { CsvFile("/nonexistent/a.csv", columns); }, ExitCode::file, {"/nonexistent/a.csv"});
}

TEST(CsvFile, OtherRanksWriteNothing) {
  CsvFile csv;
  csv.row({1.0, 2.0, 3.0});
}

}  // namespace
}  // namespace ifsi
