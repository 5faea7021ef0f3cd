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

// A distorted cell with random fields; v_dot = c v + b, so that it follows v as in a time step.
template <class Element>
FlowCellData<Element, double> random_cell(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  FlowCellData<Element, double> cell;
  for (int a = 0; a < Element::n_nodes; ++a) {
    for (int i = 0; i < Element::dim; ++i) {
      cell.X[a][i] = 2.0 + Element::nodes[a][i] + 0.05 * number(generator);
      cell.v[a][i] = number(generator);
      cell.v_dot[a][i] = number(generator);
      cell.f[a][i] = number(generator);
    }
    cell.p[a] = number(generator);
    cell.s[a] = 1.5 + number(generator);
  }
  cell.k_p = 0.6;
  return cell;
}

template <class T>
class FlowCellTest : public testing::Test {};
TYPED_TEST_SUITE(FlowCellTest, Scenes);

TYPED_TEST(FlowCellTest, TangentIsTheDerivativeOfTheResidual) {
  using Element = typename TypeParam::Element;
  using Model = typename TypeParam::Model;
  constexpr int n = Element::n_nodes, dim = Element::dim, B = dim + 1, N = n * B;
  using D = test::Dual<N>;
  using Rule = DefaultQuadrature<Element>;
  const auto fluid = parameters<Model>();
  const auto cell = random_cell<Element>(1);
  auto dual = std::make_unique<FlowCellData<Element, D>>();
  for (int a = 0; a < n; ++a) {
    for (int i = 0; i < dim; ++i) {
      dual->X[a][i] = cell.X[a][i];
      dual->f[a][i] = cell.f[a][i];
      dual->v[a][i] = D::variable(cell.v[a][i], a * B + i);
      dual->v_dot[a][i] = D(fluid.c_inertia) * (dual->v[a][i] - D(cell.v[a][i])) + D(cell.v_dot[a][i]);
    }
    dual->p[a] = D::variable(cell.p[a], a * B + dim);
    dual->s[a] = cell.s[a];
  }
  dual->k_p = cell.k_p;

  std::vector<Vec<D, B>> R(n);
  const auto kernel = std::make_unique<FlowCell<Element, Rule, Model, D>>(*dual, fluid);
  kernel->residual([&](int a, const Vec<D, B>& R_a) { R[a] = R_a; });
  double largest = 0.0;
  for (int a = 0; a < n; ++a)
    for (int k = 0; k < B; ++k)
      for (double d : R[a][k].d) largest = std::max(largest, std::abs(d));
  FlowCell<Element, Rule, Model, double>(cell, fluid)
      .residual_and_tangent(
          [&](int a, const Vec<double, B>& R_a) {
            for (int k = 0; k < B; ++k) EXPECT_NEAR(R_a[k], R[a][k].v, 1e-12 * largest);
          },
          [&](int a, int b, const Mat<double, B>& K) {
            for (int i = 0; i < B; ++i)
              for (int j = 0; j < B; ++j)
                EXPECT_NEAR(K(i, j), R[a][i].d[b * B + j], 1e-12 * largest)
                    << "a " << a << " b " << b << " i " << i << " j " << j;
          });
}

TYPED_TEST(FlowCellTest, PacksComputeWhatDoublesCompute) {
  using Element = typename TypeParam::Element;
  using Model = typename TypeParam::Model;
  using T = Pack<4>;
  constexpr int n = Element::n_nodes, B = Element::dim + 1;
  using Rule = DefaultQuadrature<Element>;
  const auto fluid = parameters<Model>();
  FlowCellData<Element, T> cells;
  for (int l = 0; l < 4; ++l) {
    const auto cell = random_cell<Element>(10 + l);
    for (int a = 0; a < n; ++a) {
      for (int i = 0; i < Element::dim; ++i) {
        cells.X[a][i].set(l, cell.X[a][i]);
        cells.v[a][i].set(l, cell.v[a][i]);
        cells.v_dot[a][i].set(l, cell.v_dot[a][i]);
        cells.f[a][i].set(l, cell.f[a][i]);
      }
      cells.p[a].set(l, cell.p[a]);
      cells.s[a].set(l, cell.s[a]);
    }
    cells.k_p.set(l, cell.k_p);
  }
  std::vector<Vec<T, B>> R(n);
  std::vector<Mat<T, B>> K(n * n);
  FlowCell<Element, Rule, Model, T>(cells, fluid)
      .residual_and_tangent([&](int a, const Vec<T, B>& R_a) { R[a] = R_a; },
                            [&](int a, int b, const Mat<T, B>& K_ab) { K[a * n + b] = K_ab; });
  for (int l = 0; l < 4; ++l)
    FlowCell<Element, Rule, Model, double>(random_cell<Element>(10 + l), fluid)
        .residual_and_tangent(
            [&](int a, const Vec<double, B>& R_a) {
              for (int i = 0; i < B; ++i) EXPECT_NEAR(R_a[i], R[a][i][l], 1e-11);
            },
            [&](int a, int b, const Mat<double, B>& K_ab) {
              for (int i = 0; i < B * B; ++i) EXPECT_NEAR(K_ab.data[i], K[a * n + b].data[i][l], 1e-10);
            });
}

// Test functions that sum to one: momentum rows then add up to the integral of rho (dv/dt - f) plus
// convection, and the mass rows to the integral of div v, whatever the stabilisation.
TYPED_TEST(FlowCellTest, RowsSumToTheBalances) {
  using Element = typename TypeParam::Element;
  using Model = typename TypeParam::Model;
  constexpr int n = Element::n_nodes, dim = Element::dim, B = dim + 1;
  if constexpr (!Model::Coordinates::axisymmetric) {
    const auto fluid = parameters<Model>();
    auto cell = random_cell<Element>(3);
    for (int a = 0; a < n; ++a) {  // v = A x with a trace, a uniform acceleration, no body force
      for (int i = 0; i < dim; ++i) {
        cell.v[a][i] = (i + 1.0) * cell.X[a][i];
        cell.v_dot[a][i] = 2.0;
        cell.f[a][i] = 0.5;
      }
    }
    auto sum = Vec<double, B>::zero();
    FlowCell<Element, DefaultQuadrature<Element>, Model, double>(cell, fluid)
        .residual([&](int, const Vec<double, B>& R_a) { sum += R_a; });
    double volume = 0.0;
    for (int q = 0; q < DefaultQuadrature<Element>::n; ++q)
      volume += FlowCell<Element, DefaultQuadrature<Element>, Model, double>(cell, fluid).point(q).JxW();
    EXPECT_NEAR(sum[dim], volume * dim * (dim + 1) / 2.0, 1e-12 * std::abs(sum[dim]) * 10);
    if constexpr (!Model::Physics::convection) {
      for (int i = 0; i < dim; ++i) EXPECT_NEAR(sum[i], volume * 1.3 * 1.5, 1e-11);
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
