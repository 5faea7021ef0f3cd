// What the patch of a thin sheet in space costs (eq. 19): unknowns, CPU seconds and flops of its LU, GMRES
// iterations and CPU seconds of a solve, over the layers of the patch, the time step and the stiffness.
//
// A sheet as thin as a leaflet of a valve stands across a channel between two symmetry planes. It is marched
// through its first steps, with set-ups of the fluid kept while they serve; then the first tangent of a step
// is made anew with other values and solved to 1e-6 in both blocks, with a fresh set-up.
#include <ctime>

#include "ifsi/io/run.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/generators.hpp"
#include "ifsi/simulation/fsi_problem.hpp"

using namespace ifsi;

namespace {

using Body = SolidBody<Hex1, NeoHookean, MeanDilatation>;
using Problem = FsiProblem<Tet1, Body>;

struct Values {
  int n = 16;  ///< fluid cells per unit of length
  double E = 2e7, dt = 1e-3, s = 1.0, speed = 20.0;
  int layers = 2;
  std::string base = "auto";
};

FlowBoundary<3> boundary(double speed) {
  FlowBoundary<3> conditions;
  conditions.velocity("left", [=](const auto& x, double t) {
    return Vec<double, 3>{speed * std::min(1.0, 20.0 * t) * x[1] * (2.0 - x[1]), 0.0, 0.0};
  });
  conditions.traction_free("right"), conditions.no_slip("bottom"), conditions.slip("top");
  conditions.slip("front"), conditions.slip("back");
  return conditions;
}

std::unique_ptr<Problem> make_problem(const Mesh<Tet1>& mesh, const Values& v) {
  FlowOptions flow;
  flow.rho_inf = 0.0;
  FsiOptions fsi;
  fsi.s.s_max = v.s, fsi.patch_layers = v.layers, fsi.linear.base = v.base;
  std::vector<Body> bodies;
  const int across = static_cast<int>(1.2 * v.n);
  bodies.emplace_back(
      "sheet", box<Hex1>({0.97, 0.0, 0.0}, {1.0, 0.7, 1.0}, {1, static_cast<int>(0.7 * across), across}),
      NeoHookean(Lame::from_young(v.E, 0.4)),
      Body::Parameters{.rho_s = 1.0, .rho_f = 1.1, .mu_f = 0.036, .mu_s = 0.0, .gravity = {}});
  auto problem =
      std::make_unique<Problem>(mesh, boundary(v.speed), 1.1, Newtonian{0.036}, std::move(bodies), flow, fsi);
  problem->start(0.0, [](const auto&) { return Vec<double, 3>::zero(); });
  return problem;
}

/// CPU seconds of a piece of work, summed over the ranks.
template <class Work>
double cpu_seconds(const Communicator& comm, Work&& work) {
  const std::clock_t before = std::clock();
  work();
  return comm.sum(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
}

/// Checkpoint after some steps.
std::string march(Run& run, const Mesh<Tet1>& mesh, const Values& v, int steps) {
  const auto problem = make_problem(mesh, v);
  int newton = 0, gmres = 0;
  double largest = 0.0;
  const double seconds = cpu_seconds(run.comm(), [&] {
    for (int k = 0; k < steps; ++k) {
      const NewtonReport report = problem->step(v.dt);
      if (!report.converged) throw Error(ExitCode::nonlinear, "sheet: " + report.failure);
      newton += report.iterations, gmres += report.gmres;
      largest = std::max(largest, static_cast<double>(report.gmres) / report.iterations);
    }
  });
  char line[240];
  std::snprintf(line, sizeof line,
                "%d layers, s %.0e: %d steps, %d Newton and %d GMRES iterations (at most %.0f per solve), %d "
                "set-ups, %.1f s of CPU",
                v.layers, v.s, steps, newton, gmres, largest, problem->linear_solver().setups(), seconds);
  run.log(line);
  CheckpointWriter checkpoint(run.comm());
  problem->save(checkpoint);
  return checkpoint.save(run.path(""), steps);
}

/// First linear solve of a step from a state.
void solve(Run& run, CsvFile& csv, const Mesh<Tet1>& mesh, const std::string& state, const Values& v) {
  const auto problem = make_problem(mesh, v);
  problem->restore(Checkpoint(mesh.comm, state));
  problem->begin_step(v.dt);
  problem->assemble_tangent();
  SolverReport report;
  const double total = cpu_seconds(run.comm(), [&] { report = problem->solve({1e-6, 1e-6}); });
  const BlockCsr<4>& patch = problem->linear_solver().patch_matrix();
  DirectSolver lu(DirectSolver::Work::shared);
  const double analysis = cpu_seconds(run.comm(), [&] { lu.factor(patch); }),
               factor = cpu_seconds(run.comm(), [&] { lu.factor(patch); });
  std::vector<double> b(patch.layout().n_local() * 4, 1.0), x(b);
  const double apply = cpu_seconds(run.comm(), [&] { lu.apply(b.data(), x.data()); });
  char line[240];
  std::snprintf(
      line, sizeof line,
      "%7ld + %6ld in %d layers, E %.0e dt %.0e s %.0e: %3d iterations%s, %6.2f s; LU %.2f + %.2f s, "
      "%.1f Gflop, %.1f M, solve %.3f s",
      mesh.nodes.n_global() * 4, problem->linear_solver().patch_unknowns(), v.layers, v.E, v.dt, v.s,
      report.iterations, report.converged ? "" : "!", total, analysis - factor, factor,
      1e-9 * lu.cost().flops, 1e-6 * lu.cost().lu_entries, apply);
  run.log(line);
  csv.row({mesh.nodes.n_global() * 4.0, double(problem->linear_solver().patch_unknowns()), double(v.layers),
           v.E, v.dt, v.s, double(report.iterations), double(report.converged), total, factor, apply});
}

}  // namespace

int main(int argc, char** argv) {
  return run_case(argc, argv, {"bench_sheet", "cost of the patch of a thin sheet in space"}, [](Run& run) {
    Values v;
    int steps = 5;
    std::vector<double> E{2e7}, dt{1e-4, 1e-3, 1e-2}, s{1.0}, layers{0, 1, 2};
    run.params.add("n", v.n, "-", "fluid cells per unit of length", {4, 200});
    run.params.add("steps", steps, "-", "before the step that is solved", {1, 1000});
    run.params.add("speed", v.speed, "cm/s", "of the inflow after 0.05 s", positive);
    run.params.add("E", E, "dyn/cm^2", "Young's moduli");
    run.params.add("dt", dt, "s", "time steps");
    run.params.add("s", s, "-", "scales s of tau_M around the solid");
    run.params.add("layers", layers, "-", "layers of the patch");
    run.params.add_choice("base", v.base, {"auto", "direct", "gmres"}, "preconditioner of the fluid alone");
    run.parse();
    CsvFile csv = run.csv("sheet.csv", {{"unknowns", "-"},
                                        {"patch", "-"},
                                        {"layers", "-"},
                                        {"E", "dyn/cm^2"},
                                        {"dt", "s"},
                                        {"s", "-"},
                                        {"iterations", "-"},
                                        {"converged", "-"},
                                        {"solve", "s"},
                                        {"factor", "s"},
                                        {"apply", "s"}});
    const auto mesh =
        distribute(box<Tet1>({0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}, {2 * v.n, v.n, v.n}), run.comm());
    for (double n_layers : layers)
      for (double scale : s) {
        v.layers = static_cast<int>(n_layers), v.s = scale;
        const std::string state = march(run, mesh, v, steps);
        for (double modulus : E)
          for (double step : dt) {
            Values w = v;
            w.E = modulus, w.dt = step;
            solve(run, csv, mesh, state, w);
          }
      }
  });
}
