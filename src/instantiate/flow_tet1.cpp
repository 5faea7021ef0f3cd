#include "ifsi/simulation/flow_problem.hpp"

namespace ifsi {

template class FlowAssembler<Tet1>;
template class FlowSystem<Tet1>;
template class FlowProblem<Tet1>;

}  // namespace ifsi
