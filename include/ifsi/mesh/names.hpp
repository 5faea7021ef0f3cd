#pragma once
/// \file
/// Looking things up by name, with a helpful answer when the name is wrong.

#include <string>
#include <vector>

namespace ifsi {

/// Index of name among names. Throws Error(configuration) that quotes the name, lists those there are and
/// suggests the nearest. \param kind what is looked up: "boundary", "region".
int find_name(const std::string& kind, const std::string& name, const std::vector<std::string>& names);

}  // namespace ifsi
