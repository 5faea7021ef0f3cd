// A prestressed elastic ring at rest in a closed box of fluid: exact pressure, zero velocity (Black et al.
// 2026).
//
//        +---------------+
//        |    .-'''-.    |     ring of radius 0.25 and width 0.0625 about (0.5, 0.5),
//        |   (       )   |     stress S = mu e_Theta (x) e_Theta
//        |    '-...-'    |
//        +---------------+     on all sides no slip, zero-mean pressure
//
// p = p_0 outside, p_0 + mu ln((R+w)/r) in the ring, p_0 + mu ln(1+w/R) inside, p_0 = -pi mu w (2R+w)/2.
// Metrics: v_l2, v_h1, p_l2 at the end, p_centre, order_* (sweep = h), area_change_max.
#include "ifsi/simulation/fsi_case.hpp"

using namespace ifsi;

namespace {

/// The exact state; the velocity is zero.
struct RingPressure {
  double R = 0.25, w = 0.0625, mu = 1.0;
  [[nodiscard]] double p(const Vec<double, 2>& x, double) const {
    const double r = std::hypot(x[0] - 0.5, x[1] - 0.5);
    const double p_0 = -0.5 * std::numbers::pi * mu * w * (2.0 * R + w);
    return p_0 + mu * std::log((R + w) / std::clamp(r, R, R + w));
  }
  [[nodiscard]] Vec<double, 2> v(const Vec<double, 2>&, double) const { return {0.0, 0.0}; }
  [[nodiscard]] Mat<double, 2> grad_v(const Vec<double, 2>&, double) const { return Mat<double, 2>::zero(); }
};

}  // namespace

int main(int argc, char** argv) {
  return run_case(
      argc, argv, {"annulus", "a prestressed ring at rest: exact pressure, orders in h"}, [](Run& run) {
        int n = 32, levels = 4, around = 224;
        std::string sweep = "none";
        TimeOptions time;
        FlowOptions flow;
        FsiOptions fsi;
        time.dt = 1e-3, time.end = 1e-2, flow.rho_inf = 0.0, flow.newton.rtol = 1e-9;
        run.params.add("mesh.n", n, "-", "fluid cells per side of the coarsest mesh", {8, 1024});
        run.params.add("solid.around", around, "-", "solid cells around per cell of the width", {8, 1000});
        run.params.add_choice("sweep", sweep, {"none", "h"}, "refine the mesh and report orders");
        run.params.add("levels", levels, "-", "meshes of a sweep", {2, 6});
        time.declare(run.params), flow.declare(run.params), fsi.declare(run.params);
        run.parse();

        using Body = SolidBody<Quad1, CircumferentialFibre>;
        const RingPressure exact;
        ConvergenceTable table(run, "h");
        FsiExtremes extremes;  // of the finest mesh
        for (int level = 0; level < (sweep == "h" ? levels : 1); ++level) {
          const int cells = n << level, M = std::max(2, cells / 8);
          const auto mesh = distribute(box<Quad1>({0.0, 0.0}, {1.0, 1.0}, {cells, cells}), run.comm());
          FlowBoundary<2> boundary;
          for (const std::string& side : mesh.boundary_names) boundary.no_slip(side);
          std::vector<Body> ring;
          ring.emplace_back(
              "ring", ring_mesh<Quad1>({0.5, 0.5}, exact.R, exact.R + exact.w, around * M, M),
              CircumferentialFibre(exact.mu, {0.5, 0.5}),
              Body::Parameters{.rho_s = 1.0, .rho_f = 1.0, .mu_f = 1.0, .mu_s = 0.0, .gravity = {}});
          FsiProblem<Quad1, Body> problem(mesh, boundary, 1.0, Newtonian{1.0}, std::move(ring), flow, fsi);
          attach(run, problem);
          extremes = {};
          march(run, problem, time, [&](double) { extremes.observe(problem); });
          table.add(1.0 / cells, exact_errors(problem, exact, 0.0));
          FsiPictures(run, 1.0).write(problem, true);
          run.metric("p_centre", Probe<Quad1>(mesh, {{0.5, 0.5}}).values(problem.solution(), 3)[2]);
        }
        table.report();
        extremes.report(run);
        run.check("area_change_max", extremes.area_change, 0.0, 1e-6, "the ring is at rest");
        if (sweep == "h") run.check_at_least("order_h_v", table.order_v(), 1.5, "about 2 in the paper");
        if (sweep == "h")
          run.check_at_least("order_h_p", table.order_p(), 1.35, "1.5: kinks of the exact pressure");
      });
}
