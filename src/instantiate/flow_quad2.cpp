#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Quad2>;
template class FlowSystem<Quad2>;
template class FlowProblem<Quad2>;

}  // namespace ifsi
