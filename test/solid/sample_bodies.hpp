#pragma once
/// \file
/// Small distorted bodies and states for the tests of the solid.

#include <random>
#include <variant>

#include "ifsi/assembly/solid_body.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"

namespace ifsi::testing {

/// One law chosen at run time: the kernels are compiled once for all laws.
struct AnyLaw {
  std::variant<NeoHookean, StVenantKirchhoff, UncoupledNeoHookean, CircumferentialFibre> law;

  template <class T, int n, int dim>
  T psi(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return std::visit([&](const auto& l) { return l.psi(F, X); }, law);
  }
  template <class T, int n, int dim>
  Mat<T, n> first_piola(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return std::visit([&](const auto& l) { return l.first_piola(F, X); }, law);
  }
  template <class T, int n, int dim>
  Tangent<T, n> tangent(const Mat<T, n>& F, const Vec<T, dim>& X) const {
    return std::visit([&](const auto& l) { return l.tangent(F, X); }, law);
  }
  double young_modulus() const {
    return std::visit([](const auto& l) { return l.young_modulus(); }, law);
  }
};

inline std::vector<AnyLaw> all_laws() {
  return {{NeoHookean(Lame{1.3, 2.1})},
          {StVenantKirchhoff(Lame{1.3, 2.1})},
          {UncoupledNeoHookean(1.3, 7.0)},
          {CircumferentialFibre(0.9, {-0.2, -0.3})}};
}

/// The reference cell, every node moved by at most `size` in each direction, and away from r = 0.
template <class Element>
GlobalMesh<Element> distorted_cell(double size = 0.12) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> d(-size, size);
  GlobalMesh<Element> mesh;
  mesh.cells.emplace_back();
  for (int a = 0; a < Element::n_nodes; ++a) {
    mesh.cells[0][a] = a;
    auto X = Element::nodes[a];
    for (double& x : X.data) x += d(random);
    X[0] += 2;
    mesh.points.push_back(X);
  }
  return mesh;
}

/// Random numbers in [-size, size].
inline std::vector<double> noise(int n, double size, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> d(-size, size);
  std::vector<double> x(n);
  for (double& v : x) v = d(random);
  return x;
}

/// Parameters with every term of the weak form alive.
template <int dim>
SolidParameters<dim> immersed_parameters() {
  SolidParameters<dim> p{1.7, 1.1, 0.3, 0.05, {}};
  for (int i = 0; i < dim; ++i) p.gravity[i] = 0.4 - 0.9 * i;
  return p;
}

}  // namespace ifsi::testing
