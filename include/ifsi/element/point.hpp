#pragma once
/// \file
/// The point: the face of a line.

#include "ifsi/element/element.hpp"

namespace ifsi {

struct Point1 {
  static constexpr int dim = 0;
  static constexpr int order = 1;
  static constexpr int n_vertices = 1;
  static constexpr int n_nodes = 1;
  static constexpr Shape shape = Shape::point;
  static constexpr const char* name = "point1";
  static constexpr bool linear = true;
  static constexpr Vec<double, 0> center{};
  static constexpr Mat<double, 0> metric{};
  static constexpr std::array<Vec<double, 0>, 1> nodes{};

  template <class T>
  static constexpr void shape_functions(const Vec<T, 0>&, std::array<T, 1>& N) {
    N[0] = T(1.0);
  }
  template <class T>
  static constexpr void gradients(const Vec<T, 0>&, std::array<Vec<T, 0>, 1>&) {}
  template <class T>
  static constexpr void hessians(const Vec<T, 0>&, std::array<Mat<T, 0>, 1>&) {}
  static constexpr double outside(const Vec<double, 0>&) { return 0.0; }
  static constexpr bool contains(const Vec<double, 0>&, double tolerance) { return tolerance >= 0.0; }

  using Face = Point1;
  static constexpr int n_faces = 0;
  static constexpr std::span<const int> face_nodes(int) { return {}; }
  static constexpr Shape face_shape(int) { return Shape::point; }

  static constexpr int vtk_type = 1;
  static constexpr int gmsh_type = 15;
  static constexpr std::array<int, 1> vtk_order{0};
  static constexpr std::array<int, 1> gmsh_order{0};
};

static_assert(ReferenceElement<Point1>);

}  // namespace ifsi
