#pragma once
/// \file
/// The same coupling twice: spread over the ranks, and whole on each rank as the oracle.

#include <vector>

#include "ifsi/coupling/interpolation.hpp"
#include "sample_meshes.hpp"

namespace ifsi::sample {

/// A mesh distributed over all ranks and one that each rank has for itself, with C on both. Results are
/// compared at input points: the numbering that does not depend on the partition.
template <class Element>
struct Scattered {
  static constexpr int dim = Element::dim;
  using Point = Vec<double, dim>;

  GlobalMesh<Element> global;
  Mesh<Element> mesh, whole;
  Interpolation<Element> C{mesh}, C_whole{whole};

  explicit Scattered(GlobalMesh<Element> m)
      : global(std::move(m)),
        mesh(distribute(global, Communicator())),
        whole(distribute(global, Communicator(MPI_COMM_SELF))) {}
  Scattered() : Scattered(bent<Element>(counts<dim>(dim == 2 ? 6 : 3))) {}

  void locate(const std::vector<Point>& x) {
    C.locate(x);
    C_whole.locate(x);
  }
  /// Input point of each global node of `whole` (on one rank global and local numbers are the same).
  [[nodiscard]] int input_of_whole(long node) const { return whole.input_point[node]; }
  /// Input points of all global nodes of `mesh`, on every rank.
  [[nodiscard]] std::vector<int> input_of_nodes() const {
    return mesh.comm.all_gather(
        std::vector<int>(mesh.input_point.begin(), mesh.input_point.begin() + mesh.n_owned_nodes()));
  }
  /// Nodal values from a field of positions; `stride` numbers per node, `dim` of them filled.
  template <class Field>
  [[nodiscard]] static std::vector<double> nodal(const Mesh<Element>& m, int stride, Field&& field) {
    std::vector<double> v(m.n_nodes() * stride, 1e30);
    for (int i = 0; i < m.n_nodes(); ++i) {
      const Point value = field(m.points[i]);
      for (int d = 0; d < dim; ++d) v[i * stride + d] = value[d];
    }
    return v;
  }
};

/// Positions all over the unit box, on vertices and faces of the mesh, and some outside of it.
template <class Element>
std::vector<Vec<double, Element::dim>> positions(const GlobalMesh<Element>& mesh, Random& random,
                                                 int n_outside) {
  std::vector<Vec<double, Element::dim>> x;
  for (int k = 0; k < 60; ++k) x.push_back(random.vector<Element::dim>(0, 1));
  for (int k = 0; k < 30; ++k) {
    const auto X = mesh.cell_coordinates(random.below(mesh.n_cells()));
    x.push_back(X[random.below(Element::n_nodes)]);
    x.push_back(map<Element>(on_face<Element>(random), X));
  }
  for (int k = 0; k < n_outside; ++k) x.push_back(random.vector<Element::dim>(1.2, 3));
  return x;
}

}  // namespace ifsi::sample
