#include "ifsi/simulation/axisymmetric_flow.hpp"

namespace ifsi {

template class FlowAssembler<Quad1, AxisymmetricFlow>;
template class FlowSystem<Quad1, AxisymmetricFlow>;
template class FlowProblem<Quad1, AxisymmetricFlow>;

}  // namespace ifsi
