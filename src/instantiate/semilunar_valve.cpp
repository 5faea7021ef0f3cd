#include "ifsi/simulation/dispatch.hpp"
#include "ifsi/simulation/semilunar_valve_run.hpp"

namespace ifsi {

template void run_semilunar_valve_in<Tet1>(Run&, const ValveOptions&, const std::string&);

void run_semilunar_valve(Run& run, const ValveOptions& options, const std::string& data) {
  dispatch_element<Tet1, Tet2>(options.element,
                               [&]<class Element>() { run_semilunar_valve_in<Element>(run, options, data); });
}

}  // namespace ifsi
