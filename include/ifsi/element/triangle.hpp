#pragma once
/// \file
/// Triangles on { xi >= 0, eta >= 0, xi + eta <= 1 }.
///
///     2              2
///     | \            | \          .
///     |   \          5   4        .
///     |     \        |     \      .
///     0 ----- 1      0 - 3 - 1

#include "ifsi/element/line.hpp"
#include "ifsi/element/simplex.hpp"

namespace ifsi {

struct Tri1 : detail::Simplex<2, 1> {
  static constexpr Shape shape = Shape::triangle;
  static constexpr const char* name = "tri1";

  using Face = Line1;
  static constexpr int n_faces = 3;
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::line; }

  static constexpr int vtk_type = 5;
  static constexpr int gmsh_type = 2;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();

 private:
  static constexpr std::array<std::array<int, 2>, 3> faces = {{{0, 1}, {1, 2}, {2, 0}}};
};

struct Tri2 : detail::Simplex<2, 2> {
  static constexpr Shape shape = Shape::triangle;
  static constexpr const char* name = "tri2";

  using Face = Line2;
  static constexpr int n_faces = 3;
  static constexpr std::span<const int> face_nodes(int face) { return faces[face]; }
  static constexpr Shape face_shape(int) { return Shape::line; }

  static constexpr int vtk_type = 22;
  static constexpr int gmsh_type = 9;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();

 private:
  static constexpr std::array<std::array<int, 3>, 3> faces = {{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}};
};

static_assert(ReferenceElement<Tri1> && ReferenceElement<Tri2>);

}  // namespace ifsi
