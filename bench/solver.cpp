// Iterations and CPU time of the block-preconditioned GMRES on matrices of the flow, over time step, Reynolds
// number and mesh size.
#include <ctime>
#include <fstream>
#include <map>

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

/// One flow: unit speed in a channel of unit width. CFL = dt / h with the distance h of neighbouring nodes; 0
/// means steady.
struct Flow {
  double Re, CFL;
  bool enclosed;
};

struct Cost {
  double unknowns, setup, solve;  ///< seconds of CPU
  SolverReport report;
  std::string preconditioner;
};

/// Channel flow along x with vortices on top, free of divergence.
template <int dim>
Vec<double, dim> velocity(const Vec<double, dim>& x) {
  constexpr double k = 2.0 * std::numbers::pi, a = 0.5;
  Vec<double, dim> v = Vec<double, dim>::zero();
  v[0] = 0.5 + a * std::sin(k * x[0]) * std::cos(k * x[1]);
  v[1] = -a * std::cos(k * x[0]) * std::sin(k * x[1]);
  if constexpr (dim == 3) v[1] += 0.3 * std::sin(k * x[2]), v[2] = 0.3 * std::sin(k * x[0]);
  return v;
}

/// The unit box with n nodes between neighbouring corners.
template <class Element>
GlobalMesh<Element> unit_box(int n) {
  constexpr int dim = Element::dim;
  std::array<int, dim> cells;
  cells.fill(n / Element::order);
  auto upper = Vec<double, dim>::zero();
  for (int i = 0; i < dim; ++i) upper[i] = 1.0;
  return box<Element>(Vec<double, dim>::zero(), upper, cells);
}

/// Velocity prescribed on all sides, or on all but the right one.
template <int dim>
FlowBoundary<dim> boundary(const std::vector<std::string>& sides, bool enclosed) {
  FlowBoundary<dim> conditions;
  for (const std::string& side : sides)
    if (side == "right" && !enclosed)
      conditions.traction_free(side);
    else
      conditions.velocity(side, [](const auto& x, double) { return velocity<dim>(x); });
  return conditions;
}

/// Tangent and residual within a time step of generalized-alpha, or of the steady flow, at the velocity
/// above.
template <class Element>
struct Step {
  static constexpr int dim = Element::dim, B = dim + 1;

  Step(const Mesh<Element>& mesh, const Flow& flow, int n)
      : system(mesh, boundary<dim>(mesh.boundary_names, flow.enclosed)),
        K(system.make_matrix()),
        u(mesh.n_nodes() * B, 0.0),
        rate(u),
        R(u) {
    fluid.rheology = Newtonian{1.0 / flow.Re};
    fluid.C_I = Element::order == 1 ? 36.0 : 60.0;
    if (flow.CFL > 0.0) {
      const double dt = flow.CFL / n;
      fluid.c_inertia = GeneralizedAlpha::from_rho_inf(0.5).c_inertia(dt);
      fluid.tau_rate2 = 4.0 / (dt * dt);
    }
    const auto x = mesh.node_coordinates();
    for (std::size_t node = 0; node < x.size(); ++node)
      for (int i = 0; i < dim; ++i) {
        u[node * B + i] = velocity<dim>(x[node])[i];
        rate[node * B + i] = 0.01 * fluid.c_inertia * u[node * B + i];
      }
    system.assemble(fields(), fluid, 0.0, R, &K);
    system.constraints().eliminate(K);
    system.constraints().project(mesh.n_owned_nodes(), R);
  }
  [[nodiscard]] FlowFields fields() const {
    return {.u = u, .u_dot = rate, .f = {}, .s = {}, .k_p = {}, .fraction = {}};
  }

  FlowSystem<Element> system;
  FluidParameters<Newtonian> fluid;
  BlockCsr<B> K;
  std::vector<double> u, rate, R;
};

/// The first solve sets up, the second one of the same system finds everything in place.
template <class Element>
Cost measure(const Mesh<Element>& mesh, const Flow& flow, int n, LinearSolverOptions options) {
  constexpr int B = Element::dim + 1;
  Step<Element> step(mesh, flow, n);
  options.enclosed = flow.enclosed;
  LinearSolver<B> solver(options, [&] { return step.system.schur_parts(step.fields(), step.fluid); });
  Cost cost{static_cast<double>(mesh.nodes.n_global()) * B, 0.0, 0.0, {}, {}};
  for (double* seconds : {&cost.setup, &cost.solve}) {
    std::vector<double> x(step.R.size(), 0.0);
    const CpuClock clock(mesh.comm);
    cost.report = solver.solve(step.K, step.R, x);
    *seconds = clock.seconds();
  }
  cost.setup -= cost.solve;
  cost.preconditioner = solver.description();
  return cost;
}

/// Iterations and times as docs/solvers.md shows them: a row per flow, a column per mesh.
class Table {
 public:
  void add(const Flow& flow, const std::string& mesh, const std::string& text) {
    if (std::find(meshes_.begin(), meshes_.end(), mesh) == meshes_.end()) meshes_.push_back(mesh);
    char name[60];
    std::snprintf(name, sizeof name, flow.CFL > 0.0 ? "%sRe %g, CFL %g" : "%sRe %g, steady",
                  flow.enclosed ? "enclosed, " : "", flow.Re, flow.CFL);
    if (cells_.find(name) == cells_.end()) flows_.push_back(name);
    cells_[name][mesh] = text;
  }
  void write(const std::string& file) {
    std::ofstream out(file);
    out << "| flow |";
    for (const auto& mesh : meshes_) out << ' ' << mesh << " |";
    out << "\n|---|";
    for (std::size_t k = 0; k < meshes_.size(); ++k) out << "---|";
    for (const auto& flow : flows_) {
      out << "\n| " << flow << " |";
      for (const auto& mesh : meshes_) out << ' ' << cells_[flow][mesh] << " |";
    }
    out << '\n';
  }

