// The contract of the solid kernel on elements of the plane, Cartesian and of revolution.
#include "solid/solid_cell_contract.hpp"

namespace ifsi::testing {
using Plane = ::testing::Types<Case<Tri1, Displacement, Cartesian>, Case<Tri2, Displacement, Cartesian>,
                               Case<Quad1, Displacement, Cartesian>, Case<Quad2, Displacement, Cartesian>,
                               Case<Quad1, MeanDilatation, Cartesian>,
                               Case<Quad1, MeanDilatation, Cartesian, UncoupledNeoHookean>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Plane, SolidCellContract, Plane);

using Revolution =
    ::testing::Types<Case<Tri1, Displacement, Axisymmetric>, Case<Quad2, Displacement, Axisymmetric>,
                     Case<Quad1, MeanDilatation, Axisymmetric>,
                     Case<Quad1, MeanDilatation, Axisymmetric, UncoupledNeoHookean>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Revolution, SolidCellContract, Revolution);
}  // namespace ifsi::testing
