#pragma once
/// \file
/// The isoparametric map x(xi) = sum_a N_a(xi) X_a: what kernels need of it at a point.
///
/// Tables of shape functions (number type S, usually double) meet nodal coordinates (number type T: double,
/// or a pack of cells). J_ij = dx_i / dxi_j has d rows (space) and rd columns (reference cell); rd = d - 1 on
/// faces.

#include <cstddef>

#include "ifsi/element/element.hpp"

namespace ifsi {

/// sum_a N_a X_a of nodal values X_a: scalars, vectors or tensors.
template <class S, class V, std::size_t n>
constexpr V interpolate(const std::array<S, n>& N, const std::array<V, n>& X) {
  V x = N[0] * X[0];
  for (std::size_t a = 1; a < n; ++a) x += N[a] * X[a];
  return x;
}

/// Position x(xi) in the cell with nodes X.
template <ReferenceElement E, class S, class T, int d>
constexpr Vec<T, d> map(const Vec<S, E::dim>& xi, const std::array<Vec<T, d>, E::n_nodes>& X) {
  std::array<S, E::n_nodes> N{};
  E::shape_functions(xi, N);
  return interpolate(N, X);
}

/// Jacobian J_ij = sum_a X_a,i dN_a/dxi_j.
template <class S, class T, int d, int rd, std::size_t n>
constexpr Mat<T, d, rd> jacobian(const std::array<Vec<S, rd>, n>& dN, const std::array<Vec<T, d>, n>& X) {
  Mat<T, d, rd> J = Mat<T, d, rd>::zero();
  for (std::size_t a = 0; a < n; ++a) {
    IFSI_UNROLL
    for (int i = 0; i < d; ++i) {
      IFSI_UNROLL
      for (int j = 0; j < rd; ++j) J(i, j) += dN[a][j] * X[a][i];
    }
  }
  return J;
}

/// Gradients dN_a/dx_i = sum_j dN_a/dxi_j J^-1_ji.
template <class S, class T, int d, std::size_t n>
constexpr std::array<Vec<T, d>, n> physical_gradients(const std::array<Vec<S, d>, n>& dN,
                                                      const Mat<T, d>& J_inverse) {
  std::array<Vec<T, d>, n> grad_N;
  for (std::size_t a = 0; a < n; ++a) {
    IFSI_UNROLL
    for (int i = 0; i < d; ++i) {
      grad_N[a][i] = dN[a][0] * J_inverse(0, i);
      IFSI_UNROLL
      for (int j = 1; j < d; ++j) grad_N[a][i] += dN[a][j] * J_inverse(j, i);
    }
  }
  return grad_N;
}

/// Laplacians of N_a in x, with the curvature of the cell: since xi(x) bends,
/// lap N_a = C : (H_a - sum_i dN_a/dx_i H_x_i), C = J^-1 J^-T, H = second derivatives in xi, H_x_i = sum_b
/// X_b,i H_b. \tparam zero_diagonal true for elements of order one, where d2N/dxi_k^2 = 0.
template <bool zero_diagonal = false, class S, class T, int d, std::size_t n>
constexpr std::array<T, n> physical_laplacians(const std::array<Mat<S, d>, n>& ddN,
                                               const std::array<Vec<T, d>, n>& grad_N,
                                               const std::array<Vec<T, d>, n>& X,
                                               const Mat<T, d>& J_inverse) {
  const Mat<T, d> C = J_inverse * transpose(J_inverse), C_twice = 2.0 * C;
  std::array<T, n> lap_N;
  Vec<T, d> lap_x = Vec<T, d>::zero();
  for (std::size_t a = 0; a < n; ++a) {
    lap_N[a] = T(0.0);
    IFSI_UNROLL
    for (int k = 0; k < d; ++k) {
      if constexpr (!zero_diagonal) lap_N[a] += ddN[a](k, k) * C(k, k);
      IFSI_UNROLL
      for (int l = k + 1; l < d; ++l) lap_N[a] += ddN[a](k, l) * C_twice(k, l);
    }
    lap_x += lap_N[a] * X[a];
  }
  for (std::size_t a = 0; a < n; ++a) lap_N[a] -= dot(grad_N[a], lap_x);
  return lap_N;
}

/// Metric G = J^-T M J^-1 of the stabilisation, M the metric of the parent cell: on a regular cell of edge h
/// it is 4/h^2 times the identity, whatever the parent.
template <ReferenceElement E, class T>
constexpr Mat<T, E::dim> metric_tensor(const Mat<T, E::dim>& J_inverse) {
  if constexpr (E::metric == Mat<double, E::dim>::identity()) {
    return transpose(J_inverse) * J_inverse;
  } else {
    Mat<T, E::dim> M;
    for (int k = 0; k < E::dim * E::dim; ++k) M.data[k] = T(E::metric.data[k]);
    return transpose(J_inverse) * (M * J_inverse);
  }
}

/// Outward normal of a face times the ratio of face measure to reference measure, from the face's Jacobian.
template <class T>
constexpr Vec<T, 2> area_normal(const Mat<T, 2, 1>& J) {
  return {J(1, 0), -J(0, 0)};
}
template <class T>
constexpr Vec<T, 3> area_normal(const Mat<T, 3, 2>& J) {
  return {J(1, 0) * J(2, 1) - J(2, 0) * J(1, 1), J(2, 0) * J(0, 1) - J(0, 0) * J(2, 1),
          J(0, 0) * J(1, 1) - J(1, 0) * J(0, 1)};
}

/// Values of a cell's nodes (coordinates, say) at the nodes of its face; FaceElement = the element of that
/// face.
template <ReferenceElement E, class FaceElement = typename E::Face, class V>
constexpr std::array<V, FaceElement::n_nodes> on_face(int face, const std::array<V, E::n_nodes>& X) {
  const std::span<const int> nodes = E::face_nodes(face);
  std::array<V, FaceElement::n_nodes> values{};
  for (int k = 0; k < FaceElement::n_nodes; ++k) values[k] = X[nodes[k]];
  return values;
}

/// Reference coordinates in the cell of the point eta of its face.
template <ReferenceElement E, class FaceElement = typename E::Face>
constexpr Vec<double, E::dim> face_to_cell(int face, const Vec<double, E::dim - 1>& eta) {
  return map<FaceElement>(eta, on_face<E, FaceElement>(face, E::nodes));
}

}  // namespace ifsi
