// An aortic valve over one heartbeat: three leaflets open and close in a vessel with three sinuses.
//
//      z = 14.2 ______________  traction-free        model = sector: half a leaflet, between its middle plane
//              |              |                      and the plane of its commissures (60 degrees), slip on
//         2.4  |              |  end of the root     both; model = full: all three.
//             (  \  |  |  /    ) sinuses
//          0   |__\_|  |_/____|  nadirs              leaflets 1.6 high, 0.015 thick, E = 1.5e6
//              |              |                      blood: rho = 1.1, mu = 0.036
//         -4   |______________|  pressure or flow    cm, g, s (cgs); after Black et al. (2026), section 4
//               diameter 2.8
//
// Pressure and flow over time (data/curves) are assumptions; so is the geometry, which is idealised.
// Metrics: docs/cases/semilunar_valve.md. There is no reference solution: the checks are ranges of physiology
// and what the method must hold (volume, det F, regurgitation).
#include "ifsi/simulation/semilunar_valve.hpp"

using namespace ifsi;

int main(int argc, char** argv) {
  return run_case(argc, argv, {"semilunar_valve", "an aortic valve over one heartbeat"}, [](Run& run) {
    ValveOptions options;
    options.declare(run.params);
    run.parse();
    options.check();
    run_semilunar_valve(run, options, IFSI_DATA_DIR);
  });
}
