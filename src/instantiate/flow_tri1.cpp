#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Tri1>;
template class FlowSystem<Tri1>;
template class FlowProblem<Tri1>;

}  // namespace ifsi
