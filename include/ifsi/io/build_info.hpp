#pragma once
/// \file
/// What this build is and where it runs.

#include <string>

namespace ifsi {

struct BuildInfo {
  std::string version;  ///< of the project
  std::string commit;   ///< git commit, with "-dirty" when files differ from it; "unknown" outside a git tree
  std::string compiler;  ///< name and version
  std::string flags;     ///< build type and compiler flags
};

[[nodiscard]] const BuildInfo& build_info();
/// Model name of the processor, "unknown" when the system does not tell.
[[nodiscard]] std::string processor_name();

}  // namespace ifsi
