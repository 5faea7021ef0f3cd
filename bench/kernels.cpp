// Time of residual and tangent per element, against the peak of the core, and what gather and scatter add to
// it.
#include <cstdio>
#include <ctime>
#include <fstream>
#include <random>

#include "ifsi/assembly/flow_assembler.hpp"
#include "ifsi/io/run.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/solid/solid_cell.hpp"

using namespace ifsi;

namespace {

using T = Pack<default_lanes>;

/// A number that counts the operations made with it, square roots and divisions as one each.
struct Counted {
  double v = 0.0;
  static inline long operations = 0;
  Counted() = default;
  Counted(double value) : v(value) {}
  static Counted made(double value) { return ++operations, Counted(value); }
  friend Counted operator+(Counted a, Counted b) { return made(a.v + b.v); }
  friend Counted operator-(Counted a, Counted b) { return made(a.v - b.v); }
  friend Counted operator*(Counted a, Counted b) { return made(a.v * b.v); }
  friend Counted operator/(Counted a, Counted b) { return made(a.v / b.v); }
  friend Counted operator-(Counted a) { return Counted(-a.v); }
  friend Counted sqrt(Counted a) { return made(std::sqrt(a.v)); }
  friend Counted log(Counted a) { return made(std::log(a.v)); }
  friend Counted pow(Counted a, double e) { return made(std::pow(a.v, e)); }
  friend Counted min(Counted a, Counted b) { return a.v < b.v ? a : b; }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
};

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// CPU seconds of one call: the best of several samples of at least `sample` seconds, since whoever shares
/// the machine can only slow it down.
template <class F>
double best_seconds(F&& f, double sample = 2e-3, int samples = 25) {
  double best = std::numeric_limits<double>::infinity();
  for (int s = 0, calls = 1; s < samples; ++s) {
    const double start = cpu_seconds();
    for (int c = 0; c < calls; ++c) f();
    const double used = cpu_seconds() - start;
    best = std::min(best, used / calls);
    if (used < sample) calls *= 2, --s;
  }
  return best;
}

/// Makes the compiler believe that the value is read.
template <class V>
void use(const V& value) {
  asm volatile("" ::"m"(value));
}

/// Flops per second of independent multiply-adds in registers.
double peak() {
  constexpr int chains = 16, repetitions = 10000;
  volatile double factor = 0.999;  // unknown to the compiler
  return 2.0 * chains * repetitions * default_lanes / best_seconds([&] {
           T x[chains];
           const T a(factor);
           for (int k = 0; k < chains; ++k) x[k] = T(k);
           for (int r = 0; r < repetitions; ++r) IFSI_UNROLL
           for (int k = 0; k < chains; ++k) x[k] = x[k] * a + a;
           use(x);
         });
}

/// Fills numbers of any type with random values around a mean.
class Random {
 public:
  template <class N, int n>
  void fill(Vec<N, n>& x, const Vec<double, n>& mean, double spread) {
    for (int i = 0; i < n; ++i) fill(x[i], mean[i], spread);
  }
  void fill(T& x, double mean, double spread) {
    for (int l = 0; l < T::lanes; ++l) x.set(l, mean + spread * number_(generator_));
  }
  void fill(Counted& x, double mean, double spread) { x = mean + spread * number_(generator_); }

