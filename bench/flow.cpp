// Speed against error of the flow solver: Taylor-Green over (element, h, dt), cylinder 2D-1, growth with the
// mesh.
#include <ctime>

#include "ifsi/simulation/cylinder_flow.hpp"
#include "ifsi/simulation/flow_case.hpp"

using namespace ifsi;

namespace {

/// CPU seconds of all ranks since its construction.
class CpuClock {
 public:
  explicit CpuClock(const Communicator& comm) : comm_(comm), start_(std::clock()) {}
  [[nodiscard]] double seconds() const {
    return comm_.sum(static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC);
  }

 private:
  const Communicator& comm_;
  std::clock_t start_;
};

struct Row {
  double unknowns, steps, cpu, error;
  [[nodiscard]] double us() const { return 1e6 * cpu / (unknowns * steps); }
};

/// Taylor-Green (2D) or Ethier-Steinman (3D) to `end` in steps of dt; the error is relative to the exact
/// velocity.
template <class Element>
Row vortex(Run& run, int n, double dt, double end, const std::string& method, double nu = 0.01) {
  using Exact = std::conditional_t<Element::dim == 2, TaylorGreen, EthierSteinman>;
  const Exact exact{nu};
  const auto mesh = distribute(exact_domain<Element>(n), run.comm());
  FlowBoundary<Element::dim> boundary;
  for (const std::string& side : mesh.boundary_names)
    boundary.velocity(side, [=](const auto& x, double t) { return exact.v(x, t); });
  FlowOptions options;
  options.linear.method = method;
  FlowProblem<Element> flow(mesh, boundary, 1.0, Newtonian{exact.nu}, options);
  flow.start(
      0.0, [&](const auto& x) { return exact.v(x, 0.0); }, [&](const auto& x) { return exact.v_dot(x, 0.0); },
      [&](const auto& x) { return exact.p(x, 0.0); });
  const int steps = static_cast<int>(std::lround(end / dt));
  const CpuClock clock(run.comm());
  for (int k = 0; k < steps; ++k) {
    const NewtonReport report = flow.step(dt);
    if (!report.converged) throw Error(ExitCode::nonlinear, "bench flow: " + report.failure);
    run.totals.newton += report.iterations, run.totals.gmres += report.gmres, ++run.totals.steps;
  }
  const double cpu = clock.seconds();
  const double error = exact_errors(flow, exact, flow.time()).v_l2;
  const std::vector<double> rest(static_cast<std::size_t>(mesh.n_nodes()) * FlowProblem<Element>::B, 0.0);
  const double size =
      flow_errors<Cartesian>(
          mesh, rest, [&](const auto& x) { return exact.v(x, flow.time()); }, [](const auto&) { return 0.0; },
          [](const auto&) { return Mat<double, Element::dim>::zero(); })
          .v_l2;
  return {static_cast<double>(mesh.nodes.n_global()) * FlowProblem<Element>::B, static_cast<double>(steps),
          cpu, error / size};
}

void pareto(Run& run, const std::string& method, int largest) {
  CsvFile csv = run.csv("taylor_green.csv", {{"order", "-"},
                                             {"n", "-"},
                                             {"dt", "-"},
                                             {"unknowns", "-"},
                                             {"cpu", "s"},
                                             {"us_per_unknown_step", "us"},
                                             {"v_rel", "-"}});
  const auto add = [&](const char* name, int order, int n, double dt, const Row& r) {
    csv.row({static_cast<double>(order), static_cast<double>(n), dt, r.unknowns, r.cpu, r.us(), r.error});
    char line[160];
    std::snprintf(line, sizeof line,
                  "%-6s n %4d dt %.4f  unknowns %8.0f  cpu %8.3f s  %6.2f us/unknown/step  v_rel %.2e", name,
                  n, dt, r.unknowns, r.cpu, r.us(), r.error);
    run.log(line);
    run.metric(
        std::string("us_") + name + "_n" + std::to_string(n) + "_dt" + std::to_string(std::lround(1.0 / dt)),
        r.us(), "us");
  };
  for (double dt : {0.1, 0.05, 0.025, 0.0125})
    for (int n = 16; n <= largest; n *= 2) {
      add("quad1", 1, n, dt, vortex<Quad1>(run, n, dt, 1.0, method));
      add("quad2", 2, n / 2, dt, vortex<Quad2>(run, n / 2, dt, 1.0, method));
      add("tri1", 1, n, dt, vortex<Tri1>(run, n, dt, 1.0, method));
    }
}

template <class Element>
void growth(Run& run, const std::vector<double>& sizes, const std::string& method, double nu) {
  CsvFile csv = run.csv(std::string("growth_") + Element::name + ".csv",
                        {{"unknowns", "-"}, {"us_per_unknown_step", "us"}, {"v_rel", "-"}});
  for (double size : sizes) {
    const int n = static_cast<int>(size);
    const double dt = 0.4 / n, steps = 10;
    const long gmres_before = run.totals.gmres;
    const Row r = vortex<Element>(run, n, dt, steps * dt, method, nu);
    csv.row({r.unknowns, r.us(), r.error});
    run.log(std::string(Element::name) + "  " + std::to_string(std::lround(r.unknowns)) +
            " unknowns: " + std::to_string(r.us()) + " us per unknown and step, " +
            std::to_string(run.totals.gmres - gmres_before) + " GMRES iterations");
    run.metric(std::string("growth_") + Element::name + "_" + std::to_string(n), r.us(), "us");
  }
}

void cylinder(Run& run) {
  CsvFile csv =
      run.csv("cylinder_2D1.csv", {{"unknowns", "-"}, {"newton", "-"}, {"cpu", "s"}, {"cd_error", "-"}});
  for (double refinement : {0.4, 0.6, 0.8, 1.0}) {
    const CylinderFlow<2> setup("2D-1");
    const auto mesh = distribute(cylinder_mesh<Quad2>(refinement, 0), run.comm());
    FlowOptions options;
    options.newton.rtol = 1e-7;
    options.linear.method = "direct";
    FlowProblem<Quad2> flow(mesh, setup.boundary(), 1.0, Newtonian{setup.nu}, options);
    const CpuClock clock(run.comm());
    const NewtonReport report = solve_steady(run, flow);
    const double cpu = clock.seconds(), cd = setup.force_scale * flow.force("cylinder")[0];
    const double error = std::abs(cd / 5.57953523384 - 1.0), unknowns = 3.0 * mesh.nodes.n_global();
    csv.row({unknowns, static_cast<double>(report.iterations), cpu, error});
    char line[160];
    std::snprintf(
        line, sizeof line,
        "cylinder 2D-1  unknowns %6.0f  newton %d  cpu %.3f s  %.1f us/unknown/iteration  cd error %.1e",
        unknowns, report.iterations, cpu, 1e6 * cpu / unknowns / report.iterations, error);
    run.log(line);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_case(argc, argv, {"bench_flow", "speed against error of the flow solver"}, [](Run& run) {
    std::string part = "all", method = "auto";
    int largest = 64;
    double nu = 0.01;
    std::vector<double> plane{57, 182, 577}, space{13, 28, 62};
    run.params.add_choice("part", part, {"all", "pareto", "growth", "cylinder"}, "what to measure");
    run.params.add_choice("linear.method", method, {"auto", "direct", "gmres"}, "linear solver");
    run.params.add("largest", largest, "-", "cells per side of the finest mesh of the Pareto plot",
                   {16, 512});
    run.params.add("plane", plane, "-", "growth in the plane: cells per side; may be empty");
    run.params.add("nu", nu, "length^2/time", "kinematic viscosity of the growth", {1e-6, 1.0});
    run.params.add("space", space, "-", "growth in space");
    run.parse();
    if (part == "all" || part == "pareto") pareto(run, method, largest);
    if (part == "all" || part == "cylinder") cylinder(run);
    if (part != "all" && part != "growth") return;
    growth<Quad1>(run, plane, method, nu);
    growth<Hex1>(run, space, method, nu);
  });
}
