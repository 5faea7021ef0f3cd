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

namespace {

struct Options {
  double nu = 0.01, dt = 0.025;
  int n = 16, levels = 3;
  std::string element = "quad1", sweep = "none";
  TimeOptions time{.dt = 0.025, .end = 0.5};
  FlowOptions flow;
};

template <class Element, class Exact>
FlowProblem<Element> decay(Run& run, const Options& o, const Mesh<Element>& mesh, const Exact& exact,
                           double dt) {
  FlowBoundary<Element::dim> boundary;
  for (const std::string& side : mesh.boundary_names)
    boundary.velocity(side, [=](const auto& x, double t) { return exact.v(x, t); });
  FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{o.nu}, o.flow);
  flow.start(
      0.0, [&](const auto& x) { return exact.v(x, 0.0); }, [&](const auto& x) { return exact.v_dot(x, 0.0); },
      [&](const auto& x) { return exact.p(x, 0.0); });
  log_newton(run, flow);
  TimeOptions time = o.time;
  time.dt = dt;
  march(run, flow, time, [](double) {});
  run.totals.dofs = mesh.nodes.n_global() * (Element::dim + 1);
  return flow;
}

template <class Element, class Exact>
void study(Run& run, Options o, const Exact& exact) {
  ConvergenceTable table(run, o.sweep == "t" ? "t" : "h");
  const int levels = o.sweep == "none" ? 1 : o.levels;
  if (o.sweep == "t" && o.flow.tau_dt == 0.0) o.flow.tau_dt = o.time.dt;
  std::vector<double> before;
  for (int level = 0; level < levels; ++level) {
    const int cells = o.sweep == "h" ? o.n << level : o.n;
    const double dt = o.sweep == "none" ? o.time.dt : o.time.dt / (1 << level);
    const auto mesh = distribute(exact_domain<Element>(cells), run.comm());
    const auto flow = decay(run, o, mesh, exact, dt);
    if (o.sweep != "t")
      table.add(1.0 / cells, exact_errors(flow, exact, flow.time()));
    else if (level > 0)
      table.add(dt, difference(flow, before));
    before = flow.solution();
    write_fields(run, flow);
  }
  table.report();
  const double order_2 = Element::order == 1 ? 1.9 : 2.9;
  if (o.sweep == "h")
    run.check_at_least("order_h_v", table.order_v(), order_2, "optimal order of the element");
  if (o.sweep == "h") run.check_at_least("order_h_p", table.order_p(), 1.5, "expected of equal order");
  if (o.sweep == "t") run.check("order_t_v", table.order_v(), 2.0, 0.05, "second-order scheme (eq. 8)");
  if (o.sweep == "t") run.check("order_t_p", table.order_p(), 2.0, 0.05, "second-order scheme (eq. 10)");
}

}  // namespace

int main(int argc, char** argv) {
  return run_case(
      argc, argv, {"taylor_green", "decaying vortices in 2D and 3D, exact solution, orders in h and dt"},
      [](Run& run) {
        Options o;
        run.params.add("nu", o.nu, "length^2/time", "kinematic viscosity", positive);
        run.params.add("mesh.n", o.n, "-", "cells per side of the coarsest mesh", {2, 1024});
        run.params.add_choice("mesh.element", o.element,
                              {"quad1", "quad2", "tri1", "tri2", "hex1", "tet1", "tet2", "hex2", "wedge1"},
                              "element; its dimension decides the flow");
        run.params.add_choice("sweep", o.sweep, {"none", "h", "t"}, "what to refine");
        run.params.add("levels", o.levels, "-", "members of a sweep, each half the one before", {2, 8});
        o.time.declare(run.params);
        o.flow.declare(run.params);
        run.parse();
        dispatch_element<Quad1, Quad2, Tri1, Tri2, Hex1, Tet1, Tet2, Hex2, Wedge1>(o.element, [&]<class E>() {
          if constexpr (E::dim == 2)
            study<E>(run, o, TaylorGreen{o.nu});
          else
            study<E>(run, o, EthierSteinman{o.nu});
        });
      });
}
