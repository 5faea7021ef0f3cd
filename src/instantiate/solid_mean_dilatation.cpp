#include "ifsi/assembly/solid_body.hpp"

namespace ifsi {

template class SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation>;
template class SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation, Axisymmetric>;
template class SolidBody<Hex1, UncoupledNeoHookean, MeanDilatation>;
template class SolidBody<Wedge1, UncoupledNeoHookean, MeanDilatation>;
template class SolidBody<Hex1, NeoHookean, MeanDilatation>;
template class SolidBody<Wedge1, NeoHookean, MeanDilatation>;

}  // namespace ifsi
