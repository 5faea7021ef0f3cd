// The flow kernel: tangent against automatic differentiation, packs against doubles, and exact balances.
#include "ifsi/fluid/flow_cell.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ifsi/core/pack.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/fluid/carreau_yasuda.hpp"
#include "ifsi/quadrature/quadrature.hpp"
#include "support/dual.hpp"

namespace ifsi {
namespace {

template <class E, class M>
struct Scene {
  using Element = E;
  using Model = M;
};
using Thinning = FluidModel<NavierStokes, CarreauYasuda>;
using ThinningAxisymmetric = FluidModel<NavierStokes, CarreauYasuda, Axisymmetric>;
using AxisymmetricFlow = FluidModel<NavierStokes, Newtonian, Axisymmetric>;
using Creeping = FluidModel<Stokes>;
using Scenes =
    testing::Types<Scene<Tri1, FluidModel<>>, Scene<Tri2, FluidModel<>>, Scene<Quad1, FluidModel<>>,
                   Scene<Quad2, FluidModel<>>, Scene<Tet1, FluidModel<>>, Scene<Tet2, FluidModel<>>,
                   Scene<Hex1, FluidModel<>>, Scene<Wedge1, FluidModel<>>, Scene<Quad1, Creeping>,
                   Scene<Tet1, Creeping>, Scene<Quad1, AxisymmetricFlow>, Scene<Tri2, AxisymmetricFlow>,
                   Scene<Quad1, Thinning>, Scene<Tet1, Thinning>, Scene<Quad1, ThinningAxisymmetric>>;

template <class Model>
FluidParameters<typename Model::Rheology> parameters() {
  FluidParameters<typename Model::Rheology> fluid;
  fluid.rho = 1.3;
  fluid.c_inertia = 7.0;
  fluid.tau_rate2 = 2.0;
  if constexpr (Model::Rheology::newtonian)
    fluid.rheology.mu = 0.4;
  else
    fluid.rheology = {.mu_0 = 0.7, .mu_inf = 0.1, .lambda = 1.5, .a = 1.4, .n = 0.4};
  return fluid;
}

// The number types of these tests: lanes with different cells, and a value with its derivative in one
// direction.
using Lanes = Pack<2>;
using D = test::Dual<1>;
template <class TypeParam, class T>
using Cell = FlowCell<typename TypeParam::Element, DefaultQuadrature<typename TypeParam::Element>,
                      typename TypeParam::Model, T>;

// A distorted cell with random fields in each lane.
template <class Element>
FlowCellData<Element, Lanes> random_cells() {
  std::mt19937 generator(1);
  const auto number = [&] {
    Lanes x;
    for (int l = 0; l < Lanes::lanes; ++l)
      x.set(l, std::uniform_real_distribution<double>(-1.0, 1.0)(generator));
    return x;
  };
  FlowCellData<Element, Lanes> cells;
  for (int a = 0; a < Element::n_nodes; ++a) {
    for (int i = 0; i < Element::dim; ++i) {
      cells.X[a][i] = 2.0 + Element::nodes[a][i] + 0.05 * number();
      cells.v[a][i] = number();
      cells.v_dot[a][i] = number();
      cells.f[a][i] = number();
    }
    cells.p[a] = number();
    cells.s[a] = 1.5 + number();
  }
  cells.k_p = 0.6 + 0.1 * number();
  return cells;
}

// One lane of them.
template <class Element>
FlowCellData<Element, D> lane_of(const FlowCellData<Element, Lanes>& cells, int l) {
  FlowCellData<Element, D> cell;
  for (int a = 0; a < Element::n_nodes; ++a) {
    for (int i = 0; i < Element::dim; ++i) {
      cell.X[a][i] = cells.X[a][i][l];
      cell.v[a][i] = cells.v[a][i][l];
      cell.v_dot[a][i] = cells.v_dot[a][i][l];
      cell.f[a][i] = cells.f[a][i][l];
    }
    cell.p[a] = cells.p[a][l];
    cell.s[a] = cells.s[a][l];
  }
  cell.k_p = cells.k_p[l];
  return cell;
}

template <class T>
class FlowCellTest : public testing::Test {};
TYPED_TEST_SUITE(FlowCellTest, Scenes);

// In every lane, for every unknown: v_dot follows v as in a time step.
TYPED_TEST(FlowCellTest, TangentIsTheDerivativeOfTheResidual) {
  using Element = typename TypeParam::Element;
  constexpr int n = Element::n_nodes, dim = Element::dim, B = dim + 1;
  const auto fluid = parameters<typename TypeParam::Model>();
  const auto cells = random_cells<Element>();
  const Cell<TypeParam, Lanes> kernel(cells, fluid);
  std::vector<Mat<Lanes, B>> K(n * n);
  kernel.tangent([&](int a, int b, const Mat<Lanes, B>& K_ab) { K[a * n + b] = K_ab; });
  double largest = 0.0;
  for (const auto& K_ab : K)
    for (const Lanes& x : K_ab.data) largest = std::max({largest, std::abs(x[0]), std::abs(x[1])});
  for (int l = 0; l < Lanes::lanes; ++l)
    for (int b = 0; b < n; ++b)
      for (int j = 0; j < B; ++j) {
        auto cell = lane_of(cells, l);
        (j < dim ? cell.v[b][j] : cell.p[b]).d[0] = 1.0;
        if (j < dim) cell.v_dot[b][j].d[0] = fluid.c_inertia;
        const Cell<TypeParam, D> varied(cell, fluid);
        for (int a = 0; a < n; ++a)
          for (int i = 0; i < B; ++i) {
            EXPECT_NEAR(kernel.residual(a)[i][l], varied.residual(a)[i].v, 1e-12 * largest);
            EXPECT_NEAR(K[a * n + b](i, j)[l], varied.residual(a)[i].d[0], 1e-12 * largest)
                << "lane " << l << " a " << a << " b " << b << " i " << i << " j " << j;
          }
      }
}

// Test functions that sum to one: momentum rows then add up to the integral of rho (dv/dt - f) plus
// convection, and the mass rows to the integral of div v, whatever the stabilisation.
TYPED_TEST(FlowCellTest, RowsSumToTheBalances) {
  using Element = typename TypeParam::Element;
  using Model = typename TypeParam::Model;
  constexpr int n = Element::n_nodes, dim = Element::dim, B = dim + 1;
  if constexpr (!Model::Coordinates::axisymmetric) {
    auto cell = lane_of(random_cells<Element>(), 0);
    for (int a = 0; a < n; ++a)  // v = A x with a trace, a uniform acceleration and body force
      for (int i = 0; i < dim; ++i) {
        cell.v[a][i] = D(i + 1.0) * cell.X[a][i];
        cell.v_dot[a][i] = 2.0;
        cell.f[a][i] = 0.5;
      }
    const Cell<TypeParam, D> kernel(cell, parameters<Model>());
    auto sum = Vec<D, B>::zero();
    for (int a = 0; a < n; ++a) sum += kernel.residual(a);
    double volume = 0.0;
    for (int q = 0; q < DefaultQuadrature<Element>::n; ++q) volume += kernel.point(q).JxW().v;
    EXPECT_NEAR(sum[dim].v, volume * dim * (dim + 1) / 2.0, 1e-12 * std::abs(sum[dim].v) * 10);
    if constexpr (!Model::Physics::convection) {
      for (int i = 0; i < dim; ++i) EXPECT_NEAR(sum[i].v, volume * 1.3 * 1.5, 1e-11);
    }
  }
}

TEST(Rheology, CarreauYasudaSlopeIsTheDerivative) {
  const CarreauYasuda blood{.mu_0 = 0.56, .mu_inf = 0.0345, .lambda = 1.902, .a = 1.25, .n = 0.22};
  for (double s : {1e-3, 0.1, 1.0, 50.0}) {
    const auto mu = blood.viscosity(test::Dual<1>::variable(s, 0));
    EXPECT_NEAR(blood.viscosity_slope(s), mu.d[0], 1e-12 * std::abs(mu.d[0]));
  }
}

}  // namespace
}  // namespace ifsi
