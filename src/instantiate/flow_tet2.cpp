#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Tet2>;
template class FlowSystem<Tet2>;
template class FlowProblem<Tet2>;

}  // namespace ifsi
