#include "ifsi/simulation/semilunar_valve_run.hpp"

namespace ifsi {

void run_semilunar_valve(Run& run, const ValveOptions& options, const std::string& data) {
  const NeoHookean law(Lame::from_young(options.E, options.nu));
  const Vec<double, 3> unused = {0.0, 0.0, 1.0};  // each point has its own directions
  if (!options.law.is_sheet())
    return run_semilunar_valve<Hex2, Fibred>(run, options, data, TensionFibres(law, options.fibres, unused));
  run_semilunar_valve<Hex2, FibredSheet>(
      run, options, data, TensionFibres(options.law.sheet(law, unused), options.fibres, unused));
}

}  // namespace ifsi
