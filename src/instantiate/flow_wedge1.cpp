#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Wedge1>;
template class FlowSystem<Wedge1>;
template class FlowProblem<Wedge1>;

}  // namespace ifsi
