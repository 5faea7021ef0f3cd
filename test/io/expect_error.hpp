#pragma once
/// \file
/// Failures as a user meets them: the exit code, and what the message has to name.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"

namespace ifsi::test {

inline void expect_error(const std::function<void()>& action, ExitCode code,
                         const std::vector<std::string>& parts) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code) << e.what();
    for (const std::string& part : parts)
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos)
          << "'" << part << "' is not in: " << e.what();
    return;
  }
  ADD_FAILURE() << "no ifsi::Error was thrown";
}

}  // namespace ifsi::test
