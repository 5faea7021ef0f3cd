#pragma once
/// \file
/// A membrane: a deformable body of one layer of nodes.

#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ifsi/assembly/solid_fields.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/coupling/solid_cells.hpp"
#include "ifsi/mesh/surface_mesh.hpp"
#include "ifsi/quadrature/coordinates.hpp"
#include "ifsi/solid/membrane_cell.hpp"
#include "ifsi/solid/sheet_bending.hpp"

namespace ifsi {

/// A surface in space with a thickness (eq. 45) and a stiffness against bending (eq. 46): what a leaflet is
/// when its thickness is far below the fluid's cells. One layer of nodes holds the fluid at one velocity and
/// leaves its shear across the leaflet free; nothing can turn inside out. To the solids of a scene it is what
/// SolidBody is; its cells are those of the surface and, behind them, the crosses that bend.
/// \tparam Law see MembraneCell
template <ReferenceElement Element_, FibredSurfaceLaw Law_>
class MembraneBody {
 public:
  using Element = Element_;
  using Law = Law_;
  using Coordinates = Cartesian;
  static constexpr int dim = 3, n = Element::n_nodes;
  static constexpr bool is_surface = true;
  using Parameters = SolidParameters<3>;

  Parameters parameters;  ///< densities and gravity; viscosities count for nothing

