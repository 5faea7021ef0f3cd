#pragma once
/// \file
/// Help for a user who misspelt a name.

#include <string>
#include <vector>

namespace ifsi {

/// The candidate nearest to `name` by edit distance (case ignored), or "" when none is near enough to be
/// meant.
[[nodiscard]] std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

/// End of a message about an unknown name: "; did you mean 'inlet'? there are: inlet, outlet".
[[nodiscard]] std::string suggestion(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace ifsi
