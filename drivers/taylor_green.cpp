// Decaying vortices with an exact solution: orders in h and dt for velocity and pressure.
//
//      2D: Taylor & Green on [0, 1]^2           3D: Ethier & Steinman on [-1, 1]^3
//          +-----------+                        G. I. Taylor, A. E. Green, Proc. R. Soc. A 158 (1937) 499
//          | (  ) (  ) |   exact velocity on    C. R. Ethier, D. A. Steinman, Int. J. Numer. Meth. Fluids 19
//          | (  ) (  ) |   all sides            (1994) 369-375
//          +-----------+
//
// Metrics: v_l2, v_h1, p_l2 at the end; order_h_v, order_h_p (sweep = h, errors against the exact flow, dt ~
// h) or order_t_v, order_t_p (sweep = t, errors against the next finer step on one mesh with tau_M's time
// step held).
#include "ifsi/simulation/flow_case.hpp"

using namespace ifsi;

struct Options {
  double nu = 0.01;
  int n = 16, levels = 3;
  std::string element = "quad1", sweep = "none";
  TimeOptions time;
  FlowOptions flow;
};

template <class Element, class Exact>
FlowProblem<Element> decay(Run& run, const Options& o, const Mesh<Element>& mesh, const Exact& exact) {
  FlowBoundary<Element::dim> boundary;
  for (const std::string& side : mesh.boundary_names)
    boundary.velocity(side, [=](const auto& x, double t) { return exact.v(x, t); });
  FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{o.nu}, o.flow);
  flow.start(
      0.0, [&](const auto& x) { return exact.v(x, 0.0); }, [&](const auto& x) { return exact.v_dot(x, 0.0); },
      [&](const auto& x) { return exact.p(x, 0.0); });
  attach(run, flow);
  march(run, flow, o.time, [](double) {});
  return flow;
}

template <class Element, class Exact>
void study(Run& run, Options o, const Exact& exact) {
  ConvergenceTable table(run, o.sweep == "t" ? "t" : "h");
  if (o.sweep == "t" && o.flow.tau_dt == 0.0) o.flow.tau_dt = o.time.dt;
  std::vector<double> before;
  for (int level = 0; level < (o.sweep == "none" ? 1 : o.levels); ++level) {
    const int cells = o.sweep == "h" ? o.n << level : o.n;
    const auto mesh = distribute(exact_domain<Element>(cells), run.comm());
    const auto flow = decay(run, o, mesh, exact);
    if (o.sweep != "t") table.add(1.0 / cells, exact_errors(flow, exact, flow.time()));
    if (o.sweep == "t" && level > 0) table.add(o.time.dt, difference(flow, before));
    before = flow.solution();
    write_fields(run, flow);
    o.time.dt *= 0.5;
  }
  table.report();
  table.check_orders(Element::order);
}

void taylor_green(Run& run) {
  Options o;
  o.time.dt = 0.025, o.time.end = 0.5;
  run.params.add("nu", o.nu, "length^2/time", "kinematic viscosity", positive);
  run.params.add("mesh.n", o.n, "-", "cells per side of the coarsest mesh", {2, 1024});
  run.params.add_choice("mesh.element", o.element,
                        {"quad1", "quad2", "tri1", "tri2", "hex1", "hex2", "tet1", "tet2", "wedge1"},
                        "its dimension decides the flow");
  run.params.add_choice("sweep", o.sweep, {"none", "h", "t"}, "what to refine");
  run.params.add("levels", o.levels, "-", "members of a sweep, each half the one before", {2, 8});
  o.time.declare(run.params);
  o.flow.declare(run.params);
  run.parse();
  dispatch_element<Quad1, Quad2, Tri1, Tri2, Hex1, Tet1, Tet2, Hex2, Wedge1>(o.element, [&]<class E>() {
    using Exact = std::conditional_t<E::dim == 2, TaylorGreen, EthierSteinman>;
    study<E>(run, o, Exact{o.nu});
  });
}

int main(int argc, char** argv) {
  return run_case(argc, argv,
                  {"taylor_green", "decaying vortices in 2D and 3D, exact solution, orders in h and dt"},
                  taylor_green);
}
