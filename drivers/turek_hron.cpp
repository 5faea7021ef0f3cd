// The benchmark of Turek & Hron: a flag behind a cylinder in a channel.
//
//          ____________________________________________________
//     u -> |   __                                               |   CFD1-3: the flag is rigid
//     u -> |  (__)==========   0.35 x 0.02                      | ->  CSM1-3: the flag alone, in gravity
//     u -> |____________________________________________________|   FSI1-3: both, the flag immersed
//
// S. Turek, J. Hron, Proposal for numerical benchmarking of fluid-structure interaction, 2006. In CFD tests
// the flag is a hole in the mesh; in FSI tests the cylinder is one, and the flag an immersed body. Metrics:
// drag, lift on cylinder and flag; tip_ux, tip_uy; in periodic tests their _mean, _amplitude, _frequency.
#include "ifsi/simulation/turek_hron_csm.hpp"
#include "ifsi/simulation/turek_hron_flow.hpp"

using namespace ifsi;

int main(int argc, char** argv) {
  return run_case(
      argc, argv, {"turek_hron", "a flag behind a cylinder: CFD1-3, CSM1-3, FSI1-3"}, [](Run& run) {
        std::string name = "FSI1", element = "quad1";
        TurekHronOptions o;
        CsmOptions csm;
        run.params.add_choice("test", name,
                              {"CFD1", "CFD2", "CFD3", "CSM1", "CSM2", "CSM3", "FSI1", "FSI2", "FSI3"},
                              "which of the tests");
        run.params.add_choice("mesh.element", element, {"quad1", "quad2"}, "element of the fluid");
        o.declare(run.params), csm.declare(run.params);
        run.parse();
        if (name.starts_with("CSM")) return run_csm(run, name[3] - '0', csm);
        dispatch_element<Quad1, Quad2>(element, [&]<class Element>() {
          if (name.starts_with("CFD"))
            run_turek_hron_cfd<Element>(run, TurekHronTest(name), o);
          else
            run_turek_hron_fsi<Element>(run, TurekHronTest(name), o);
        });
      });
}
