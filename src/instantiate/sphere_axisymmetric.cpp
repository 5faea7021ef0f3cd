#include "ifsi/simulation/axisymmetric_flow.hpp"
#include "ifsi/simulation/sphere_fall.hpp"

namespace ifsi {

FallResult fall_axisymmetric(Run& run, const SphereOptions& o, const std::string& curve) {
  using Body = SolidBody<Quad1, UncoupledNeoHookean, Displacement, Axisymmetric>;
  if (o.is_rigid()) return fall_rigid<Quad1, AxisymmetricFlow>(run, o, curve);
  return fall_elastic<Quad1, AxisymmetricFlow, Body>(run, o, curve);
}

}  // namespace ifsi
