#pragma once
/// \file
/// Balances of volume, momentum and energy over a run, for history.csv.

#include <cmath>
#include <string>
#include <vector>

#include "ifsi/assembly/flow_faces.hpp"
#include "ifsi/assembly/integrals.hpp"
#include "ifsi/io/run.hpp"

namespace ifsi {

/// Where momentum and energy come from and go to in each step (eq. 26). Powers and forces hold at the time of
/// the equations; changes are those of the completed levels.
template <class Problem>
class Balances {
 public:
  static constexpr int dim = Problem::dim;
  using Coordinates = typename Problem::System::Coordinates;

  explicit Balances(const Problem& problem)
      : problem_(problem), last_(problem.totals()), supplied_(last_.kinetic) {}

  [[nodiscard]] static std::vector<Column> columns() {
    std::vector<Column> names = {{"power_in", "energy/time"},       {"dissipation", "energy/time"},
                                 {"power_on_solid", "energy/time"}, {"fluid_kinetic_energy", "energy"},
                                 {"numerical_loss", "energy/time"}, {"net_outflow", "volume/time"}};
    for (int i = 0; i < dim; ++i) names.push_back({std::string("force_defect_") + "xyz"[i], "force"});
    return names;
  }

  /// Call after each step.
  [[nodiscard]] std::vector<double> observe(double dt) {
    const auto in = problem_.supply(), taken = problem_.taken_by_solids();
    const auto now = problem_.totals(), alpha = problem_.totals_alpha();
    const double loss = in.energy - alpha.dissipation - taken.energy - (now.kinetic - last_.kinetic) / dt;
    supplied_ += dt * std::abs(in.energy), lost_ += dt * loss;
    std::vector<double> row = {in.energy, alpha.dissipation, taken.energy, now.kinetic, loss, net_outflow()};
    for (int i = 0; i < dim; ++i)
      row.push_back(in.momentum[i] - taken.momentum[i] - (now.momentum[i] - last_.momentum[i]) / dt);
    last_ = now;
    return row;
  }

  /// What was lost to the scheme over the work that went through the boundary, either way, and what was
  /// there.
  [[nodiscard]] double lost_part() const { return supplied_ > 0.0 ? lost_ / supplied_ : 0.0; }

 private:
  [[nodiscard]] double net_outflow() const {
    const auto& mesh = problem_.mesh();
    double flux = 0.0;
    for (std::size_t b = 0; b < mesh.boundary_names.size(); ++b)
      flux += boundary_flux<Coordinates>(mesh, static_cast<int>(b), problem_.state().velocity());
    return flux;
  }

  const Problem& problem_;
  FlowTotals<dim> last_;
  double supplied_, lost_ = 0.0;
};

}  // namespace ifsi
