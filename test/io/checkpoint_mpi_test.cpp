// Checkpoints: the same values come back on any distribution, and a file that is not whole is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "expect_error.hpp"
#include "ifsi/io/checkpoint.hpp"
#include "ifsi/io/root.hpp"
#include "scratch_folder.hpp"

namespace ifsi {
namespace {

using test::expect_error;

constexpr long n_keys = 37;
double value_of(long key, int c) { return std::sin(static_cast<double>(3 * key + c)) / 3.0; }

/// Keys dealt out to the ranks in turn, from the last to the first.
std::vector<long> dealt_keys(const Communicator& comm) {
  std::vector<long> keys;
  for (long k = n_keys - 1; k >= 0; --k)
    if (k % comm.size() == comm.rank()) keys.push_back(k);
  return keys;
}

/// A contiguous range of keys per rank that overlaps the next one's.
std::vector<long> ranged_keys(const Communicator& comm) {
  std::vector<long> keys;
  const long first = n_keys * comm.rank() / comm.size(), last = n_keys * (comm.rank() + 1) / comm.size();
  for (long k = first; k < std::min(last + 2, n_keys); ++k) keys.push_back(k);
  return keys;
}

std::vector<double> values_of(const std::vector<long>& keys) {
  std::vector<double> values;
  for (const long k : keys)
    for (int c = 0; c < 3; ++c) values.push_back(value_of(k, c));
  return values;
}

class CheckpointTest : public testing::Test {
 protected:
  Communicator comm;
  test::ScratchFolder folder;

