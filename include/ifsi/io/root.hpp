#pragma once
/// \file
/// Work that one rank does for all.

#include <functional>
#include <string>

#include "ifsi/core/communicator.hpp"

namespace ifsi {

/// Collective. Runs `work` on rank 0; when it throws, every rank throws an Error with its code and message.
void on_root(const Communicator& comm, const std::function<void()>& work);

/// Collective. The text of rank 0, on every rank.
[[nodiscard]] std::string broadcast(const Communicator& comm, std::string text);

}  // namespace ifsi
