#pragma once
/// \file
/// Quadrilaterals on [-1,1]^2: bilinear (4 nodes) and biquadratic (9 nodes).
///
///     3 ----- 2      3 - 6 - 2
///     |       |      |       |
///     |       |      7   8   5
///     |       |      |       |
///     0 ----- 1      0 - 4 - 1

#include "ifsi/element/line.hpp"
#include "ifsi/element/tensor_cell.hpp"

namespace ifsi {

struct Quad1 : detail::TensorCell<2, 1> {
  static constexpr Shape shape = Shape::quad;
  static constexpr const char* name = "quad1";

  using Face = Line1;
  static constexpr int n_faces = 4;
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::line; }

  static constexpr int vtk_type = 9;
  static constexpr int gmsh_type = 3;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();

 private:
  static constexpr std::array<std::array<int, 2>, 4> faces = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
};

struct Quad2 : detail::TensorCell<2, 2> {
  static constexpr Shape shape = Shape::quad;
  static constexpr const char* name = "quad2";

  using Face = Line2;
  static constexpr int n_faces = 4;
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::line; }

  static constexpr int vtk_type = 28;
  static constexpr int gmsh_type = 10;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();

 private:
  static constexpr std::array<std::array<int, 3>, 4> faces = {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}};
};

static_assert(ReferenceElement<Quad1> && ReferenceElement<Quad2>);

}  // namespace ifsi
