#include "ifsi/io/run_gmsh.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "ifsi/core/error.hpp"
#include "ifsi/io/root.hpp"

namespace ifsi {

namespace {

std::string read_text(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw Error(ExitCode::file, path + ": cannot be read; expected a Gmsh script");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

/// FNV-1a, 64 bits: names a mesh by all that it depends on.
std::string hash(const std::string& text) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const unsigned char c : text) h = (h ^ c) * 0x100000001b3u;
  char name[17];
  std::snprintf(name, sizeof name, "%016llx", static_cast<unsigned long long>(h));
  return name;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (auto& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

/// This process's environment without what would make a Gmsh built with MPI join our ranks.
std::vector<std::string> serial_environment() {
  std::vector<std::string> words;
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::strncmp(*variable, "OMPI_", 5) != 0 && std::strncmp(*variable, "PMIX_", 5) != 0)
      words.emplace_back(*variable);
  return words;
}

/// Runs a program found in PATH, its output going to a file. \return its exit status as waitpid has it.
int run_program(std::vector<std::string> words, const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  auto environment = serial_environment();
  pid_t child = 0;
  const int code = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, pointers(words).data(),
                                pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (code != 0)
    throw Error(ExitCode::configuration, words[0] + " cannot be started (" + std::strerror(code) +
                                             "); expected it in PATH: apt-get install gmsh");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

void make_mesh(const std::string& script, const GmshNumbers& numbers, const std::string& folder,
               const std::string& mesh) {
  const std::string part = mesh + ".part.msh", log = folder + "/gmsh.log";
  std::vector<std::string> words = {"gmsh", script, "-3", "-o", part};
  for (const auto& [name, value] : numbers) words.insert(words.end(), {"-setnumber", name, digits(value)});
  const int status = run_program(words, log);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !std::filesystem::exists(part))
    throw Error(ExitCode::file, script + ": Gmsh made no mesh of it; its messages are in " + log);
  std::filesystem::rename(part, mesh);  // a mesh that is there is complete
}

}  // namespace

std::string run_gmsh(const Communicator& comm, const std::string& script, const GmshNumbers& numbers,
                     const std::string& folder) {
  std::string mesh;
  on_root(comm, [&] {
    std::string key = read_text(script);
    for (const auto& [name, value] : numbers) key += "\n" + name + " " + digits(value);
    mesh = folder + "/" + std::filesystem::path(script).stem().string() + "_" + hash(key) + ".msh";
    if (!std::filesystem::exists(mesh)) make_mesh(script, numbers, folder, mesh);
  });
  return broadcast(comm, mesh);
}

}  // namespace ifsi
