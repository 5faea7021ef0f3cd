#pragma once
/// \file
/// From a name in a case file to a type.

#include <string>

#include "ifsi/core/error.hpp"

namespace ifsi {

/// Calls `f.template operator()<E>()` for the element of the list whose name it is.
/// \throws Error (configuration) naming the elements there are.
template <class... Elements, class F>
void dispatch_element(const std::string& name, F&& f) {
  const bool found = ((name == Elements::name && (f.template operator()<Elements>(), true)) || ...);
  if (found) return;
  std::string known;
  ((known += std::string(" ") + Elements::name), ...);
  throw Error(ExitCode::configuration,
              "element \"" + name + "\" is not offered here; expected one of" + known);
}

}  // namespace ifsi