 private:
  std::vector<std::string> meshes_, flows_;
  std::map<std::string, std::map<std::string, std::string>> cells_;
};

struct Choice {
  LinearSolverOptions linear{.method = "gmres", .max_iterations = 200};
  std::string flow = "open";
  std::vector<double> Re{1, 100, 1000}, CFL{0.25, 1, 8, 0};
  bool verbose = false;
};

/// All flows on meshes of one element; n nodes along a side.
template <class Element>
void survey(Run& run, CsvFile& csv, Table& table, const Choice& choice, const std::vector<double>& sizes) {
  int worst = 0;
  for (double size : sizes) {
    const int n = static_cast<int>(size);
    const auto mesh = distribute(unit_box<Element>(n), run.comm());
    for (bool enclosed : {false, true})
      for (double Re : choice.Re)
        for (double CFL : choice.CFL) {
          if (choice.flow == (enclosed ? "open" : "enclosed")) continue;
          if (CFL == 0.0 && Re > 100.0 && choice.CFL.size() > 1) continue;
          const Cost c = measure<Element>(mesh, {Re, CFL, enclosed}, n, choice.linear);
          const double us = 1e6 / c.unknowns;
          csv.row({double(Element::dim), double(Element::order), c.unknowns, double(enclosed), Re, CFL,
                   double(c.report.iterations), double(c.report.converged), us * c.setup, us * c.solve});
          char line[200];
          std::snprintf(
              line, sizeof line, "%s %8.0f %-8s Re %5g CFL %5g: %3d%s iterations, us/unknown %6.2f + %6.2f",
              Element::name, c.unknowns, enclosed ? "enclosed" : "open", Re, CFL, c.report.iterations,
              c.report.converged ? "" : " (not converged)", us * c.setup, us * c.solve);
          run.log(choice.verbose ? line + (" | " + c.preconditioner) : line);
          std::snprintf(line, sizeof line, "%d, %.1f + %.1f", c.report.iterations, us * c.setup,
                        us * c.solve);
          table.add({Re, CFL, enclosed}, Element::name + (' ' + std::to_string(long(c.unknowns / 1e3))) + "k",
                    line);
          worst = std::max(worst, c.report.iterations);
        }
  }
  run.metric(std::string("iterations_") + Element::name, worst, "-");
}

}  // namespace

int main(int argc, char** argv) {
  return run_case(argc, argv, {"bench_solver", "iterations and time of the linear solver"}, [](Run& run) {
    Choice choice;
    std::string element = "default";
    bool full = false;
    std::vector<double> sizes;
    run.params.add_choice("element", element, {"default", "quad1", "quad2", "tri1", "hex1", "hex2", "tet1"},
                          "element; default: quad1 and hex1");
    run.params.add_choice("velocity", choice.linear.velocity, {"auto", "ilu", "gauss_seidel", "amg"},
                          "approximate inverse of the velocity block");
    run.params.add_choice("method", choice.linear.method, {"gmres", "direct"}, "linear solver");
    run.params.add_choice("flow", choice.flow, {"both", "open", "enclosed"}, "with or without an outlet");
    run.params.add("Re", choice.Re, "-", "Reynolds numbers");
    run.params.add("CFL", choice.CFL, "-", "Courant numbers of the time step; 0: steady");
    run.params.add("sizes", sizes, "-", "nodes along a side; empty: 10k and 100k unknowns (80k in space)");
    run.params.add("full", full, "-", "a million unknowns as well");
    run.params.add("verbose", choice.verbose, "-", "say what the preconditioner consists of");
    run.parse();
    CsvFile csv = run.csv("solver.csv", {{"dim", "-"},
                                         {"order", "-"},
                                         {"unknowns", "-"},
                                         {"enclosed", "-"},
                                         {"Re", "-"},
                                         {"CFL", "-"},
                                         {"iterations", "-"},
                                         {"converged", "-"},
                                         {"setup", "us/unknown"},
                                         {"solve", "us/unknown"}});
    Table table;
    const auto plane = !sizes.empty() ? sizes : full ? std::vector{58., 182., 578.} : std::vector{58., 182.};
    const auto space = !sizes.empty() ? sizes : full ? std::vector{14., 26., 62.} : std::vector{14., 26.};
    if (element == "default" || element == "quad1") survey<Quad1>(run, csv, table, choice, plane);
    if (element == "quad2") survey<Quad2>(run, csv, table, choice, plane);
    if (element == "tri1") survey<Tri1>(run, csv, table, choice, plane);
    if (element == "default" || element == "hex1") survey<Hex1>(run, csv, table, choice, space);
    if (element == "hex2") survey<Hex2>(run, csv, table, choice, space);
    if (element == "tet1") survey<Tet1>(run, csv, table, choice, space);
    if (run.comm().is_root()) table.write(run.path("table.md"));
  });
}
