#include "ifsi/simulation/semilunar_valve_run.hpp"

namespace ifsi {

void run_semilunar_valve(Run& run, const ValveOptions& options, const std::string& data) {
  run_semilunar_valve<Hex2>(run, options, data);
}

}  // namespace ifsi
