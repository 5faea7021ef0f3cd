#include "ifsi/simulation/sphere_fall.hpp"

namespace ifsi {

FallResult fall_in_space(Run& run, const SphereOptions& o, const std::string& curve) {
  using Body = SolidBody<Tet1, UncoupledNeoHookean>;
  if (o.is_rigid()) return fall_rigid<Hex1, FluidModel<>>(run, o, curve);
  return fall_elastic<Hex1, FluidModel<>, Body>(run, o, curve);
}

}  // namespace ifsi