 private:
  std::mt19937 generator_{1};
  std::uniform_real_distribution<double> number_{-1.0, 1.0};
};

template <class Element, class N>
FlowCellData<Element, N> fluid_cell() {
  FlowCellData<Element, N> cell;
  Random random;
  const auto zero = Vec<double, Element::dim>::zero();
  for (int a = 0; a < Element::n_nodes; ++a) {
    auto X = Element::nodes[a];
    X[0] += 2.0;
    random.fill(cell.X[a], X, 0.05);
    random.fill(cell.v[a], zero, 1.0);
    random.fill(cell.v_dot[a], zero, 1.0);
    random.fill(cell.f[a], zero, 1.0);
    random.fill(cell.p[a], 0.0, 1.0);
    cell.s[a] = 1.0;
  }
  cell.k_p = 1.0;
  return cell;
}

const FluidParameters<Newtonian> fluid{.rho = 1.3, .rheology = {0.4}, .c_inertia = 7.0, .tau_rate2 = 2.0};

template <class Element, class Model, class N>
[[gnu::noinline]] void run_fluid(const FlowCellData<Element, N>& cell) {
  const FlowCell<Element, DefaultQuadrature<Element>, Model, N> kernel(cell, fluid);
  for (int a = 0; a < Element::n_nodes; ++a) use(kernel.residual(a));
  kernel.tangent([](int, int, const Mat<N, Element::dim + 1>& K) { use(K); });
}

template <class Element, class Law, class Formulation, class N>
[[gnu::noinline]] void run_solid(const SolidCellData<Element, N>& cell, const Law& law) {
  const SolidCell<Element, Law, Formulation, Cartesian, DefaultQuadrature<Element>, N> kernel(cell, law);
  const SolidParameters<Element::dim> solid{.rho_s = 2.0, .rho_f = 1.0, .mu_f = 0.1};
  kernel.residual_and_tangent(
      solid, {.u = 0.1, .v = 1.0, .a = 10.0}, [](int, const auto& R) { use(R); },
      [](int, int, const auto& K) { use(K); });
}

template <class Element, class N>
SolidCellData<Element, N> solid_cell() {
  SolidCellData<Element, N> cell;
  Random random;
  const auto zero = Vec<double, Element::dim>::zero();
  for (int a = 0; a < Element::n_nodes; ++a) {
    random.fill(cell.X[a], Element::nodes[a], 0.05);
    for (auto* field : {&cell.u, &cell.v, &cell.a}) random.fill((*field)[a], zero, 0.05);
  }
  return cell;
}

/// Collects the results, on screen and in results.csv.
class Table {
 public:
  explicit Table(Run& run) : run_(run), csv_(run.path("results.csv")), peak_(peak()) {
    csv_ << "what,element,ns per element,flop per element,GFLOP/s,share of peak\n";
    run.log("peak " + number(1e-9 * peak_) + " GFLOP/s, " + std::to_string(default_lanes) + " lanes");
    run.metric("peak", 1e-9 * peak_, "GFLOP/s");
  }
  /// \param flop 0 when not counted
  void add(const std::string& what, const std::string& element, double seconds, double flop = 0.0) {
    peak_ = std::max(peak_, flop > 0.0 ? peak() : 0.0);
    const double rate = flop / seconds;
    csv_ << what << ',' << element << ',' << 1e9 * seconds << ',' << flop << ',' << 1e-9 * rate << ','
         << rate / peak_ << std::endl;
    std::string line = element + " " + what + ": " + number(1e9 * seconds) + " ns";
    if (flop > 0.0) line += ", " + number(flop) + " flop, " + number(100.0 * rate / peak_) + " % of the peak";
    run_.log(line);
    run_.metric("ns " + what + " " + element, 1e9 * seconds, "ns");
  }

 private:
  static std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", x);
    return text;
  }
  Run& run_;
  std::ofstream csv_;
  double peak_;
};

template <class Element, class Model = FluidModel<>>
void fluid_kernel(Table& table, const std::string& what = "fluid") {
  Counted::operations = 0;
  run_fluid<Element, Model>(fluid_cell<Element, Counted>());
  const double flop = static_cast<double>(Counted::operations);
  const auto cell = fluid_cell<Element, T>();
  table.add(what, Element::name, best_seconds([&] { run_fluid<Element, Model>(cell); }) / T::lanes, flop);
}

