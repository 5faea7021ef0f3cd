#include "ifsi/assembly/solid_body.hpp"

namespace ifsi {

template class SolidBody<Quad1, ThinSheet<NeoHookean>>;
template class SolidBody<Quad1, ThinSheet<StVenantKirchhoff>>;
template class SolidBody<Quad1, ThinSheet<UncoupledNeoHookean>>;
template class SolidBody<Hex2, TensionFibres<ThinSheet<NeoHookean>>, FibredSheet>;

}  // namespace ifsi
