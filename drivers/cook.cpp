// Cook's membrane, nearly incompressible, finite strain: does an element lock?
//
//              .-' 60    clamped on the left, dead traction 6.25 N/mm upwards on the right; mm, MPa, plane
//              strain
//     44 |.-'     | ^    (in space: one cell through the thickness, u_z = 0)
//        |        | |
//        |     .-' 44    uncoupled neo-Hookean, G = 80.1938, K = 400942
//      0 |.-'     48     Reference: u_y of the upper right corner, 6.929 in the limit of fine meshes.
//
// Metrics: u_corner on the last mesh, u_<n> on each mesh of a sweep.
#include "ifsi/io/run.hpp"
#include "ifsi/simulation/dispatch.hpp"
#include "ifsi/simulation/solid_cases.hpp"
#include "ifsi/simulation/solid_output.hpp"
#include "ifsi/simulation/solid_problem.hpp"

using namespace ifsi;

namespace {

/// Deflection of the corner with n cells per side, mm.
template <class Body>
double corner_deflection(Run& run, int n) {
  constexpr int dim = Body::dim;
  SolidProblem<Body> problem(
      Body("membrane", cook_membrane<typename Body::Element>(n), UncoupledNeoHookean(80.1938, 400942), {}));
  problem.clamp("left");
  if constexpr (dim == 3)
    for (int a = 0; a < problem.body().n_nodes(); ++a) problem.prescribe(a, 2, 0.0);
  Vec<double, dim> traction{}, corner{};
  traction[1] = 6.25;
  corner[0] = 48.0, corner[1] = 60.0;
  problem.add_traction("right", traction);
  problem.solve_static();
  run.totals.dofs = problem.body().n_dofs();
  run.totals.newton += problem.newton_iterations();
  ++run.totals.steps;
  if (run.comm().is_root())  // every rank computes all of this small problem
    VtuSeries(Communicator(MPI_COMM_SELF), run.path(""), "membrane")
        .write(0.0, deformed_body(problem.body(), problem.u()));
  return problem.displacement(problem.node_at(corner))[1];
}

}  // namespace

int main(int argc, char** argv) {
  return run_case(argc, argv, {"cook", "Cook's membrane, nearly incompressible: locking"}, [](Run& run) {
    int n = 64;
    std::string element = "quad1", formulation = "mean_dilatation", sweep = "none";
    run.params.add("mesh.n", n, "-", "cells per side (of the finest mesh)", {2, 256});
    run.params.add_choice("mesh.element", element, {"quad1", "hex1", "wedge1"}, "element");
    run.params.add_choice("formulation", formulation, {"mean_dilatation", "displacement"}, "of the cells");
    run.params.add_choice("sweep", sweep, {"none", "h"}, "also the meshes with n/8, n/4 and n/2 cells");
    run.parse();

    double u = 0.0;
    dispatch_element<Quad1, Hex1, Wedge1>(element, [&]<class Element>() {
      for (int cells = sweep == "h" ? std::max(2, n / 8) : n; cells <= n; cells *= 2) {
        u = formulation == "displacement"
                ? corner_deflection<SolidBody<Element, UncoupledNeoHookean>>(run, cells)
                : corner_deflection<SolidBody<Element, UncoupledNeoHookean, MeanDilatation>>(run, cells);
        run.log(std::to_string(cells) + " cells per side: u_y = " + std::to_string(u));
        run.metric("u_" + std::to_string(cells), u, "mm");
      }
    });
    run.metric("u_corner", u, "mm");
    if (formulation == "mean_dilatation" && n >= 64)
      run.check("u_corner", u, 6.929, 0.005, "limit of fine meshes, docs/cases");
  });
}