  /// \param thickness of the undeformed membrane; \param bending moment per length over curvature; 0: none
  /// \throws Error (configuration) for numbers that are not positive (bending, densities: negative); (file)
  /// for cells and crosses without area or of nodes that do not exist.
  MembraneBody(std::string name, SurfaceMesh<Element> mesh, Law law, Parameters solid, double thickness,
               double bending)
      : parameters(solid),
        name_(std::move(name)),
        mesh_(std::move(mesh)),
        law_(std::move(law)),
        thickness_(thickness) {
    check(bending);
    if (bending == 0.0) return;
    for (const auto& nodes : mesh_.crosses) bending_.add(nodes, at(nodes, {}), {bending, bending});
    for (const auto& nodes : mesh_.mirrored)
      bending_.add_mirrored(nodes, at(nodes, {}), {bending, bending}, mesh_.mirror_normal);
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const SurfaceMesh<Element>& mesh() const { return mesh_; }
  [[nodiscard]] int n_nodes() const { return mesh_.n_points(); }
  [[nodiscard]] int n_dofs() const { return 3 * n_nodes(); }
  /// Cells of the surface and crosses.
  [[nodiscard]] int n_cells() const { return mesh_.n_cells() + bending_.size(); }
  [[nodiscard]] std::vector<int> all_cells() const {
    std::vector<int> cells(n_cells());
    std::iota(cells.begin(), cells.end(), 0);
    return cells;
  }
  /// Appends which nodes each cell couples.
  void list_cells(SolidCells& list, int first_node) const {
    list.append(mesh_.cells, first_node);
    list.append(bending_.nodes(), first_node);
  }

  /// Residual (eq. 45, eq. 46) of each listed cell: sink(cell, R), 3 numbers per node.
  template <class Sink>
  DeformationReport residual(const SolidState& state, std::span<const int> cells, Sink&& sink) const {
    return assemble(state, cells, nullptr,
                    [&](int cell, std::span<const double> R, std::span<const double>) { sink(cell, R); });
  }
  /// The same with the tangent: sink(cell, R, K), K of 3 x 3 blocks as SolidBody hands them out.
  template <class Sink>
  DeformationReport residual_and_tangent(const SolidState& state, const StateSlopes& slopes,
                                         std::span<const int> cells, Sink&& sink) const {
    return assemble(state, cells, &slopes, sink);
  }

  /// Balances over the listed cells.
  [[nodiscard]] SolidTotals<3> totals(const SolidState& state, std::span<const int> cells) const {
    SolidTotals<3> sum;
    for (int c : cells) {
      if (c >= mesh_.n_cells()) {
        sum.elastic_energy += bending_term(c, state.u).energy;
        continue;
      }
      with_cell(state, c, [&](const Kernel& kernel) {
        for (int q = 0; q < Kernel::n_points; ++q) {
          const double dV = kernel.reference_volume(q), J = det(kernel.deformation_gradient(q));
          const auto v = kernel.velocity(q);
          sum.reference_volume += dV;
          sum.volume += J * dV;
          sum.elastic_energy += kernel.energy(q) * dV;
          sum.kinetic_energy += 0.5 * parameters.rho_s * dot(v, v) * dV;
          sum.momentum += (parameters.rho_s * dV) * v;
          sum.deformation.merge(J, c);
        }
      });
    }
    return sum;
  }

  /// Stress and strain, averaged over the cells around each node with weights int |N_a| dV.
  [[nodiscard]] SolidFields fields(std::span<const double> u) const {
    FieldAverage average(n_nodes());
    for (int c = 0; c < mesh_.n_cells(); ++c)
      with_cell({u}, c, [&](const Kernel& kernel) {
        for (int q = 0; q < Kernel::n_points; ++q) {
          const auto sigma = kernel.cauchy(q), E = kernel.green_lagrange(q);
          const double dV = kernel.reference_volume(q), J = det(kernel.deformation_gradient(q));
          for (int a = 0; a < n; ++a)
            average.add(mesh_.cells[c][a], std::abs(BasisTable<Element>::N[q][a]) * dV, sigma, E, J);
        }
      });
    return average.fields();
  }
  /// Appends those of all points, unsmoothed.
  void add_principal_samples(std::span<const double> u, PrincipalSamples& samples) const {
    for (int c = 0; c < mesh_.n_cells(); ++c)
      with_cell({u}, c, [&](const Kernel& kernel) {
        for (int q = 0; q < Kernel::n_points; ++q)
          samples.add(kernel.cauchy(q), kernel.green_lagrange(q), kernel.reference_volume(q));
      });
  }

  /// visit(nodes, area of each) for every face of the undeformed membrane, which has two sides.
  template <class Visit>
  void for_each_face(Visit&& visit) const {
    for (int c = 0; c < mesh_.n_cells(); ++c)
      with_cell({{}}, c, [&](const Kernel& kernel) {
        std::array<double, n> area{};
        for (int q = 0; q < Kernel::n_points; ++q)
          for (int a = 0; a < n; ++a)
            area[a] += 2.0 * BasisTable<Element>::N[q][a] * kernel.reference_volume(q) / thickness_;
        visit(std::span<const int>(mesh_.cells[c]), std::span<const double>(area));
      });
  }

 private:
  using Kernel = MembraneCell<Element, Law>;

  /// Positions of some nodes; undeformed without u.
  template <std::size_t m>
  [[nodiscard]] std::array<Vec<double, 3>, m> at(const std::array<int, m>& nodes,
                                                 std::span<const double> u) const {
    std::array<Vec<double, 3>, m> x;
    for (std::size_t k = 0; k < m; ++k) x[k] = mesh_.points[nodes[k]] + vector(u, nodes[k]);
    return x;
  }
  static Vec<double, 3> vector(std::span<const double> values, int node) {
    if (values.empty()) return Vec<double, 3>::zero();
    return {values[3 * node], values[3 * node + 1], values[3 * node + 2]};
  }
  [[nodiscard]] SheetBending::Term bending_term(int cell, std::span<const double> u) const {
    const int k = cell - mesh_.n_cells();
    return bending_.term(k, at(bending_.nodes()[k], u));
  }

  template <class Visit>
  void with_cell(const SolidState& state, int c, Visit&& visit) const {
    typename Kernel::Data data;
    for (int a = 0; a < n; ++a) {
      const int node = mesh_.cells[c][a];
      data.X[a] = mesh_.points[node];
      data.u[a] = vector(state.u, node), data.v[a] = vector(state.v, node), data.a[a] = vector(state.a, node);
    }
    visit(Kernel(data, law_, thickness_));
  }

  template <class Sink>
  DeformationReport assemble(const SolidState& state, std::span<const int> cells, const StateSlopes* slopes,
                             Sink&& sink) const {
    DeformationReport report;
    for (int c : cells) {
      if (c < mesh_.n_cells())
        assemble_cell(state, c, slopes, report, sink);
      else
        assemble_bending(state, c, slopes, sink);
    }
    return report;
  }
  template <class Sink>
  void assemble_cell(const SolidState& state, int c, const StateSlopes* slopes, DeformationReport& report,
                     Sink&& sink) const {
    with_cell(state, c, [&](const Kernel& kernel) {
      DeformationReport of_cell;
      for (int q = 0; q < Kernel::n_points; ++q) of_cell.merge(det(kernel.deformation_gradient(q)), c);
      report.merge(of_cell.min_det_F, c);
      if (of_cell.inverted()) return;
      std::array<Vec<double, 3>, n> R;
      std::array<Mat<double, 3>, n * n> K;
      kernel.residual(parameters, [&](int a, const Vec<double, 3>& R_a) { R[a] = R_a; });
      if (slopes != nullptr)
        kernel.tangent(parameters, *slopes,
                       [&](int a, int b, const Mat<double, 3>& K_ab) { K[a * n + b] = K_ab; });
      sink(c, std::span<const double>(R[0].data, 3 * R.size()),
           std::span<const double>(K[0].data, slopes != nullptr ? 9 * K.size() : 0));
    });
  }
  template <class Sink>
  void assemble_bending(const SolidState& state, int c, const StateSlopes* slopes, Sink&& sink) const {
    auto term = bending_term(c, state.u);
    if (slopes != nullptr)
      for (auto& K : term.K) K = slopes->u * K;
    sink(c, std::span<const double>(term.R[0].data, 3 * term.R.size()),
         std::span<const double>(term.K[0].data, slopes != nullptr ? 9 * term.K.size() : 0));
  }

  void check(double bending) const {
    const auto expect = [&](bool good, const char* what, double value, const char* expected) {
      if (!good)
        throw Error(ExitCode::configuration, "membrane '" + name_ + "': " + what + " = " +
                                                 std::to_string(value) + ", expected a finite number " +
                                                 expected);
    };
    const auto finite = [](double x) { return std::isfinite(x); };
    expect(thickness_ > 0.0 && finite(thickness_), "thickness", thickness_, "> 0");
    expect(bending >= 0.0 && finite(bending), "bending stiffness", bending, ">= 0");
    expect(parameters.rho_s >= 0.0 && finite(parameters.rho_s), "rho_s", parameters.rho_s, ">= 0");
    expect(parameters.rho_f >= 0.0 && finite(parameters.rho_f), "rho_f", parameters.rho_f, ">= 0");
    if (mesh_.cells.empty()) throw Error(ExitCode::file, "membrane '" + name_ + "': the mesh has no cells");
    for (int c = 0; c < mesh_.n_cells(); ++c) check_nodes(mesh_.cells[c], "cell " + std::to_string(c));
    for (const auto* crosses : {&mesh_.crosses, &mesh_.mirrored})
      for (const auto& nodes : *crosses) check_nodes(nodes, "a cross");
    for (int c = 0; c < mesh_.n_cells(); ++c)
      for (const auto& dN : BasisTable<Element>::dN) {
        const auto normal = area_normal(jacobian(dN, at(mesh_.cells[c], {})));
        if (!(dot(normal, normal) > 0.0))
          throw Error(ExitCode::file, "membrane '" + name_ + "': cell " + std::to_string(c) + " has no area");
      }
  }

  void check_nodes(std::span<const int> nodes, const std::string& what) const {
    for (int a : nodes)
      if (a < 0 || a >= n_nodes())
        throw Error(ExitCode::file, "membrane '" + name_ + "': " + what + " has node " + std::to_string(a) +
                                        ", expected 0 to " + std::to_string(n_nodes() - 1));
  }

  std::string name_;
  SurfaceMesh<Element> mesh_;
  Law law_;
  double thickness_;
  SheetBending bending_;
};

}  // namespace ifsi
