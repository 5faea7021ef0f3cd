#pragma once
/// \file
/// Failures a user can meet, each with the exit code of its kind.

#include <stdexcept>
#include <string>

namespace ifsi {

/// Exit codes of every ifsi program.
enum class ExitCode : int {
  ok = 0,
  configuration = 1,  ///< usage, parameter or set-up that makes no sense
  file = 2,           ///< mesh or file missing, unreadable or wrong
  linear_solver = 3,  ///< GMRES, AMG or a factorisation gave up
  nonlinear = 4,      ///< Newton failed, or dt fell below its minimum
  invalid_state = 5,  ///< NaN, inverted element
  stopped = 6,        ///< signal or STOP file, after a checkpoint
  check_failed = 7    ///< the run finished, but a figure missed its reference
};

/// A failure with a diagnosis: the message says what was found, where, and what was expected.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

}  // namespace ifsi
