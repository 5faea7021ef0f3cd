#pragma once
/// \file
/// Meshes made by Gmsh at run time, from a script and numbers.

#include <string>
#include <utility>
#include <vector>

#include "ifsi/core/communicator.hpp"

namespace ifsi {

/// Names and values of a script's constants, its -setnumber options.
using GmshNumbers = std::vector<std::pair<std::string, double>>;

/// Collective. Makes the mesh of a script in space on rank 0, unless `folder` holds the one of the same
/// script and numbers from an earlier run. What Gmsh says goes to gmsh.log in that folder.
/// \return the mesh file. \throws Error (configuration) when there is no Gmsh; (file) when the script cannot
/// be read or Gmsh fails.
std::string run_gmsh(const Communicator& comm, const std::string& script, const GmshNumbers& numbers,
                     const std::string& folder);

}  // namespace ifsi
