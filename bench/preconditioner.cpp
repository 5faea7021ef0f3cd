// GMRES iterations of the patched solver on tangents of thin leaflets, over stiffness, time step and
// stabilisation.
//
// Each valve is marched through its first steps with its own parameters. At two of the states it went
// through, the first tangent of a step is then made anew with other E, dt and s, and solved to 1e-6 in both
// blocks: at the later state with a fresh set-up of the fluid, with the one kept from the earlier state, and
// with what the solver makes of that in the solve after.
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

namespace {

using Body = SolidBody<Quad1, NeoHookean>;
using Problem = FsiProblem<Quad1, Body>;

struct Scene {
  const char* name;
  double length, height, dt;
  std::vector<std::array<double, 4>> beams;  ///< x_0, y_0, x_1, y_1
  std::array<int, 2> cells;
};

const Scene open_valve{"open",   8.0, 1.61, 5e-3, {{1.9788, 0.91, 2.0, 1.61}, {1.9788, 0.0, 2.0, 0.7}},
                       {129, 32}};
const Scene closed_valve{"closed", 4.0, 1.0, 1e-2, {{1.9894, 0.0, 2.0106, 1.0}}, {128, 32}};

struct Values {
  double E = 5.6e7, dt = 0.0, s = 1.0;
  int layers = -1;
  std::string base = "auto";
};

FlowBoundary<2> boundary(const Scene& scene) {
  FlowBoundary<2> conditions;
  if (scene.beams.size() == 1)
    conditions.pressure("left", [](double t) { return 3e5 * std::min(1.0, t / 0.1); });
  else
    conditions.velocity("left", [h = scene.height](const auto& x, double t) {
      const double pulse = 5.0 * (std::sin(2.0 * std::numbers::pi * t) + 1.1);
      return Vec<double, 2>{pulse * x[1] * (h - x[1]), 0.0};
    });
  conditions.traction_free("right"), conditions.no_slip("top"), conditions.no_slip("bottom");
  return conditions;
}

std::unique_ptr<Problem> make_problem(const Mesh<Quad1>& mesh, const Scene& scene, int refinement,
                                      const Values& values) {
  LeafletOptions o(scene.cells, {4, 100 * refinement}, scene.dt);
  o.fsi.s.s_max = values.s;
  o.fsi.linear.base = values.base;
  o.fsi.patch_layers = values.layers;
  std::vector<Body> beams;
  for (const auto& [x_0, y_0, x_1, y_1] : scene.beams)
    beams.emplace_back("beam", box<Quad1>({x_0, y_0}, {x_1, y_1}, o.n_s),
                       NeoHookean(Lame::from_young(values.E, 0.4)), o.solid());
  auto problem = std::make_unique<Problem>(mesh, boundary(scene), o.rho, Newtonian{o.mu}, std::move(beams),
                                           o.flow, o.fsi);
  problem->start(0.0, [](const auto&) { return Vec<double, 2>::zero(); });
  return problem;
}

/// Checkpoints of the scene after its first and its last steps.
std::array<std::string, 2> march(Run& run, const Mesh<Quad1>& mesh, const Scene& scene, int refinement,
                                 std::array<int, 2> steps) {
  const auto problem = make_problem(mesh, scene, refinement, {});
  const double dt = scene.dt / refinement;  // no step is cut here, and the load rises faster on small cells
  std::array<std::string, 2> files;
  for (int n = 1; n <= steps[1]; ++n) {
    if (const NewtonReport report = problem->step(dt); !report.converged)
      throw Error(ExitCode::nonlinear, scene.name + std::string(" valve: ") + report.failure);
    for (int k : {0, 1}) {
      if (n != steps[k]) continue;
      CheckpointWriter checkpoint(run.comm());
      problem->save(checkpoint);
      files[k] = checkpoint.save(run.path(""), n);
    }
  }
  return files;
}

struct Count {
  int iterations;
  bool converged, renewed;
};

/// First linear solve of a step of dt from a state.
Count solve(Problem& problem, const std::string& state, double dt) {
  problem.restore(Checkpoint(problem.mesh().comm, state));
  problem.begin_step(dt);
  problem.assemble_tangent();
  const int before = problem.linear_solver().setups();
  const SolverReport report = problem.solve({1e-6, 1e-6});
  return {report.iterations, report.converged, problem.linear_solver().setups() > before};
}

struct Ranges {
  std::vector<double> E{1e3, 5.6e7, 1e9}, dt{1e-5, 1e-3, 1e-1}, s{1, 100, 1e5};
  std::vector<double> refinements{1};
  std::array<int, 2> steps{10, 20};
  int layers = -1;
};

void survey(Run& run, CsvFile& csv, const Scene& scene, const Ranges& ranges) {
  for (double r : ranges.refinements) {
    const int refinement = static_cast<int>(r);
    const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {scene.length, scene.height},
                                            {scene.cells[0] * refinement, scene.cells[1] * refinement}),
                                 run.comm());
    const auto states = march(run, mesh, scene, refinement, ranges.steps);
    for (const std::string base : {"direct", "gmres"}) {
      int worst_fresh = 0, worst_kept = 0, worst_after = 0;
      for (double E : ranges.E)
        for (double dt : ranges.dt)
          for (double s : ranges.s) {
            const auto problem = make_problem(mesh, scene, refinement, {E, dt, s, ranges.layers, base});
            const Count old = solve(*problem, states[0], dt), kept = solve(*problem, states[1], dt);
            const Count after = solve(*problem, states[1], dt);
            const auto anew = make_problem(mesh, scene, refinement, {E, dt, s, ranges.layers, base});
            const Count fresh = solve(*anew, states[1], dt);
            const auto mark = [](const Count& c) { return c.converged ? (c.renewed ? "" : "k") : "!"; };
            char line[200];
            std::snprintf(
                line, sizeof line,
                "%s %s %6ld + %5ld E %6.0e dt %5.0e s %5.0e: fresh %3d%s then %3d%s %3d%s, earlier %3d%s",
                scene.name, base.c_str(), mesh.nodes.n_global() * 3, anew->linear_solver().patch_unknowns(),
                E, dt, s, fresh.iterations, fresh.converged ? "" : "!", kept.iterations, mark(kept),
                after.iterations, mark(after), old.iterations, old.converged ? "" : "!");
            run.log(line);
            csv.row({double(scene.beams.size()), base == "direct" ? 1.0 : 0.0, mesh.nodes.n_global() * 3.0, E,
                     dt, s, double(fresh.iterations), double(fresh.converged), double(kept.iterations),
                     double(kept.converged), double(kept.renewed), double(after.iterations)});
            worst_fresh = std::max(worst_fresh, fresh.iterations);
            worst_kept = std::max(worst_kept, kept.iterations);
            worst_after = std::max(worst_after, after.iterations);
          }
      const std::string name = std::string(scene.name) + "_" + base + "_" + std::to_string(refinement);
      run.metric("fresh_" + name, worst_fresh, "-"), run.metric("kept_" + name, worst_kept, "-");
      run.metric("after_" + name, worst_after, "-");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_case(argc, argv, {"bench_preconditioner", "iterations with thin stiff solids"}, [](Run& run) {
    Ranges ranges;
    std::string scene = "both";
    run.params.add_choice("scene", scene, {"both", "open", "closed"}, "valve");
    run.params.add("E", ranges.E, "dyn/cm^2", "Young's moduli");
    run.params.add("dt", ranges.dt, "s", "time steps");
    run.params.add("s", ranges.s, "-", "scales s of tau_M around the solid");
    run.params.add("refinements", ranges.refinements, "-", "1: about 13,000 unknowns; 2: 50,000; 4: 200,000");
    run.params.add("layers", ranges.layers, "-", "layers of the patch (-1: as runs take)", {-1, 100});
    run.params.add("steps", ranges.steps[0], "-", "steps to the state whose set-up is kept", {1, 10000});
    run.params.add("steps_solved", ranges.steps[1], "-", "steps to the state that is solved", {2, 10000});
    run.parse();
    CsvFile csv = run.csv("preconditioner.csv", {{"leaflets", "-"},
                                                 {"direct", "-"},
                                                 {"unknowns", "-"},
                                                 {"E", "dyn/cm^2"},
                                                 {"dt", "s"},
                                                 {"s", "-"},
                                                 {"fresh", "-"},
                                                 {"fresh_converged", "-"},
                                                 {"kept", "-"},
                                                 {"kept_converged", "-"},
                                                 {"renewed", "-"},
                                                 {"after", "-"}});
    if (scene != "closed") survey(run, csv, open_valve, ranges);
    if (scene != "open") survey(run, csv, closed_valve, ranges);
  });
}
