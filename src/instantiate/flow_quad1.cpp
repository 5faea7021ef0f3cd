#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Quad1>;
template class FlowSystem<Quad1>;
template class FlowProblem<Quad1>;

}  // namespace ifsi
