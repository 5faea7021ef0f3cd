#pragma once
/// \file
/// The contract of the solid kernel, over element x law x formulation x coordinates: its residual is the
/// gradient of the energy and its tangent that of the residual, exactly (dual numbers).

#include <gtest/gtest.h>

#include "material/dual.hpp"
#include "solid/sample_bodies.hpp"

namespace ifsi::testing {

template <class Element_, class Formulation_, class Coordinates_, class Law_ = AnyLaw>
struct Case {
  using Element = Element_;
  using Formulation = Formulation_;
  using Coordinates = Coordinates_;
  using Law = Law_;
  template <class T>
  using Kernel = SolidCell<Element, Law, Formulation, Coordinates, DefaultQuadrature<Element>, T>;
};

template <class Law>
std::vector<Law> laws() {
  if constexpr (std::is_same_v<Law, AnyLaw>) {
    return all_laws();
  } else {
    return {UncoupledNeoHookean(1.3, 7.0)};
  }
}

template <class C>
class SolidCellContract : public ::testing::Test {
 protected:
  using Element = typename C::Element;
  static constexpr int n = Element::n_nodes, dim = Element::dim, n_dofs = n * dim;
  template <class T>
  using Data = SolidCellData<Element, T>;
  using Residual = std::array<double, n_dofs>;
  const SolidParameters<dim> solid = immersed_parameters<dim>();

  Data<double> sample(double size = 0.1) const {
    Data<double> cell;
    const auto mesh = distorted_cell<Element>(size);
    for (int a = 0; a < n; ++a) cell.X[a] = mesh.points[a];
    const auto u = noise(n_dofs, size, 11), v = noise(n_dofs, 1, 12), acc = noise(n_dofs, 1, 13);
    for (int k = 0; k < n_dofs; ++k) {
      cell.u[k / dim][k % dim] = u[k];
      cell.v[k / dim][k % dim] = v[k];
      cell.a[k / dim][k % dim] = acc[k];
    }
    return cell;
  }
  template <class T>
  static Data<T> lifted(const Data<double>& cell) {
    Data<T> r;
    for (int a = 0; a < n; ++a)
      for (int i = 0; i < dim; ++i) {
        r.X[a][i] = T(cell.X[a][i]);
        r.u[a][i] = T(cell.u[a][i]);
        r.v[a][i] = T(cell.v[a][i]);
        r.a[a][i] = T(cell.a[a][i]);
      }
    return r;
  }
};

TYPED_TEST_SUITE_P(SolidCellContract);

TYPED_TEST_P(SolidCellContract, ElasticResidualIsTheGradientOfTheEnergy) {
  using D = Dual<double>;
  constexpr int dim = TestFixture::dim;
  SolidParameters<dim> massless;
  massless.rho_s = 0;
  const auto cell = this->sample();
  for (const auto& law : laws<typename TypeParam::Law>()) {
    typename TestFixture::Residual R;
    typename TypeParam::template Kernel<double>(cell, law).residual(massless,
                                                                    [&](int a, const Vec<double, dim>& R_a) {
                                                                      for (int i = 0; i < dim; ++i)
                                                                        R[a * dim + i] = R_a[i];
                                                                    });
    for (int k = 0; k < TestFixture::n_dofs; ++k) {
      auto moved = TestFixture::template lifted<D>(cell);
      moved.u[k / dim][k % dim].slope = 1;
      const typename TypeParam::template Kernel<D> kernel(moved, law);
      EXPECT_NEAR(R[k], kernel.totals(massless).elastic.slope, 1e-11);
    }
  }
}

TYPED_TEST_P(SolidCellContract, TangentIsTheGradientOfTheResidual) {
  using D = Dual<double>;
  constexpr int dim = TestFixture::dim, n_dofs = TestFixture::n_dofs;
  const StateSlopes slopes{0.7, 1.9, 3.1};
  const auto cell = this->sample();
  for (const auto& law : laws<typename TypeParam::Law>()) {
    std::array<std::array<double, n_dofs>, n_dofs> K;
    typename TypeParam::template Kernel<double>(cell, law).residual_and_tangent(
        this->solid, slopes, [](int, const Vec<double, dim>&) {},
        [&](int a, int b, const Mat<double, dim>& K_ab) {
          for (int i = 0; i < dim; ++i)
            for (int k = 0; k < dim; ++k) K[a * dim + i][b * dim + k] = K_ab(i, k);
        });
    for (int k = 0; k < n_dofs; ++k) {
      auto moved = TestFixture::template lifted<D>(cell);
      moved.u[k / dim][k % dim].slope = slopes.u;
      moved.v[k / dim][k % dim].slope = slopes.v;
      moved.a[k / dim][k % dim].slope = slopes.a;
      typename TypeParam::template Kernel<D>(moved, law)
          .residual(this->solid, [&](int a, const Vec<D, dim>& R_a) {
            for (int i = 0; i < dim; ++i)
              EXPECT_NEAR(K[a * dim + i][k], R_a[i].slope, 2e-10) << "row " << a * dim + i << " column " << k;
          });
    }
  }
}

REGISTER_TYPED_TEST_SUITE_P(SolidCellContract, ElasticResidualIsTheGradientOfTheEnergy,
                            TangentIsTheGradientOfTheResidual);

}  // namespace ifsi::testing
