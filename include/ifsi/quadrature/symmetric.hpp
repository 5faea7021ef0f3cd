#pragma once
/// \file
/// Fully symmetric rules on triangles and tets, all weights positive and all points inside.
///
/// The families are those of Strang & Fix (1973), Radon (1948), Dunavant (doi:10.1002/nme.1620210612),
/// Walkington (2000) and Keast (doi:10.1016/0045-7825(86)90059-9); the digits come from solving the moment
/// equations of each orbit structure to 30 digits.

#include <algorithm>

#include "ifsi/quadrature/rule.hpp"

namespace ifsi::detail {

/// All distinct permutations of the barycentric coordinates L, each with this weight (fraction of the cell's
/// measure).
template <int dim>
struct Orbit {
  double weight;
  std::array<double, dim + 1> L;
};

/// Rules exact up to `degree` <= 6 on triangles.
template <int degree>
constexpr auto triangle_orbits() {
  const auto one = [](double w, double a) { return Orbit<2>{w, {a, a, 1.0 - 2.0 * a}}; };
  const Orbit<2> center = {1.0, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
  if constexpr (degree <= 1) {
    return std::array{center};
  } else if constexpr (degree == 2) {
    return std::array{one(1.0 / 3.0, 1.0 / 6.0)};
  } else if constexpr (degree <= 4) {
    return std::array{one(0.1099517436553218676383, 0.09157621350977074345957),
                      one(0.2233815896780114656950, 0.4459484909159648863183)};
  } else if constexpr (degree == 5) {
    return std::array{Orbit<2>{0.225, center.L}, one(0.1323941527885061807377, 0.4701420641051150897704),
                      one(0.1259391805448271525957, 0.1012865073234563388010)};
  } else {
    const double a = 0.3103524510337844054166, b = 0.05314504984481694735325;
    return std::array{one(0.1167862757263793660253, 0.2492867451709104212916),
                      one(0.05084490637020681692094, 0.06308901449150222834033),
                      Orbit<2>{0.08285107561837357519355, {a, b, 1.0 - a - b}}};
  }
}

/// Rules exact up to `degree` <= 6 on tets.
template <int degree>
constexpr auto tet_orbits() {
  const auto one = [](double w, double a) { return Orbit<3>{w, {a, a, a, 1.0 - 3.0 * a}}; };
  if constexpr (degree <= 1) {
    return std::array{one(1.0, 0.25)};
  } else if constexpr (degree == 2) {
    return std::array{one(0.25, 0.1381966011250105151795)};
  } else if constexpr (degree == 3) {
    return std::array{one(0.125, 0.1129567945125110286951), one(0.125, 0.3288616499302029104003)};
  } else if constexpr (degree <= 5) {
    const double a = 0.04550370412564964949188, b = 0.5 - a;
    return std::array{one(0.07349304311636194954371, 0.09273525031089122640232),
                      one(0.1126879257180158507992, 0.3108859192633006097973),
                      Orbit<3>{0.04254602077708146643807, {a, a, b, b}}};
  } else {
    const double a = 0.06366100187501752529924, b = 0.2696723314583158080341;
    return std::array{one(0.05535718154365472209515, 0.3223378901422755103440),
                      one(0.03992275025816749209969, 0.2146028712591520292888),
                      one(0.01007721105532064294801, 0.04067395853461135311558),
                      Orbit<3>{27.0 / 560.0, {a, a, b, 1.0 - 2.0 * a - b}}};
  }
}

/// Calls visit(permutation of L, weight) for every point of the rule.
template <int dim, std::size_t n_orbits, class Visit>
constexpr void for_each_point(const std::array<Orbit<dim>, n_orbits>& orbits, Visit visit) {
  for (Orbit<dim> orbit : orbits) {
    std::sort(orbit.L.begin(), orbit.L.end());
    do visit(orbit.L, orbit.weight);
    while (std::next_permutation(orbit.L.begin(), orbit.L.end()));
  }
}

/// The symmetric rule on the unit simplex of dimension 2 or 3.
template <int dim, int degree>
constexpr auto symmetric_rule() {
  constexpr auto orbits = [] {
    if constexpr (dim == 2) {
      return triangle_orbits<degree>();
    } else {
      return tet_orbits<degree>();
    }
  }();
  constexpr int n = [](const auto& all) {
    int count = 0;
    for_each_point<dim>(all, [&](const auto&, double) { ++count; });
    return count;
  }(orbits);
  constexpr double measure = dim == 2 ? 0.5 : 1.0 / 6.0;
  Rule<dim, n> r{};
  int q = 0;
  for_each_point<dim>(orbits, [&](const auto& L, double weight) {
    for (int i = 0; i < dim; ++i) r.points[q][i] = L[i + 1];
    r.weights[q++] = weight * measure;
  });
  return r;
}

}  // namespace ifsi::detail
