#pragma once
/// \file
/// Boundary terms of the flow: tractions, pressures, backflow stabilisation, and the flux through a boundary.

#include "ifsi/assembly/face_loop.hpp"
#include "ifsi/linalg/block_csr.hpp"

namespace ifsi {

/// Adds -(w, h) of (eq. 3) to the rows of owned nodes. `traction(x, n)` gives h at a point with unit normal
/// n.
template <class Coordinates, class Element, class Traction>
void add_traction(const Mesh<Element>& mesh, int boundary, const Traction& traction, std::span<double> R) {
  constexpr int dim = Element::dim, B = dim + 1;
  for_each_face_point<Coordinates>(mesh, boundary, false, [&](const FacePoint<dim>& q) {
    const double dA = std::sqrt(dot(q.n_dA, q.n_dA));
    if (dA == 0.0) return;  // on the axis of an axisymmetric mesh
    const Vec<double, dim> h = traction(q.x, (1.0 / dA) * q.n_dA);
    for (std::size_t a = 0; a < q.nodes.size(); ++a)
      if (q.nodes[a] < mesh.nodes.n_owned())
        for (int i = 0; i < dim; ++i) R[q.nodes[a] * B + i] -= q.N[a] * h[i] * dA;
  });
}

/// Velocity at a face point from interleaved nodal unknowns.
template <int dim>
Vec<double, dim> face_velocity(const FacePoint<dim>& q, std::span<const double> u) {
  auto v = Vec<double, dim>::zero();
  for (std::size_t a = 0; a < q.nodes.size(); ++a)
    for (int i = 0; i < dim; ++i) v[i] += q.N[a] * u[q.nodes[a] * (dim + 1) + i];
  return v;
}

/// Backflow stabilisation (eq. 11): residual, and tangent when K is given.
template <class Coordinates, class Element>
void add_backflow(const Mesh<Element>& mesh, int boundary, double beta_rho, std::span<const double> u,
                  std::span<double> R, BlockCsr<Element::dim + 1>* K) {
  constexpr int dim = Element::dim, B = dim + 1;
  for_each_face_point<Coordinates>(mesh, boundary, false, [&](const FacePoint<dim>& q) {
    const Vec<double, dim> v = face_velocity(q, u);
    const double inflow = std::min(dot(v, q.n_dA), 0.0);
    if (inflow == 0.0) return;
    for (std::size_t a = 0; a < q.nodes.size(); ++a) {
      const int row = q.nodes[a];
      if (row >= mesh.nodes.n_owned()) continue;
      for (int i = 0; i < dim; ++i) R[row * B + i] -= beta_rho * q.N[a] * inflow * v[i];
      if (K == nullptr) continue;
      for (std::size_t b = 0; b < q.nodes.size(); ++b) {
        double* block = K->at(K->find(row, q.nodes[b]));
        const double NN = beta_rho * q.N[a] * q.N[b];
        for (int i = 0; i < dim; ++i) {
          block[i * B + i] -= NN * inflow;
          for (int j = 0; j < dim; ++j) block[i * B + j] -= NN * v[i] * q.n_dA[j];
        }
      }
    }
  });
}

/// Volume flux out of the mesh through a boundary, summed over the ranks.
template <class Coordinates, class Element>
double boundary_flux(const Mesh<Element>& mesh, int boundary, std::span<const double> u) {
  constexpr int dim = Element::dim;
  double flux = 0.0;
  for_each_face_point<Coordinates>(
      mesh, boundary, true, [&](const FacePoint<dim>& q) { flux += dot(face_velocity(q, u), q.n_dA); });
  return mesh.comm.sum(flux);
}

/// What a flow carries out of the mesh through a boundary per time, summed over the ranks.
template <int dim>
struct CarriedOut {
  double kinetic_energy = 0.0;  ///< rho/2 |v|^2 v.n
  Vec<double, dim> momentum{};  ///< rho v v.n
};
template <class Coordinates, class Element>
CarriedOut<Element::dim> carried_out(const Mesh<Element>& mesh, int boundary, std::span<const double> u,
                                     double rho) {
  constexpr int dim = Element::dim;
  std::array<double, dim + 1> sums{};
  for_each_face_point<Coordinates>(mesh, boundary, true, [&](const FacePoint<dim>& q) {
    const Vec<double, dim> v = face_velocity(q, u);
    const double rho_vn = rho * dot(v, q.n_dA);
    sums[dim] += 0.5 * dot(v, v) * rho_vn;
    for (int i = 0; i < dim; ++i) sums[i] += v[i] * rho_vn;
  });
  mesh.comm.sum_in_place(sums.data(), dim + 1);
  CarriedOut<dim> out{sums[dim], {}};
  for (int i = 0; i < dim; ++i) out.momentum[i] = sums[i];
  return out;
}

}  // namespace ifsi
