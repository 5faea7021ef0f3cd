#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Hex1>;
template class FlowSystem<Hex1>;
template class FlowProblem<Hex1>;

}  // namespace ifsi
