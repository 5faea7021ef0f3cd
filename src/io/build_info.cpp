#include "ifsi/io/build_info.hpp"

#include <fstream>

#include "ifsi_commit.hpp"

namespace ifsi {

const BuildInfo& build_info() {
  static const BuildInfo info{IFSI_VERSION, IFSI_COMMIT, IFSI_COMPILER, IFSI_FLAGS};
  return info;
}

std::string processor_name() {
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace ifsi
