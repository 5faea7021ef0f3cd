#pragma once
/// \file
/// Files that are either wholly there or not at all.

#include <string>

namespace ifsi::detail {

/// Writes beside the file, syncs and renames. Throws Error(file).
void write_atomically(const std::string& file, const std::string& bytes);

}  // namespace ifsi::detail
