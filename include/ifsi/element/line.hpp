#pragma once
/// \file
/// Lines on [-1,1]; as faces of 2D cells they have the cell on their left.
///
///     0 --- 1        0 --- 2 --- 1

#include "ifsi/element/point.hpp"
#include "ifsi/element/tensor_cell.hpp"

namespace ifsi {

namespace detail {
/// The two ends of a line.
struct LineFaces {
  using Face = Point1;
  static constexpr int n_faces = 2;
  static constexpr std::span<const int> face_nodes(int face) { return {&ends[face], 1}; }
  static constexpr Shape face_shape(int) { return Shape::point; }

 private:
  static constexpr std::array<int, 2> ends = {0, 1};
};
}  // namespace detail

struct Line1 : detail::TensorCell<1, 1>, detail::LineFaces {
  static constexpr Shape shape = Shape::line;
  static constexpr const char* name = "line1";
  static constexpr int vtk_type = 3;
  static constexpr int gmsh_type = 1;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();
};

struct Line2 : detail::TensorCell<1, 2>, detail::LineFaces {
  static constexpr Shape shape = Shape::line;
  static constexpr const char* name = "line2";
  static constexpr int vtk_type = 21;
  static constexpr int gmsh_type = 8;
  static constexpr auto vtk_order = detail::same_order<n_nodes>();
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();
};

static_assert(ReferenceElement<Line1> && ReferenceElement<Line2>);

}  // namespace ifsi
