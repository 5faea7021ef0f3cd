#pragma once
/// \file
/// Boundaries that are planes.

#include <algorithm>
#include <cmath>
#include <string>

#include "ifsi/assembly/face_loop.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/quadrature/coordinates.hpp"

namespace ifsi {

/// Unit normal, up to its sign, of a boundary that is a plane, or several parallel ones; the same on all
/// ranks. With N = int n n^T dA / int dA a boundary is plane when N = n n^T, that is N : N = 1. Components
/// below 1e-8 become zero, so that planes normal to an axis are so exactly.
/// \throws Error (configuration) when normals differ: by 1e-4 in the root mean square.
template <class Element>
Vec<double, Element::dim> plane_normal(const Mesh<Element>& mesh, const std::string& boundary) {
  constexpr int dim = Element::dim;
  auto N = Mat<double, dim>::zero();
  for_each_face_point<Cartesian>(mesh, mesh.boundary(boundary), true, [&](const FacePoint<dim>& q) {
    const double dA = std::sqrt(dot(q.n_dA, q.n_dA));
    if (dA > 0.0) N += (1.0 / dA) * outer(q.n_dA, q.n_dA);
  });
  mesh.comm.sum_in_place(N.data, dim * dim);
  const double area = trace(N);
  const double spread =
      area > 0.0 ? std::sqrt(std::max(0.0, 0.5 * (1.0 - inner(N, N) / (area * area)))) : 1.0;
  if (!(spread < 1e-4))
    throw Error(ExitCode::configuration,
                "boundary \"" + boundary + "\" is no plane: found normals that differ by " +
                    std::to_string(spread) + " rad (root mean square); expected a plane for slip");
  int largest = 0;
  for (int i = 1; i < dim; ++i)
    if (N(i, i) > N(largest, largest)) largest = i;
  Vec<double, dim> n;
  const double length = std::sqrt(N(largest, largest) * area);
  for (int i = 0; i < dim; ++i) n[i] = N(i, largest) / length;
  for (int i = 0; i < dim; ++i)
    if (std::abs(n[i]) < 1e-8) n[i] = 0.0;
  return (1.0 / std::sqrt(dot(n, n))) * n;
}

}  // namespace ifsi
