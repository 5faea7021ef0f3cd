#include "ifsi/simulation/fsi_problem.hpp"

namespace ifsi {

template class ImmersedSolids<SolidBody<Quad1, NeoHookean>>;
template class ImmersedSolids<SolidBody<Quad1, ThinSheet<NeoHookean>>>;
template class FsiProblem<Quad1, SolidBody<Quad1, NeoHookean>>;
template class FsiProblem<Quad1, SolidBody<Quad1, ThinSheet<NeoHookean>>>;
template class FsiProblem<Quad2, SolidBody<Quad1, NeoHookean>>;
template class FsiProblem<Quad2, SolidBody<Quad1, ThinSheet<NeoHookean>>>;

}  // namespace ifsi
