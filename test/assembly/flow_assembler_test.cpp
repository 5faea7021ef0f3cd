// Assembly of the flow against the sum over cells, one at a time.
#include "ifsi/assembly/flow_assembler.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"

namespace ifsi {
namespace {

constexpr int B = 3;
const FluidParameters<Newtonian> fluid{.rho = 1.3, .rheology = {0.4}, .c_inertia = 7.0, .tau_rate2 = 2.0};

struct Sums {
  std::vector<double> R;
  BlockCsr<B> K;
};

Sums one_cell_at_a_time(const Mesh<Quad1>& mesh, const std::vector<double>& u, Sums sums) {
  using T = Pack<1>;
  for (const auto& nodes : mesh.cells) {
    FlowCellData<Quad1, T> cell;
    for (int a = 0; a < 4; ++a) {
      const auto& X = mesh.points[nodes[a]];
      const double* u_a = &u[nodes[a] * B];
      cell.X[a] = {X[0], X[1]};
      cell.v[a] = cell.v_dot[a] = {u_a[0], u_a[1]};
      cell.p[a] = u_a[2];
      cell.f[a] = Vec<T, 2>::zero();
      cell.s[a] = 1.0;
    }
    cell.k_p = 1.0;
    const FlowCell<Quad1, DefaultQuadrature<Quad1>, FluidModel<>, T> kernel(cell, fluid);
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < B; ++i) sums.R[nodes[a] * B + i] += kernel.residual(a)[i][0];
    kernel.tangent([&](int a, int b, const Mat<T, B>& K_ab) {
      double* block = sums.K.at(sums.K.find(nodes[a], nodes[b]));
      for (int k = 0; k < B * B; ++k) block[k] += K_ab.data[k][0];
    });
  }
  return sums;
}

// The cells come in random order, so that rows are met neither in order nor one after the other; what the
// matrix held before must not matter.
TEST(FlowAssembler, SumsOverCellsWhateverTheirOrder) {
  auto mesh = distribute(box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {5, 6}), Communicator(MPI_COMM_SELF));
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), std::mt19937(1));
  std::shuffle(mesh.cell_points.begin(), mesh.cell_points.end(), std::mt19937(1));
  std::vector<double> u(mesh.n_nodes() * B);
  std::mt19937 generator(1);
  for (double& u_i : u) u_i = std::uniform_real_distribution<double>(-1.0, 1.0)(generator);
  const FlowAssembler<Quad1> assembler(mesh);
  const Sums expected = one_cell_at_a_time(mesh, u, {std::vector(u.size(), 0.0), assembler.make_matrix()});
  Sums sums{std::vector(u.size(), 5.0), assembler.make_matrix()};
  std::fill(sums.K.values.begin(), sums.K.values.end(), 7.0);
  const FlowFields fields{.u = u, .u_dot = u, .f = {}, .s = {}, .k_p = {}, .fraction = {}};
  assembler.residual_and_tangent(fields, fluid, sums.R, sums.K);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(sums.R[i], expected.R[i], 1e-13);
  for (std::size_t k = 0; k < sums.K.values.size(); ++k)
    EXPECT_NEAR(sums.K.values[k], expected.K.values[k], 1e-13);
  assembler.residual(fields, fluid, sums.R);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(sums.R[i], expected.R[i], 1e-13);
}

}  // namespace
}  // namespace ifsi