template <class Element, class Formulation, class Law>
void solid_kernel(Table& table, const std::string& what, const Law& law) {
  Counted::operations = 0;
  run_solid<Element, Law, Formulation>(solid_cell<Element, Counted>(), law);
  const double flop = static_cast<double>(Counted::operations);
  const auto cell = solid_cell<Element, T>();
  table.add(what, Element::name,
            best_seconds([&] { run_solid<Element, Law, Formulation>(cell, law); }) / T::lanes, flop);
}

template <class Element>
GlobalMesh<Element> unit_box(int n) {
  std::array<int, Element::dim> cells;
  cells.fill(n);
  auto upper = Vec<double, Element::dim>::zero();
  for (int i = 0; i < Element::dim; ++i) upper[i] = 1.0;
  return box<Element>(Vec<double, Element::dim>::zero(), upper, cells);
}

template <class Element>
double assembly_seconds(const Mesh<Element>& mesh, bool tangent) {
  constexpr int B = Element::dim + 1;
  const FlowAssembler<Element> assembler(mesh);
  auto K = assembler.make_matrix();
  std::vector<double> u(mesh.n_nodes() * B), R(u.size());
  std::mt19937 generator(1);
  for (double& u_i : u) u_i = 1e-3 * static_cast<double>(generator() % 1000);
  const FlowFields fields{.u = u, .u_dot = u, .f = {}, .s = {}, .k_p = {}};
  const auto assemble = [&] {
    tangent ? assembler.residual_and_tangent(fields, fluid, R, K) : assembler.residual(fields, fluid, R);
  };
  return best_seconds(assemble, 2e-3, 9) / mesh.n_cells();
}

/// Gather, kernel and scatter on a mesh whose matrix fits into the second-level cache and on one whose matrix
/// exceeds all caches; there also with the cells in random order.
template <class Element>
void assembly(Table& table, Run& run, int small, int large) {
  table.add("assembly in cache", Element::name,
            assembly_seconds(distribute(unit_box<Element>(small), run.comm()), true));
  auto mesh = distribute(unit_box<Element>(large), run.comm());
  table.add("residual", Element::name, assembly_seconds(mesh, false));
  table.add("assembly", Element::name, assembly_seconds(mesh, true));
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), std::mt19937(1));
  std::shuffle(mesh.cell_points.begin(), mesh.cell_points.end(), std::mt19937(1));
  table.add("assembly shuffled", Element::name, assembly_seconds(mesh, true));
}

void kernels(Table& table) {
  fluid_kernel<Tri1>(table);
  fluid_kernel<Quad1>(table);
  fluid_kernel<Tri2>(table);
  fluid_kernel<Quad2>(table);
  fluid_kernel<Tet1>(table);
  fluid_kernel<Wedge1>(table);
  fluid_kernel<Hex1>(table);
  fluid_kernel<Tet2>(table);
  fluid_kernel<Hex2>(table);
  fluid_kernel<Quad1, FluidModel<Stokes>>(table, "stokes");
  fluid_kernel<Quad1, FluidModel<NavierStokes, Newtonian, Axisymmetric>>(table, "axisymmetric");
  solid_kernel<Quad1, Displacement>(table, "neo-Hookean", NeoHookean(Lame{2.0, 8.0}));
  solid_kernel<Quad1, MeanDilatation>(table, "mean dilatation", UncoupledNeoHookean{2.0, 80.0});
  solid_kernel<Hex1, Displacement>(table, "neo-Hookean", NeoHookean(Lame{2.0, 8.0}));
}

}  // namespace

int main(int argc, char** argv) {
  return run_case(argc, argv, {"bench_kernels", "time of element kernels and of assembly"}, [](Run& run) {
    std::string part = "all";
    run.params.add_choice("part", part, {"all", "kernels", "assembly"}, "what to measure");
    run.parse();
    Table table(run);
    if (part != "assembly") kernels(table);
    if (part == "kernels") return;
    assembly<Tri1>(table, run, 24, 400);
    assembly<Quad1>(table, run, 32, 512);
    assembly<Tet1>(table, run, 6, 40);
    assembly<Hex1>(table, run, 6, 48);
  });
}
