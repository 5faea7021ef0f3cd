#include "ifsi/simulation/semilunar_valve_run.hpp"

namespace ifsi {

template void run_semilunar_valve_in<Tet2>(Run&, const ValveOptions&, const std::string&);

}  // namespace ifsi
