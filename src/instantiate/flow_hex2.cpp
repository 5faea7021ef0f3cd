#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Hex2>;
template class FlowSystem<Hex2>;
template class FlowProblem<Hex2>;

}  // namespace ifsi
