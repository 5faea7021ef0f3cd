#pragma once
/// \file
/// The linear wedge: unit triangle x [-1,1]; vertices 0, 1, 2 at zeta = -1, then 3, 4, 5 above them.

#include "ifsi/element/quad.hpp"
#include "ifsi/element/triangle.hpp"

namespace ifsi {

struct Wedge1 {
  static constexpr int dim = 3;
  static constexpr int order = 1;
  static constexpr int n_vertices = 6;
  static constexpr int n_nodes = 6;
  static constexpr Shape shape = Shape::wedge;
  static constexpr const char* name = "wedge1";
  static constexpr bool linear = false;
  static constexpr Vec<double, 3> center = {1.0 / 3.0, 1.0 / 3.0, 0.0};
  static constexpr Mat<double, 3> metric = {4, 2, 0, 2, 4, 0, 0, 0, 1};
  static constexpr std::array<Vec<double, 3>, 6> nodes = {
      {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};

  template <class T>
  static constexpr void shape_functions(const Vec<T, 3>& xi, std::array<T, 6>& N) {
    const Factors<T> f(xi);
    for (int a = 0; a < 6; ++a) N[a] = f.tri[a % 3] * f.line[a / 3];
  }

  template <class T>
  static constexpr void gradients(const Vec<T, 3>& xi, std::array<Vec<T, 3>, 6>& dN) {
    const Factors<T> f(xi);
    for (int a = 0; a < 6; ++a) {
      for (int i = 0; i < 2; ++i) dN[a][i] = f.d_tri[a % 3][i] * f.line[a / 3];
      dN[a][2] = f.tri[a % 3] * d_line(a);
    }
  }

  template <class T>
  static constexpr void hessians(const Vec<T, 3>& xi, std::array<Mat<T, 3>, 6>& ddN) {
    const Factors<T> f(xi);
    for (int a = 0; a < 6; ++a) {
      ddN[a] = Mat<T, 3>::zero();
      for (int i = 0; i < 2; ++i) ddN[a](i, 2) = ddN[a](2, i) = f.d_tri[a % 3][i] * d_line(a);
    }
  }

  /// Largest excess over the triangle's and the line's bounds: positive outside, negative inside.
  static constexpr double outside(const Vec<double, 3>& xi) {
    const double in_plane = Tri1::outside({xi[0], xi[1]});
    const double along = Line1::outside({xi[2]});
    return in_plane <= along ? along : along <= in_plane ? in_plane : along + in_plane;  // NaN stays NaN
  }
  /// Whether xi lies in the cell grown by tolerance; a NaN lies nowhere.
  static constexpr bool contains(const Vec<double, 3>& xi, double tolerance) {
    return outside(xi) <= tolerance;
  }

  using Face = Quad1;
  using OtherFace = Tri1;
  static constexpr int n_faces = 5;
  /// Faces 0 and 1 are the triangles below and above, 2 to 4 the quads over the edges (0,1), (1,2), (2,0).
  static constexpr std::span<const int> face_nodes(int face) {
    return {faces[face].data(), face < 2 ? 3u : 4u};
  }
  static constexpr Shape face_shape(int face) { return face < 2 ? Shape::triangle : Shape::quad; }

  static constexpr int vtk_type = 13;
  static constexpr int gmsh_type = 6;
  /// The triangle (0,1,2) of a VTK wedge turns outwards, ours inwards.
  static constexpr std::array<int, 6> vtk_order = {0, 2, 1, 3, 5, 4};
  static constexpr auto gmsh_order = detail::same_order<n_nodes>();

 private:
  template <class T>
  struct Factors {
    std::array<T, 3> tri{};
    std::array<Vec<T, 2>, 3> d_tri{};
    std::array<T, 2> line{};
    explicit constexpr Factors(const Vec<T, 3>& xi) {
      Tri1::shape_functions(Vec<T, 2>{xi[0], xi[1]}, tri);
      Tri1::gradients(Vec<T, 2>{xi[0], xi[1]}, d_tri);
      Line1::shape_functions(Vec<T, 1>{xi[2]}, line);
    }
  };
  static constexpr double d_line(int a) { return a < 3 ? -0.5 : 0.5; }

  static constexpr std::array<std::array<int, 4>, 5> faces = {
      {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
};

static_assert(ReferenceElement<Wedge1>);

}  // namespace ifsi
