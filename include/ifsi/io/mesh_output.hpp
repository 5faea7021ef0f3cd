#pragma once
/// \file
/// From a distributed mesh and its nodal vectors to the grids VTK reads.

#include <string>
#include <utility>
#include <vector>

#include "ifsi/element/instantiate.hpp"
#include "ifsi/io/vtu.hpp"
#include "ifsi/mesh/mesh.hpp"

namespace ifsi {

/// The owned cells of this rank as a VTK grid: each cell of the mesh is in one piece only. Nodal values of
/// ghosts have to be up to date. A field handed over again takes the place of the earlier one.
template <class Element>
class MeshOutput {
 public:
  explicit MeshOutput(const Mesh<Element>& mesh);

  /// values[node * stride + first + c], c < components. Vectors in the plane get a third component 0.
  void node_field(const std::string& name, const std::string& unit, const double* values, int stride,
                  int first, int components);
  /// values[cell * components + c] of the owned cells.
  void cell_field(const std::string& name, const std::string& unit, const double* values, int components = 1);
  /// Moves the points by values[node * stride + c], c < dim, from where the mesh has them: a deformed body.
  void displace(const double* values, int stride);

  [[nodiscard]] const VtuPiece& piece() const { return piece_; }

 private:
  static constexpr int dim = Element::dim;
  static int padded(int components) { return components == 2 ? 3 : components; }
  static void put(std::vector<VtuField>& fields, VtuField field);

  const Mesh<Element>& mesh_;
  std::vector<int> points_;  // mesh point of each point of the grid
  VtuPiece piece_;
};

template <class Element>
MeshOutput<Element>::MeshOutput(const Mesh<Element>& mesh) : mesh_(mesh) {
  std::vector<long> number(mesh.points.size(), -1);
  for (int c = 0; c < mesh.n_owned_cells; ++c) {
    for (const int a : Element::vtk_order) {
      const int point = mesh.cell_points[c][a];
      if (number[point] < 0) {
        number[point] = static_cast<long>(points_.size());
        points_.push_back(point);
      }
      piece_.connectivity.push_back(number[point]);
    }
    piece_.offsets.push_back(static_cast<long>(piece_.connectivity.size()));
    piece_.types.push_back(static_cast<unsigned char>(Element::vtk_type));
  }
  for (const int point : points_)
    for (int i = 0; i < 3; ++i) piece_.points.push_back(i < dim ? mesh.points[point][i] : 0.0);
}

template <class Element>
void MeshOutput<Element>::put(std::vector<VtuField>& fields, VtuField field) {
  for (VtuField& f : fields)
    if (f.name == field.name) {
      f = std::move(field);
      return;
    }
  fields.push_back(std::move(field));
}

template <class Element>
void MeshOutput<Element>::node_field(const std::string& name, const std::string& unit, const double* values,
                                     int stride, int first, int components) {
  VtuField field{name, unit, padded(components), {}};
  field.values.reserve(points_.size() * static_cast<std::size_t>(field.components));
  for (const int point : points_) {
    const double* at_node = values + static_cast<long>(mesh_.point_node[point]) * stride + first;
    for (int c = 0; c < field.components; ++c) field.values.push_back(c < components ? at_node[c] : 0.0);
  }
  put(piece_.point_fields, std::move(field));
}

template <class Element>
void MeshOutput<Element>::cell_field(const std::string& name, const std::string& unit, const double* values,
                                     int components) {
  VtuField field{name, unit, padded(components), {}};
  for (long cell = 0; cell < mesh_.n_owned_cells; ++cell)
    for (int c = 0; c < field.components; ++c)
      field.values.push_back(c < components ? values[cell * components + c] : 0.0);
  put(piece_.cell_fields, std::move(field));
}

template <class Element>
void MeshOutput<Element>::displace(const double* values, int stride) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (int c = 0; c < dim; ++c)
      piece_.points[3 * i + c] =
          mesh_.points[points_[i]][c] + values[static_cast<long>(mesh_.point_node[points_[i]]) * stride + c];
}

// Compiled once for each element, in src/instantiate.
#define IFSI_MESH_OUTPUT(Element, external) external template class MeshOutput<Element>;
IFSI_FOR_EACH_CELL(IFSI_MESH_OUTPUT, extern)

}  // namespace ifsi