  std::string save(long step = 12) {
    const std::vector<long> keys = dealt_keys(comm);
    CheckpointWriter writer(comm);
    writer.number("t", 0.1);
    writer.text("case", "leaflet \n x");
    writer.array("v", values_of(keys).data(), 3, keys);
    writer.number("dt", 1.0 / 3.0);
    return writer.save(folder.path(), step);
  }
  /// Changes the file on rank 0 only.
  void rewrite(const std::string& file, const std::function<void(std::string&)>& change) {
    const std::string name = std::filesystem::path(file).filename();
    if (comm.is_root()) {
      std::string bytes = folder.read(name);
      change(bytes);
      folder.write(name, bytes);
    }
    comm.barrier();
  }
};

TEST_F(CheckpointTest, ReadsBackExactlyOnAnotherDistribution) {
  const Checkpoint checkpoint(comm, save());
  EXPECT_EQ(checkpoint.number("t"), 0.1);
  EXPECT_EQ(checkpoint.number("dt"), 1.0 / 3.0);
  EXPECT_EQ(checkpoint.text("case"), "leaflet \n x");
  EXPECT_TRUE(checkpoint.has("v"));
  EXPECT_FALSE(checkpoint.has("w"));
  const std::vector<long> keys = ranged_keys(comm);
  std::vector<double> values(3 * keys.size());
  checkpoint.array("v", values.data(), 3, keys);
  EXPECT_EQ(values, values_of(keys));
}

TEST_F(CheckpointTest, ReadsBackOnOneRank) {
  const std::string file = save();
  const Communicator self(MPI_COMM_SELF);
  const std::vector<long> keys = dealt_keys(self);
  std::vector<double> values(3 * keys.size());
  Checkpoint(self, file).array("v", values.data(), 3, keys);
  EXPECT_EQ(values, values_of(keys));
}

TEST_F(CheckpointTest, KeepsTheLastTwo) {
  for (const long step : {8, 9, 10, 11}) save(step);
  EXPECT_FALSE(folder.has("checkpoint_000000009.ifsi"));
  EXPECT_TRUE(folder.has("checkpoint_000000010.ifsi"));
  EXPECT_EQ(latest_checkpoint(folder.path()), folder.file("checkpoint_000000011.ifsi"));
  comm.barrier();
  save(7);  // the run was taken up again from an earlier checkpoint
  EXPECT_EQ(latest_checkpoint(folder.path()), folder.file("checkpoint_000000007.ifsi"));
}

TEST_F(CheckpointTest, NoCheckpoint) {
  expect_error([&] { static_cast<void>(latest_checkpoint(folder.path())); }, ExitCode::file,
               {"no checkpoint", folder.path()});
  expect_error([&] { Checkpoint(comm, folder.file("none")); }, ExitCode::file, {"none"});
}

TEST_F(CheckpointTest, EveryCutIsNoticed) {
  const std::string file = save();
  for (const std::size_t size : {0u, 5u, 12u, 17u, 60u, 200u}) {
    rewrite(file, [&](std::string& bytes) { bytes.resize(size); });
    expect_error([&] { Checkpoint(comm, file); }, ExitCode::file, {file, "cut short"});
    save();
  }
  rewrite(file, [](std::string& bytes) { bytes.pop_back(); });
  expect_error([&] { Checkpoint(comm, file); }, ExitCode::file, {"cut short"});
}

TEST_F(CheckpointTest, AFlippedBitIsNoticed) {
  const std::string file = save();
  rewrite(file, [](std::string& bytes) { bytes[bytes.size() / 2] ^= 4; });
  expect_error([&] { Checkpoint(comm, file); }, ExitCode::file, {file, "damaged"});
}

TEST_F(CheckpointTest, OtherFilesAreRefused) {
  const std::string file = save();
  rewrite(file, [](std::string& bytes) { bytes = std::string(200, 'x'); });
  expect_error([&] { Checkpoint(comm, file); }, ExitCode::file, {"no checkpoint"});
  save();
  rewrite(file, [](std::string& bytes) { bytes[12] = 2; });
  expect_error([&] { Checkpoint(comm, file); }, ExitCode::file, {"version 2", "expected 1"});
  save();
  rewrite(file, [](std::string& bytes) { std::swap(bytes[8], bytes[11]); });
  expect_error([&] { Checkpoint(comm, file); }, ExitCode::file, {"byte order"});
}

TEST_F(CheckpointTest, WrongRequestsAreRefused) {
  const Checkpoint checkpoint(comm, save());
  std::vector<double> values(100);
  expect_error([&] { static_cast<void>(checkpoint.number("dtt")); }, ExitCode::file,
               {"dtt", "did you mean 'dt'"});
  expect_error([&] { static_cast<void>(checkpoint.number("v")); }, ExitCode::file, {"'v'", "another kind"});
  expect_error([&] { checkpoint.array("v", values.data(), 2, {0}); }, ExitCode::file,
               {"3 values", "expected 2"});
  // only the last rank asks for an entry that is not there
  const long key = comm.rank() + 1 == comm.size() ? n_keys : 0;
  expect_error([&] { checkpoint.array("v", values.data(), 3, {key}); }, ExitCode::file,
               {"no entry 37", "mesh"});
}

TEST_F(CheckpointTest, EntriesNobodyFiledAreMissing) {
  CheckpointWriter writer(comm);
  const double x = 1.0;
  writer.array("sparse", &x, 1, comm.is_root() ? std::vector<long>{5} : std::vector<long>{});
  const Checkpoint checkpoint(comm, writer.save(folder.path(), 1));
  double y = 0.0;
  checkpoint.array("sparse", &y, 1, {5});
  EXPECT_EQ(y, 1.0);
  expect_error([&] { checkpoint.array("sparse", &y, 1, {4}); }, ExitCode::file, {"no entry 4"});
}

TEST_F(CheckpointTest, AStateWithNaNIsNotWritten) {
  CheckpointWriter writer(comm);
  const double x = std::nan("");
  expect_error([&] { writer.array("v", &x, 1, {comm.rank()}); }, ExitCode::invalid_state, {"'v'", "NaN"});
}

TEST(OnRoot, EveryRankThrowsWhatRankZeroThrew) {
  const Communicator comm;
  expect_error([&] { on_root(comm, [] { throw Error(ExitCode::nonlinear, "the reason"); }); },
               ExitCode::nonlinear, {"the reason"});
  expect_error([&] { on_root(comm, [] { throw std::logic_error("a bug"); }); }, ExitCode::configuration,
               {"a bug"});
  int calls = 0;
  on_root(comm, [&] { ++calls; });
  EXPECT_EQ(calls, comm.is_root() ? 1 : 0);
  EXPECT_EQ(broadcast(comm, comm.is_root() ? "text" : ""), "text");
}

}  // namespace
}  // namespace ifsi
