#pragma once
/// \file
/// Flow in cylindrical coordinates (r, z) without swirl.

#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

using AxisymmetricFlow = FluidModel<NavierStokes, Newtonian, Axisymmetric>;

// Compiled once, in src/instantiate.
extern template class FlowAssembler<Quad1, AxisymmetricFlow>;
extern template class FlowSystem<Quad1, AxisymmetricFlow>;
extern template class FlowProblem<Quad1, AxisymmetricFlow>;

}  // namespace ifsi
