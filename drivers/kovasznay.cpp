// Kovasznay flow: steady, nonlinear, exact.
//
//      y = 1.5  +-------------------+
//               |  o)   the wake    |      exact velocity on all sides, zero-mean pressure
//               |  o)   of a grid   |
//      y = -0.5 +-------------------+      L. Kovasznay, Laminar flow behind a two-dimensional grid,
//            x = -0.5              1       Proc. Camb. Phil. Soc. 44 (1948) 58-62
//
// Metrics: v_l2, v_h1, p_l2 (errors on the last mesh), order_h_v, order_h_p (with sweep = h).
#include "ifsi/simulation/flow_case.hpp"

using namespace ifsi;

int main(int argc, char** argv) {
  return run_case(
      argc, argv, {"kovasznay", "steady flow behind a grid, exact solution, orders in h"}, [](Run& run) {
        double Re = 40.0;
        int n = 32, levels = 3;
        std::string element = "quad1", sweep = "none";
        FlowOptions options;
        options.newton.rtol = 1e-10;
        run.params.add("Re", Re, "-", "Reynolds number", {1.0, 200.0});
        run.params.add("mesh.n", n, "-", "cells per side of the coarsest mesh", {2, 512});
        run.params.add_choice("mesh.element", element, {"quad1", "quad2", "tri1", "tri2"}, "element");
        run.params.add_choice("sweep", sweep, {"none", "h"}, "refine the mesh and report orders");
        run.params.add("levels", levels, "-", "meshes of a sweep, each half as fine as the next", {2, 6});
        options.declare(run.params);
        run.parse();

        const Kovasznay exact{Re};
        ConvergenceTable table(run, "h");
        dispatch_element<Quad1, Quad2, Tri1, Tri2>(element, [&]<class Element>() {
          for (int level = 0; level < (sweep == "h" ? levels : 1); ++level) {
            const int cells = n << level;
            const auto mesh = distribute(box<Element>({-0.5, -0.5}, {1.0, 1.5}, {cells, cells}), run.comm());
            FlowBoundary<2> boundary;
            for (const char* side : {"left", "right", "bottom", "top"})
              boundary.velocity(side, [=](const auto& x, double t) { return exact.v(x, t); });
            FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{1.0 / Re}, options);
            solve_steady(run, flow);
            table.add(2.0 / cells, exact_errors(flow, exact, 0.0));
            write_fields(run, flow);
          }
        });
        table.report();
        table.check_orders(element == "quad2" || element == "tri2" ? 2 : 1);
      });
}
