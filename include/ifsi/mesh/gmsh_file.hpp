#pragma once
/// \file
/// What a Gmsh MSH file holds, before it is known which element type is wanted.

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// Contents of an MSH file of version 2.2 or 4.1.
struct GmshFile {
  struct Elements {
    std::vector<int> points;    ///< indices into GmshFile::points, those of one element side by side
    std::vector<int> physical;  ///< physical tag per element, the first if it has several, 0 if none
  };
  std::vector<Vec<double, 3>> points;
  std::map<int, Elements> elements;                        ///< by Gmsh element type
  std::map<std::pair<int, int>, std::string> group_names;  ///< (dimension, physical tag) -> name
  std::vector<std::array<int, 2>> periodic;                ///< point, and the point it is a copy of
};

/// Reads a file. Throws Error(file) naming the file and the place in it, what was found and what was
/// expected.
GmshFile read_gmsh_file(const std::string& path);

/// Dimension and name of a Gmsh element type, "triangle of 3 nodes" say; dimension -1 when not known.
struct GmshType {
  int dim;
  int n_nodes;
  std::string name;
};
GmshType gmsh_type(int type);

}  // namespace ifsi
