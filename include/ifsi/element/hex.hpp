#pragma once
/// \file
/// Hexahedra on [-1,1]^3: trilinear (8 nodes) and triquadratic (27 nodes).
///
///           7 ------- 6      layers of the 27 nodes, seen from +z:
///          /|        /|
///         4 ------- 5 |      3 10  2      19 23 18      7 14  6
///         | |       | |     11 24  9      20 26 21     15 25 13
///     z   | 3 ------|-2      0  8  1      16 22 17      4 12  5
///     | y |/        |/
///     |/  0 ------- 1        z = -1       z = 0        z = 1
///     +-- x

#include "ifsi/element/quad.hpp"

namespace ifsi {

struct Hex1 : detail::TensorCell<3, 1> {
  static constexpr Shape shape = Shape::hex;
  static constexpr const char* name = "hex1";

  using Face = Quad1;
  static constexpr int n_faces = 6;
  /// Faces -x, +x, -y, +y, -z, +z.
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::quad; }

  static constexpr int vtk_type = 12;
  static constexpr int gmsh_type = 5;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();

 private:
  static constexpr std::array<std::array<int, 4>, 6> faces = {
      {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
};

struct Hex2 : detail::TensorCell<3, 2> {
  static constexpr Shape shape = Shape::hex;
  static constexpr const char* name = "hex2";

  using Face = Quad2;
  static constexpr int n_faces = 6;
  /// Faces -x, +x, -y, +y, -z, +z.
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::quad; }

  static constexpr int vtk_type = 29;
  static constexpr int gmsh_type = 12;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr std::array<int, n_nodes> gmsh_order = {
      0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26};

 private:
  static constexpr std::array<std::array<int, 9>, 6> faces = {{{0, 4, 7, 3, 16, 15, 19, 11, 20},
                                                               {1, 2, 6, 5, 9, 18, 13, 17, 21},
                                                               {0, 1, 5, 4, 8, 17, 12, 16, 22},
                                                               {3, 7, 6, 2, 19, 14, 18, 10, 23},
                                                               {0, 3, 2, 1, 11, 10, 9, 8, 24},
                                                               {4, 5, 6, 7, 12, 13, 14, 15, 25}}};
};

static_assert(ReferenceElement<Hex1> && ReferenceElement<Hex2>);

}  // namespace ifsi
