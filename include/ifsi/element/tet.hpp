#pragma once
/// \file
/// Tetrahedra on the unit simplex: vertices 0 at the origin, 1, 2, 3 on the axes; mid nodes of the edges
/// 4 = (0,1), 5 = (1,2), 6 = (2,0), 7 = (0,3), 8 = (1,3), 9 = (2,3).

#include "ifsi/element/triangle.hpp"

namespace ifsi {

struct Tet1 : detail::Simplex<3, 1> {
  static constexpr Shape shape = Shape::tet;
  static constexpr const char* name = "tet1";

  using Face = Tri1;
  static constexpr int n_faces = 4;
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::triangle; }

  static constexpr int vtk_type = 10;
  static constexpr int gmsh_type = 4;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();

 private:
  static constexpr std::array<std::array<int, 3>, 4> faces = {{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}};
};

struct Tet2 : detail::Simplex<3, 2> {
  static constexpr Shape shape = Shape::tet;
  static constexpr const char* name = "tet2";

  using Face = Tri2;
  static constexpr int n_faces = 4;
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::triangle; }

  static constexpr int vtk_type = 24;
  static constexpr int gmsh_type = 11;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  /// Gmsh numbers the last two edges (2,3), (1,3).
  static constexpr std::array<int, n_nodes> gmsh_order = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

 private:
  static constexpr std::array<std::array<int, 6>, 4> faces = {
      {{0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}, {0, 2, 1, 6, 5, 4}}};
};

static_assert(ReferenceElement<Tet1> && ReferenceElement<Tet2>);

}  // namespace ifsi
