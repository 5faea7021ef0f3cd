#include "ifsi/simulation/sphere_case.hpp"

namespace ifsi {

FallResult fall(Run& run, const SphereOptions& o, const std::string& curve) {
  using Half = SolidBody<Quad1, UncoupledNeoHookean, Displacement, Axisymmetric>;
  using Whole = SolidBody<Hex1, UncoupledNeoHookean, MeanDilatation>;
  if (o.model == "axisymmetric")
    return o.is_rigid() ? fall_rigid<Quad1, AxisymmetricFlow>(run, o, curve)
                        : fall_elastic<Quad1, AxisymmetricFlow, Half>(run, o, curve);
  return o.is_rigid() ? fall_rigid<Hex1, FluidModel<>>(run, o, curve)
                      : fall_elastic<Hex1, FluidModel<>, Whole>(run, o, curve);
}

}  // namespace ifsi
