#pragma once
/// \file

namespace ifsi::detail {

/// Thrown by Run::parse for the options that print and end; run_case takes it as success.
struct EndedByOption {};

}  // namespace ifsi::detail
