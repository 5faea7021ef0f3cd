#pragma once
/// \file
/// Inverse isoparametric map: the reference coordinates of a point of space.

#include <algorithm>
#include <cmath>

#include "ifsi/element/geometry.hpp"

namespace ifsi {

/// Where a point lies in a cell.
template <int dim>
struct InverseMap {
  Vec<double, dim> xi;  ///< reference coordinates, inside or outside the reference cell
  bool converged;       ///< whether x(xi) is the point; if not, xi is the nearest found
  double distance;      ///< |x(xi) - x|, in units of length
};

namespace detail {

/// x(xi) - x and the Jacobian there.
template <class E>
struct MapPoint {
  static constexpr int dim = E::dim;
  using Nodes = std::array<Vec<double, dim>, E::n_nodes>;
  Vec<double, dim> residual;
  Mat<double, dim> J;
  double distance2;

  MapPoint(const Vec<double, dim>& xi, const Nodes& X_minus_x) {
    std::array<Vec<double, dim>, E::n_nodes> dN;
    E::gradients(xi, dN);
    residual = map<E>(xi, X_minus_x);
    J = jacobian(dN, X_minus_x);
    distance2 = dot(residual, residual);
  }
};

/// Newton from xi on x(xi) = x, with steps halved until the distance falls and det J keeps the sign
/// `orientation`: the iterates stay in the one-to-one part of the map around the cell.
template <class E>
InverseMap<E::dim> damped_newton(const typename MapPoint<E>::Nodes& X_minus_x, Vec<double, E::dim> xi,
                                 double orientation) {
  constexpr int max_iterations = 40;
  constexpr double step_tolerance = 1e-9, shortest_damping = 1e-4;  // the error left is of order step^2
  MapPoint<E> here(xi, X_minus_x);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (!(orientation * det(here.J) > 0.0)) break;
    const Vec<double, E::dim> step = inverse(here.J) * here.residual;
    if (E::linear || dot(step, step) < step_tolerance * step_tolerance * (1.0 + dot(xi, xi))) {
      xi -= step;
      const Vec<double, E::dim> left = map<E>(xi, X_minus_x);
      return {xi, std::isfinite(dot(xi, xi)), std::sqrt(dot(left, left))};
    }
    double damping = 1.0;
    for (; damping > shortest_damping; damping *= 0.5) {
      const Vec<double, E::dim> trial_xi = xi - damping * step;
      const MapPoint<E> trial(trial_xi, X_minus_x);
      if (trial.distance2 < (1.0 - 0.5 * damping) * here.distance2 && orientation * det(trial.J) > 0.0) {
        xi = trial_xi;
        here = trial;
        break;
      }
    }
    if (damping <= shortest_damping) break;
  }
  return {xi, false, std::sqrt(here.distance2)};
}

/// Whether the point may lie in the cell: inside the box of its nodes, grown by half its size for order 2,
/// where a cell leaves that box by (L - 1) / 2 of its size at most, L <= 2 the Lebesgue constant of the
/// basis.
template <class E>
bool in_bounding_box(const typename MapPoint<E>::Nodes& X_minus_x) {
  constexpr double growth = E::order == 1 ? 1e-9 : 0.5;
  for (int i = 0; i < E::dim; ++i) {
    double low = X_minus_x[0][i], high = low;
    for (const auto& X : X_minus_x) {
      low = std::min(low, X[i]);
      high = std::max(high, X[i]);
    }
    const double margin = growth * (high - low);
    if (!(low <= margin && high >= -margin)) return false;
  }
  return true;
}

/// Whether the nodes lie within `tolerance` (in reference coordinates) of those of the affine cell with the
/// centre and Jacobian of this one. The map is then one-to-one well beyond the cell: its gradient differs
/// from the affine one by less than tolerance x sum_a |dN_a| < 1.
template <class E>
bool is_nearly_affine(const typename MapPoint<E>::Nodes& X_minus_x) {
  constexpr double tolerance = 0.05;
  const MapPoint<E> center(E::center, X_minus_x);
  const Mat<double, E::dim> J_inverse = inverse(center.J);
  for (int a = 0; a < E::n_nodes; ++a) {
    const auto affine = E::center + J_inverse * (X_minus_x[a] - center.residual);
    for (int i = 0; i < E::dim; ++i)
      if (!(std::abs(affine[i] - E::nodes[a][i]) <= tolerance)) return false;
  }
  return true;
}

/// A start near the `rank`-th nearest node of the point: that node pulled a little towards the centre.
template <class E>
Vec<double, E::dim> near_start(const typename MapPoint<E>::Nodes& X_minus_x, int rank) {
  std::array<int, E::n_nodes> nodes = same_order<E::n_nodes>();
  const auto nearer = [&](int a, int b) {
    return dot(X_minus_x[a], X_minus_x[a]) < dot(X_minus_x[b], X_minus_x[b]);
  };
  std::nth_element(nodes.begin(), nodes.begin() + rank, nodes.end(), nearer);
  return 0.75 * E::nodes[nodes[rank]] + 0.25 * E::center;
}

/// A root so near the cell that no other root can be expected inside; det J keeps its sign on the way to it.
template <class E>
bool is_trusted(const InverseMap<E::dim>& found) {
  constexpr double distance = (E::order == 1 ? 0.5 : 0.25) * -E::outside(E::center);
  return found.converged && E::contains(found.xi, distance);
}

/// Roots before failures, then the one nearest to the cell, or the failure nearest to the point.
template <class E>
const InverseMap<E::dim>& better(const InverseMap<E::dim>& a, const InverseMap<E::dim>& b) {
  if (a.converged != b.converged) return a.converged ? a : b;
  if (a.converged) return E::outside(a.xi) <= E::outside(b.xi) ? a : b;
  return a.distance <= b.distance ? a : b;
}

}  // namespace detail

/// Reference coordinates of x in the cell with nodes X, by damped Newton from `guess`.
///
/// Points outside the cell get coordinates outside the reference cell, as long as the map is one-to-one up to
/// there; elsewhere `converged` is false. A point inside a cell with det J > 0 is found also when the cell is
/// curved so much that Newton from the guess misses it: then the nodes nearest to it serve as starts.
template <ReferenceElement E>
InverseMap<E::dim> inverse_map(const std::array<Vec<double, E::dim>, E::n_nodes>& X,
                               const Vec<double, E::dim>& x, const Vec<double, E::dim>& guess = E::center) {
  constexpr int max_restarts = std::min(6, E::n_nodes);
  std::array<Vec<double, E::dim>, E::n_nodes> X_minus_x;
  for (int a = 0; a < E::n_nodes; ++a) X_minus_x[a] = X[a] - x;
  const double orientation = det(detail::MapPoint<E>(E::center, X_minus_x).J);
  const auto newton_from = [&](const auto& start) {
    return detail::damped_newton<E>(X_minus_x, start, orientation);
  };
  InverseMap<E::dim> best = newton_from(guess);
  if (!detail::is_trusted<E>(best) && guess != E::center)
    best = detail::better<E>(best, newton_from(E::center));
  if (detail::is_trusted<E>(best) || (best.converged && detail::is_nearly_affine<E>(X_minus_x)) ||
      !detail::in_bounding_box<E>(X_minus_x))
    return best;
  for (int rank = 0; rank < max_restarts && !detail::is_trusted<E>(best); ++rank)
    best = detail::better<E>(best, newton_from(detail::near_start<E>(X_minus_x, rank)));
  return best;
}

}  // namespace ifsi
