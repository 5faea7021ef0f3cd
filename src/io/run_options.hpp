#pragma once
/// \file
/// Command line of a case; the only door to CLI11.

#include <optional>
#include <string>
#include <vector>

namespace ifsi::detail {

struct RunOptions {
  std::string config, out;
  std::vector<std::string> assignments;
  std::optional<std::string> restart;  ///< "" stands for the latest checkpoint in the output folder
  bool help = false, describe = false, params = false, print_config = false, check = false, verbose = false;
  std::string help_text;
};

/// Throws Error(configuration) for options that do not exist or lack their value.
RunOptions read_options(int argc, const char* const* argv, const std::string& name,
                        const std::string& description);

}  // namespace ifsi::detail
