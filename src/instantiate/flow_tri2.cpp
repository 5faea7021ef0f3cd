#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Tri2>;
template class FlowSystem<Tri2>;
template class FlowProblem<Tri2>;

}  // namespace ifsi
