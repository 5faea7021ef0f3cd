#pragma once
/// \file
/// Meshes written by Gmsh: formats 2.2 and 4.1, ASCII and binary.
///
/// Physical groups become boundaries and regions, by name (a group without a name is called by its number).
/// Exterior faces in no group form the boundary "default". Groups of faces inside the mesh are left out.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/element/instantiate.hpp"
#include "ifsi/mesh/check.hpp"
#include "ifsi/mesh/global_mesh.hpp"
#include "ifsi/mesh/gmsh_file.hpp"
#include "ifsi/mesh/reference_lattice.hpp"
#include "ifsi/mesh/topology.hpp"

namespace ifsi {

namespace detail {

/// Index of a physical group in names, added when new; -1 for tag 0.
inline int group_index(const GmshFile& file, int dim, int tag, std::vector<std::string>& names) {
  if (tag == 0) return -1;
  const auto named = file.group_names.find({dim, tag});
  const std::string name = named == file.group_names.end() ? std::to_string(tag) : named->second;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) names.push_back(name);
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Throws unless all elements of the mesh dimension are of type Element.
template <class Element>
void check_gmsh_types(const GmshFile& file) {
  std::string others;
  for (const auto& [type, elements] : file.elements)
    if (type != Element::gmsh_type && gmsh_type(type).dim >= Element::dim)
      others += (others.empty() ? "" : " and ") + std::to_string(elements.physical.size()) +
                " elements of type \"" + gmsh_type(type).name + "\"";
  if (!others.empty() || !file.elements.contains(Element::gmsh_type))
    throw Error(ExitCode::file, "found " + (others.empty() ? "no cells" : others) +
                                    "; expected cells of type \"" + gmsh_type(Element::gmsh_type).name +
                                    "\" (" + Element::name + ") only");
}

template <class Element>
GlobalMesh<Element> gmsh_cells(const GmshFile& file) {
  check_gmsh_types<Element>(file);
  GlobalMesh<Element> mesh;
  for (const auto& x : file.points) {
    auto& point = mesh.points.emplace_back();
    for (int d = 0; d < Element::dim; ++d) point[d] = x[d];
  }
  const auto& elements = file.elements.at(Element::gmsh_type);
  bool any_region = false;
  for (size_t e = 0; e < elements.physical.size(); ++e) {
    auto& cell = mesh.cells.emplace_back();
    for (int k = 0; k < Element::n_nodes; ++k)
      cell[Element::gmsh_order[k]] = elements.points[e * Element::n_nodes + k];
    mesh.cell_region.push_back(group_index(file, Element::dim, elements.physical[e], mesh.region_names));
    any_region |= mesh.cell_region.back() >= 0;
  }
  if (!any_region) mesh.cell_region.clear();
  return mesh;
}

/// A plane mesh must have one z for all points of its cells.
template <class Element>
void check_plane(const GmshFile& file, const GlobalMesh<Element>& mesh) {
  const auto height = [&](int p) {
    double z2 = 0;
    for (int d = Element::dim; d < 3; ++d)
      z2 += std::pow(file.points[p][d] - file.points[mesh.cells[0][0]][d], 2);
    return std::sqrt(z2);
  };
  double extent = 0;
  for (int p : mesh.cells[0])
    extent = std::max(extent, std::abs(mesh.points[p][0] - mesh.points[mesh.cells[0][0]][0]));
  for (const auto& cell : mesh.cells)
    for (int p : cell)
      if (height(p) > 1e-6 * extent)
        throw Error(ExitCode::file, "found a point at z = " + std::to_string(file.points[p][2]) +
                                        " in a plane mesh; expected all points in one plane z = const");
}

/// Boundary number of each grouped face, by its sorted vertices.
template <class Face, class Mesh>
void collect_faces(const GmshFile& file, Mesh& mesh, std::map<std::array<int, 4>, int>& boundary) {
  const auto found = file.elements.find(Face::gmsh_type);
  if (found == file.elements.end()) return;
  const auto& elements = found->second;
  for (size_t e = 0; e < elements.physical.size(); ++e) {
    std::array<int, 4> key{-1, -1, -1, -1};
    for (int k = 0; k < Face::n_nodes; ++k) {
      const int a = Face::gmsh_order[k];
      if (a < Face::n_vertices) key[a] = mesh.node(elements.points[e * Face::n_nodes + k]);
    }
    sort_key(key, Face::n_vertices);
    const int index = group_index(file, Face::dim, elements.physical[e], mesh.boundary_names);
    if (index >= 0) boundary.emplace(key, index);
  }
}

/// Keeps the names of boundaries that have faces, and renumbers.
template <class Element>
void drop_empty_boundaries(GlobalMesh<Element>& mesh) {
  std::vector<int> number(mesh.boundary_names.size(), -1);
  std::vector<std::string> names;
  for (auto& face : mesh.boundary_faces) number[face.boundary] = 0;
  for (size_t b = 0; b < number.size(); ++b)
    if (number[b] == 0) {
      number[b] = static_cast<int>(names.size());
      names.push_back(mesh.boundary_names[b]);
    }
  for (auto& face : mesh.boundary_faces) face.boundary = number[face.boundary];
  mesh.boundary_names = std::move(names);
}

template <class Element>
void gmsh_boundaries(const GmshFile& file, GlobalMesh<Element>& mesh) {
  std::map<std::array<int, 4>, int> boundary;
  collect_faces<typename Element::Face>(file, mesh, boundary);
  if constexpr (requires { typename Element::OtherFace; })
    collect_faces<typename Element::OtherFace>(file, mesh, boundary);
  mesh.boundary_names.push_back("default");
  const int unnamed = static_cast<int>(mesh.boundary_names.size()) - 1;
  for (const CellFace& face : exterior_faces(mesh)) {
    const auto found = boundary.find(face.key);
    mesh.boundary_faces.push_back(
        {face.cell, face.local_face, found == boundary.end() ? unnamed : found->second});
  }
  drop_empty_boundaries(mesh);
}

/// Nodes of points paired by the file, pairs of pairs (corners) included.
template <class Element>
void gmsh_periodic(const GmshFile& file, GlobalMesh<Element>& mesh) {
  if (file.periodic.empty())
    throw Error(ExitCode::file, "found no $Periodic section; expected one, as periodic nodes are asked for");
  mesh.point_node.resize(mesh.points.size());
  std::iota(mesh.point_node.begin(), mesh.point_node.end(), 0);
  const auto root = [&](int p) {
    while (mesh.point_node[p] != p) p = mesh.point_node[p];
    return p;
  };
  for (auto [copy, original] : file.periodic) {
    const int a = root(copy), b = root(original);
    mesh.point_node[std::max(a, b)] = std::min(a, b);
  }
  for (int p = 0; p < mesh.n_points(); ++p) mesh.point_node[p] = root(p);
}

/// Mirrors all cells when every one is inside-out.
template <class Element>
void turn_if_all_inverted(GlobalMesh<Element>& mesh) {
  std::array<Vec<double, Element::dim>, Element::n_nodes> dN;
  Element::gradients(Element::center, dN);
  for (int c = 0; c < mesh.n_cells(); ++c)
    if (!(det(jacobian(dN, mesh.cell_coordinates(c))) < 0)) return;
  std::array<int, Element::n_nodes> mirror;
  for (int a = 0; a < Element::n_nodes; ++a) {
    auto xi = Element::nodes[a];
    if constexpr (Element::dim > 1) std::swap(xi[0], xi[1]);
    if constexpr (Element::dim == 1) xi[0] = -xi[0];
    mirror[a] = find_node<Element>(xi);
  }
  for (auto& cell : mesh.cells) {
    const auto old = cell;
    for (int a = 0; a < Element::n_nodes; ++a) cell[a] = old[mirror[a]];
  }
}

}  // namespace detail

struct GmshOptions {
  bool periodic = false;  ///< identify the nodes that the file's $Periodic section pairs
};

/// Reads a mesh of one element type in the dimension of the element; in 2D it must lie in a plane z = const.
/// Cells that are all inside-out (a surface with reversed normal) are turned. Points that no cell uses are
/// dropped. Throws Error(file), naming the file, and in ASCII files the line, when the file is missing, cut
/// short, of another version, holds other cells than Element, or does not pass check().
template <class Element>
GlobalMesh<Element> read_gmsh(const std::string& path, const GmshOptions& options = {}) {
  const GmshFile file = read_gmsh_file(path);
  try {
    auto mesh = detail::gmsh_cells<Element>(file);
    detail::check_plane(file, mesh);
    if (options.periodic) detail::gmsh_periodic(file, mesh);
    detail::turn_if_all_inverted(mesh);
    detail::gmsh_boundaries(file, mesh);
    drop_unused_points(mesh);
    check(mesh);
    return mesh;
  } catch (const Error& error) {
    throw Error(error.code(), path + ": " + error.what());
  }
}

// Compiled once for each element, in src/instantiate.
#define IFSI_READ_GMSH(Element, external) \
  external template GlobalMesh<Element> read_gmsh(const std::string&, const GmshOptions&);
IFSI_FOR_EACH_CELL(IFSI_READ_GMSH, extern)

}  // namespace ifsi
