#pragma once
/// \file
/// A folder for the files of one test, deleted after it.

#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace ifsi::test {

/// Collective: the same folder on every rank of the communicator.
class ScratchFolder {
 public:
  explicit ScratchFolder(MPI_Comm comm = MPI_COMM_WORLD) : comm_(comm) {
    static int count = 0;
    int pid = static_cast<int>(getpid());
    MPI_Bcast(&pid, 1, MPI_INT, 0, comm_);
    path_ = std::filesystem::temp_directory_path() /
            ("ifsi_test_" + std::to_string(pid) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
    MPI_Barrier(comm_);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    MPI_Barrier(comm_);
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream stream(path_ / name, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }

 private:
  MPI_Comm comm_;
  std::filesystem::path path_;
};

}  // namespace ifsi::test
