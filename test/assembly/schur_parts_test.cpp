// The parts of the pressure Schur complement (eq. 14) of a uniform flow, where they are known.
#include <gtest/gtest.h>

#include <numeric>

#include "ifsi/assembly/flow_assembler.hpp"
#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"

namespace {
using namespace ifsi;

/// A rectangle of square cells with side h, filled with a uniform flow.
template <class Element>
struct UniformFlow {
  static constexpr int B = 3;
  static constexpr double h = 0.25, area = 2.0;

  UniformFlow(Vec<double, 2> v, double c_inertia)
      : mesh(distribute(box<Element>({0.0, 0.0}, {2.0, 1.0}, {8, 4}), Communicator())),
        u(mesh.n_nodes() * B, 0.0),
        rate(u) {
    for (std::size_t k = 0; k < u.size(); k += B) u[k] = v[0], u[k + 1] = v[1];
    fluid.rho = 3.0;
    fluid.rheology = Newtonian{0.2};
    fluid.c_inertia = c_inertia;
    fluid.tau_rate2 = 4.0 * c_inertia * c_inertia;
    const FlowAssembler<Element> assembler(mesh);
    parts =
        assembler.schur_parts({.u = u, .u_dot = rate, .f = {}, .s = {}, .k_p = {}, .fraction = {}}, fluid);
  }
  /// 2 mu + rho tau_C by (eq. 4), (eq. 5) with G = 4 / h^2 I.
  [[nodiscard]] double m(const Vec<double, 2>& v) const {
    const double g = 4.0 / (h * h), nu = 0.2 / fluid.rho;
    const double rate2 = fluid.tau_rate2 + g * dot(v, v) + fluid.C_I * nu * nu * 2.0 * g * g;
    return 2.0 * 0.2 + fluid.rho * std::sqrt(rate2) / (2.0 * g);
  }
  /// A times the first coordinate to some power.
  [[nodiscard]] std::vector<double> times_x(BlockCsr<1> A, double power) const {
    std::vector<double> x, y(mesh.n_nodes());
    for (const auto& X : mesh.node_coordinates()) x.push_back(std::pow(X[0], power));
    A.apply(x.data(), y.data());
    return y;
  }

  Mesh<Element> mesh;
  std::vector<double> u, rate;
  FluidParameters<Newtonian> fluid;
  SchurParts parts;
};

template <class Element>
class SchurPartsOf : public testing::Test {};
using Elements = testing::Types<Quad1, Quad2, Tri2>;
TYPED_TEST_SUITE(SchurPartsOf, Elements);

TYPED_TEST(SchurPartsOf, HaveTheScalesOfEquation14) {
  const double c = 5.0;
  const Vec<double, 2> v{2.0, -1.0};
  const UniformFlow<TypeParam> flow(v, c);
  const auto ones = flow.times_x(flow.parts.mass, 0.0), Cx = flow.times_x(flow.parts.convection, 1.0);
  const auto Nx = flow.times_x(flow.parts.laplacian, 1.0);
  const auto X = flow.mesh.node_coordinates();
  if constexpr (!std::is_same_v<TypeParam, Tri2>) {
    EXPECT_NEAR(std::accumulate(ones.begin(), ones.end(), 0.0), flow.area / flow.m(v), 1e-12);
  }
  double energy = 0.0;
  for (int i = 0; i < flow.mesh.n_nodes(); ++i) {
    energy += X[i][0] * Nx[i];
    EXPECT_NEAR(Cx[i], v[0] / c * ones[i], 1e-13);  // v . grad x = v_x
  }
  EXPECT_NEAR(energy, flow.area / (flow.fluid.rho * c), 1e-12);
}

TYPED_TEST(SchurPartsOf, TransportNothingInAFluidAtRest) {
  const UniformFlow<TypeParam> flow({0.0, 0.0}, 5.0);
  for (double value : flow.times_x(flow.parts.convection, 2.0)) EXPECT_NEAR(value, 0.0, 1e-14);
}

TYPED_TEST(SchurPartsOf, SteadyFlowHasNoViscousLimit) {
  const UniformFlow<TypeParam> flow({1.0, 0.0}, 0.0);
  EXPECT_TRUE(flow.parts.steady);
  EXPECT_TRUE(std::isinf(flow.parts.viscous_number));
  const auto Nx = flow.times_x(flow.parts.laplacian, 1.0);
  double energy = 0.0;
  const auto X = flow.mesh.node_coordinates();
  for (int i = 0; i < flow.mesh.n_nodes(); ++i) energy += X[i][0] * Nx[i];
  EXPECT_NEAR(energy, flow.area / flow.fluid.rho, 1e-12);
}

TEST(SchurParts, TheBulkNumberIsThatOfGradDiv) {
  const double c = 5.0, h = 0.25;
  const UniformFlow<Quad1> flow({1.0, 0.0}, c);
  const double rho_tau_C = flow.m({1.0, 0.0}) - 2.0 * 0.2;
  EXPECT_NEAR(flow.parts.bulk_number, rho_tau_C / (flow.fluid.rho * c * h * h), 1e-12);
}

TEST(SchurParts, TheViscousNumberIsStricterForOrderTwo) {
  const double nu = 0.2 / 3.0, c = 5.0, h = 0.25;
  EXPECT_NEAR(UniformFlow<Quad1>({1.0, 0.0}, c).parts.viscous_number, nu / (c * h * h), 1e-12);
  EXPECT_NEAR(UniformFlow<Quad2>({1.0, 0.0}, c).parts.viscous_number, 16.0 * nu / (c * h * h), 1e-12);
  EXPECT_EQ(UniformFlow<Quad2>({1.0, 0.0}, c).parts.order, 2);
}
}  // namespace
