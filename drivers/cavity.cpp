// Lid-driven cavity: steady flow at Re 100, 400, 1000 beside the table of Ghia et al.
//
//               u = 1 ->
//          +-------------+
//          |   (     )   |     no slip on the other sides, zero-mean pressure
//          |  (   o   )  |
//          |   (     )   |     U. Ghia, K. N. Ghia, C. T. Shin, J. Comput. Phys. 48 (1982) 387-411
//          +-------------+
//
// Metrics: deviation_u, deviation_v: largest difference to the table, as a part of the lid's speed. At Re
// 1000 the table is off by up to 0.019 beside the right wall; there the extremes u_min, v_max, v_min on the
// middle lines count, beside the spectral ones of O. Botella, R. Peyret, Comput. Fluids 27 (1998) 421-433.
#include "ifsi/simulation/cavity_lines.hpp"
#include "ifsi/simulation/flow_case.hpp"

using namespace ifsi;

int main(int argc, char** argv) {
  return run_case(
      argc, argv, {"cavity", "lid-driven cavity, steady, beside Ghia et al. (1982)"}, [](Run& run) {
        double Re = 100.0;
        int n = 64;
        double grading = 1.0;
        std::string element = "quad1", data = IFSI_DATA_DIR "/reference";
        FlowOptions options;
        options.newton.rtol = 1e-9;
        run.params.add("Re", Re, "-", "Reynolds number; the table knows 100, 400 and 1000", {1.0, 1000.0});
        run.params.add("mesh.n", n, "-", "cells per side", {4, 1024});
        run.params.add("mesh.grading", grading, "-", "middle cell over wall cell", {0.1, 100.0});
        run.params.add_choice("mesh.element", element, {"quad1", "quad2", "tri1", "tri2"}, "element");
        run.params.add("data", data, "-", "folder of the reference tables");
        options.declare(run.params);
        run.parse();

        dispatch_element<Quad1, Quad2, Tri1, Tri2>(element, [&]<class Element>() {
          const Axis axis = symmetric_axis(0.0, 1.0, n, grading);
          const auto mesh = distribute(box<Element>({axis, axis}), run.comm());
          FlowBoundary<2> boundary;
          boundary.velocity("top", [](const auto&, double) { return Vec<double, 2>{1.0, 0.0}; });
          for (const char* side : {"left", "right", "bottom"}) boundary.no_slip(side);
          FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{1.0 / Re}, options);
          solve_steady(run, flow);
          write_fields(run, flow);

          const auto u = flow.solution();
          compare_with_ghia(run, MiddleLine<Element>{mesh, u, 1, 0}, "u", data + "/ghia_u_x0.5.csv",
                            std::lround(Re));
          compare_with_ghia(run, MiddleLine<Element>{mesh, u, 0, 1}, "v", data + "/ghia_v_y0.5.csv",
                            std::lround(Re));
        });
      });
}
