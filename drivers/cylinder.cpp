// Flow around a cylinder in a channel, the benchmark of Schaefer and Turek.
//
//          ______________________________________________
//     u -> |   __                                        |     2D-1: steady, Re 20
//     u -> |  (__)   ~  ~  ~  ~                          | ->  2D-2: periodic, Re 100
//     u -> |______________________________________________|     2D-3: inflow sin(pi t / 8)
//                                                              3D-1Z: steady, Re 20, square section
//
// M. Schaefer, S. Turek, Benchmark computations of laminar flow around a cylinder, 1996; references in
// data/cases/. Metrics: cd, cl, dp (steady), cd_max, cl_max, cl_amplitude, strouhal, dp_end (in time),
// n_unknowns.
#include "ifsi/simulation/cylinder_flow.hpp"
#include "ifsi/simulation/flow_case.hpp"

using namespace ifsi;

struct Options {
  std::string problem = "2D-1", element = "quad2";
  double refinement = 1.0, settle = 0.0;
  int n_layers = 16, frames = 40;
  TimeOptions time;
  FlowOptions flow;
};

template <class Element>
void cylinder(Run& run, const Options& o) {
  const CylinderFlow<Element::dim> setup(o.problem);
  const auto mesh = distribute(cylinder_mesh<Element>(o.refinement, o.n_layers), run.comm());
  FlowProblem<Element> flow(mesh, setup.boundary(), 1.0, Newtonian{setup.nu}, o.flow);
  attach(run, flow);
  run.metric("n_unknowns", static_cast<double>(run.totals.dofs));
  const Probe<Element> faces(mesh, {setup.front, setup.back});
  CylinderFigures figures;
  const auto measure = [&] {
    const auto p = faces.values(flow.solution(), Element::dim + 1);
    const auto F = setup.force_scale * flow.force("cylinder");
    figures.add(flow.time(), flow.state().time_alpha(), F[0], F[1],
                p[Element::dim] - p[2 * Element::dim + 1]);
  };
  if (setup.steady) {
    solve_steady(run, flow);
    measure();
    write_fields(run, flow, {"cylinder"});
    return figures.report_steady(run, o.problem);
  }
  CsvFile history = run.csv("history.csv", {{"t", "s"}, {"cd", "-"}, {"cl", "-"}, {"dp", "Pa"}}, flow.time());
  VtuSeries series(run.comm(), run.path(""), "fluid");
  if (run.restarted()) series.resume(flow.time());
  double next_frame = flow.time();
  march(run, flow, o.time, [&](double) {
    measure();
    history.row({flow.time(), figures.cd.last(), figures.cl.last(), figures.dp.last()});
    if (flow.time() < next_frame && flow.time() < o.time.end) return;
    write_fields(series, flow, {"cylinder"});
    next_frame += o.time.end / o.frames;
  });
  figures.report_transient(run, o.problem, o.settle);
}

int main(int argc, char** argv) {
  return run_case(
      argc, argv, {"cylinder", "channel flow around a cylinder: 2D-1, 2D-2, 2D-3 and 3D-1Z"}, [](Run& run) {
        Options o;
        o.time.dt = 0.005, o.time.end = 8.0, o.flow.newton.rtol = 1e-7;
        run.params.add_choice("problem", o.problem, {"2D-1", "2D-2", "2D-3", "3D-1Z"}, "which of the flows");
        run.params.add_choice("mesh.element", o.element,
                              {"quad1", "quad2", "tri1", "tri2", "hex1", "hex2", "wedge1"}, "element");
        run.params.add("mesh.refinement", o.refinement, "-", "factor on all cell counts", {0.1, 16.0});
        run.params.add("mesh.n_layers", o.n_layers, "-", "cells across the channel in 3D", {2, 256});
        run.params.add("time.settle", o.settle, "time", "figures are taken from here on", non_negative);
        run.params.add("output.frames", o.frames, "-", "pictures of a run in time", {1, 10000});
        o.time.declare(run.params);
        o.flow.declare(run.params);
        run.parse();
        dispatch_element<Quad2, Quad1, Tri1, Tri2, Hex1, Hex2, Wedge1>(
            o.element, [&]<class E>() { cylinder<E>(run, o); });
      });
}
