#pragma once
/// \file
/// Points and weights of an integration rule on a reference cell.

#include <array>

#include "ifsi/core/tensor.hpp"

namespace ifsi {

/// int f dxi ~ sum_q weights[q] f(points[q]); the weights sum to the measure of the reference cell.
template <int dim, int n>
struct Rule {
  std::array<Vec<double, dim>, n> points;
  std::array<double, n> weights;
};

}  // namespace ifsi
