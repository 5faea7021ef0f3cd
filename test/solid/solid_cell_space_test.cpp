// The contract of the solid kernel on elements in space.
#include "solid/solid_cell_contract.hpp"

namespace ifsi::testing {
using Space = ::testing::Types<Case<Tet1, Displacement, Cartesian>, Case<Hex1, Displacement, Cartesian>,
                               Case<Wedge1, Displacement, Cartesian>, Case<Hex1, MeanDilatation, Cartesian>,
                               Case<Wedge1, MeanDilatation, Cartesian>,
                               Case<Hex1, MeanDilatation, Cartesian, UncoupledNeoHookean>,
                               Case<Wedge1, MeanDilatation, Cartesian, UncoupledNeoHookean>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Space, SolidCellContract, Space);
}  // namespace ifsi::testing
