#include "ifsi/assembly/solid_body.hpp"

namespace ifsi {

template class SolidBody<Quad1, NeoHookean>;
template class SolidBody<Quad1, StVenantKirchhoff>;
template class SolidBody<Quad1, UncoupledNeoHookean>;
template class SolidBody<Quad1, UncoupledNeoHookean, Displacement, Axisymmetric>;
template class SolidBody<Quad1, CircumferentialFibre>;
template class SolidBody<Quad2, StVenantKirchhoff>;

}  // namespace ifsi
