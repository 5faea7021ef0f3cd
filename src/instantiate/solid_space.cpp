#include "ifsi/assembly/solid_body.hpp"

namespace ifsi {

template class SolidBody<Hex2, NeoHookean>;

}  // namespace ifsi
