#pragma once
/// \file
/// A solid body: its mesh, law and parameters, and the loops over its cells and faces.

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "ifsi/assembly/solid_fields.hpp"
#include "ifsi/core/error.hpp"
#include "ifsi/core/pack.hpp"
#include "ifsi/coupling/solid_cells.hpp"
#include "ifsi/element/elements.hpp"
#include "ifsi/material/materials.hpp"
#include "ifsi/mesh/global_mesh.hpp"
#include "ifsi/mesh/names.hpp"
#include "ifsi/solid/principal.hpp"
#include "ifsi/solid/solid_cell.hpp"
#include "ifsi/solid/surface_load.hpp"
#include "ifsi/solid/volume_quantile.hpp"

namespace ifsi {

/// A deformable body on its own mesh, which every rank holds whole; work is shared by lists of cells.
/// \tparam Law a SolidLaw, \tparam Formulation Displacement or MeanDilatation, \tparam Coordinates Cartesian
/// or Axisymmetric, \tparam lanes cells worked on together.
template <ReferenceElement Element_, SolidLaw Law_, class Formulation_ = Displacement,
          class Coordinates_ = Cartesian, class Rule_ = DefaultQuadrature<Element_>,
          int lanes = default_lanes>
class SolidBody {
 public:
  using Element = Element_;
  using Law = Law_;
  using Formulation = Formulation_;
  using Coordinates = Coordinates_;
  static constexpr int dim = Element::dim, n = Element::n_nodes, n_cell_dofs = n * dim;
  static constexpr bool is_surface = false;
  using Parameters = SolidParameters<dim>;

  Parameters parameters;  ///< may change between steps (gravity in time, say)

  /// \throws Error (configuration) for densities or viscosities that are negative or not finite and for a
  /// periodic mesh; (file) for cells that are inside out, or points at r < 0 of a body of revolution.
  SolidBody(std::string name, GlobalMesh<Element> mesh, Law law, Parameters solid);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const GlobalMesh<Element>& mesh() const { return mesh_; }
  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] int n_nodes() const { return mesh_.n_points(); }
  [[nodiscard]] int n_dofs() const { return n_nodes() * dim; }
  [[nodiscard]] int n_cells() const { return mesh_.n_cells(); }

  [[nodiscard]] std::vector<int> all_cells() const;
  /// Appends which nodes each cell couples.
  void list_cells(SolidCells& list, int first_node) const { list.append(mesh_.cells, first_node); }
  /// Number of a named boundary. \throws Error (configuration), with the nearest name, when there is none.
  [[nodiscard]] int boundary(const std::string& boundary_name) const {
    return find_name("boundary of solid '" + name_ + "'", boundary_name, mesh_.boundary_names);
  }
  /// Indices into mesh().boundary_faces.
  [[nodiscard]] std::vector<int> faces_on(const std::string& boundary_name) const;
  /// Sorted nodes of a named boundary.
  [[nodiscard]] std::vector<int> nodes_on(const std::string& boundary_name) const;

  /// Residual (eq. 17) of each listed cell. Cells that are inside out are reported and skipped.
  DeformationReport residual(const SolidState& state, std::span<const int> cells,
                             const CellResidualSink& sink) const;
  /// The same with the tangent K = slopes.u dR/du + slopes.v dR/dv + slopes.a dR/da.
  DeformationReport residual_and_tangent(const SolidState& state, const StateSlopes& slopes,
                                         std::span<const int> cells, const CellTangentSink& sink) const;
  /// The same with a tangent that makes Newton's method robust over large steps of nearly incompressible
  /// bodies: see SolidCell::predicted_pressure. `u_before` is the displacement of the iteration before.
  DeformationReport residual_and_robust_tangent(const SolidState& state, std::span<const double> u_before,
                                                const StateSlopes& slopes, std::span<const int> cells,
                                                const CellTangentSink& sink) const
      requires(Formulation::mean_dilatation);

  /// Balances over the listed cells.
  [[nodiscard]] SolidTotals<dim> totals(const SolidState& state, std::span<const int> cells) const;

  /// Dead traction (force per reference area) on the listed boundary faces; R = -force.
  void add_traction(const Vec<double, dim>& traction, std::span<const int> faces,
                    const FaceResidualSink& sink) const;
  /// visit(nodes, area of each) for every face of the undeformed surface.
  template <class Visit>
  void for_each_face(Visit&& visit) const {
    std::vector<int> faces(mesh_.boundary_faces.size());
    std::iota(faces.begin(), faces.end(), 0);
    Vec<double, dim> unit = Vec<double, dim>::zero();
    unit[0] = -1.0;
    add_traction(unit, faces, [&](std::span<const int> nodes, std::span<const double> R) {
      std::vector<double> areas;
      for (std::size_t a = 0; a < nodes.size(); ++a) areas.push_back(R[a * dim]);
      visit(nodes, std::span<const double>(areas));
    });
  }
  /// Pressure that follows the surface (force per current area, inwards).
  void add_pressure(double pressure, std::span<const double> u, const StateSlopes& slopes,
                    std::span<const int> faces, const FaceTangentSink& sink) const;

  /// Dead traction and following pressure, as above, that act on a boundary from now on. Both may change
  /// between steps. \return its number in loads().
  int add_load(const std::string& boundary_name, const Vec<double, dim>& traction, double pressure = 0.0) {
    loads_.push_back({faces_on(boundary_name), traction, pressure});
    return static_cast<int>(loads_.size()) - 1;
  }
  struct Load {
    std::vector<int> faces;
    Vec<double, dim> traction;
    double pressure;
  };
  [[nodiscard]] std::vector<Load>& loads() { return loads_; }
  [[nodiscard]] const std::vector<Load>& loads() const { return loads_; }
  /// Residual and tangent of all loads times a factor, face by face. The tangent of a dead load is empty.
  void add_loads(double factor, std::span<const double> u, const StateSlopes& slopes,
                 const LoadSink& sink) const;

  /// Stress and strain, averaged over the cells around each node with weights int |N_a| dV.
  [[nodiscard]] SolidFields fields(std::span<const double> u) const;
  /// Appends those of all points, unsmoothed.
  void add_principal_samples(std::span<const double> u, PrincipalSamples& samples) const;

 private:
  using T = Pack<lanes>;
  using Kernel = SolidCell<Element, Law, Formulation, Coordinates, Rule_, T>;
  /// Lane l of a symmetric tensor.
  static Mat<double, 3> lane(const Mat<T, 3>& A, int l) {
    return symmetric([&](int s) { return A(voigt[s][0], voigt[s][1])[l]; });
  }

  /// Cells worked on together; the last batch repeats its last cell in the lanes beyond n_cells.
  struct Batch {
    std::array<int, lanes> cell;
    std::array<bool, lanes> sound;  ///< det F > 0 at every point
    int n_cells;
  };

  template <class Visit>
  DeformationReport for_each_batch(const SolidState& state, std::span<const int> cells, Visit&& visit) const {
    DeformationReport report;
    const int n_listed = static_cast<int>(cells.size());
    for (int first = 0; first < n_listed; first += lanes) {
      Batch batch;
      batch.n_cells = std::min(lanes, n_listed - first);
      for (int l = 0; l < lanes; ++l) batch.cell[l] = cells[first + std::min(l, batch.n_cells - 1)];
      const SolidCellData<Element, T> data = gather(batch, state);
      const Kernel kernel(data, law_);
      for (int l = 0; l < batch.n_cells; ++l) {
        batch.sound[l] = kernel.min_det_F()[l] > 0;
        report.merge(kernel.min_det_F()[l], batch.cell[l]);
      }
      visit(kernel, batch);
    }
    return report;
  }

  [[nodiscard]] SolidCellData<Element, T> gather(const Batch& batch, const SolidState& state) const;

  /// Lane l of `count` packs becomes row l. Whole registers go to memory, transposed: picking lanes out of
  /// registers one by one is slow, and g++ 12 -O3 (SLP) has been seen to store stale values for it.
  template <std::size_t count>
  static void unpack(const std::array<T, count>& packs, double (*rows)[count]) {
    constexpr std::size_t transposed = count / lanes * lanes;
    for (std::size_t first = 0; first < transposed; first += lanes) {
      T block[lanes];
      for (int k = 0; k < lanes; ++k) block[k] = packs[first + k];
      transpose(block);
      for (int l = 0; l < lanes; ++l) std::memcpy(rows[l] + first, &block[l].v, sizeof block[l].v);
    }
    for (std::size_t k = transposed; k < count; ++k) {
      double values[lanes];
      std::memcpy(values, &packs[k].v, sizeof values);
      for (int l = 0; l < lanes; ++l) rows[l][k] = values[l];
    }
  }

  /// Residuals and tangents of a batch, first in lanes, then cell by cell.
  struct Unpacked {
    std::array<T, n_cell_dofs> R;
    std::array<T, n_cell_dofs * n_cell_dofs> K;
    double R_rows[lanes][n_cell_dofs];
    double K_rows[lanes][n_cell_dofs * n_cell_dofs];

    auto residual() {
      return [this](int a, const Vec<T, dim>& R_a) { std::copy_n(R_a.data, dim, &R[a * dim]); };
    }
    auto tangent() {
      return [this](int a, int b, const Mat<T, dim>& K_ab) {
        std::copy_n(K_ab.data, dim * dim, &K[(a * n + b) * dim * dim]);
      };
    }
    void send(const Batch& batch, const CellResidualSink& sink) {
      unpack(R, R_rows);
      for (int l = 0; l < batch.n_cells; ++l)
        if (batch.sound[l]) sink(batch.cell[l], R_rows[l]);
    }
    void send(const Batch& batch, const CellTangentSink& sink) {
      unpack(R, R_rows);
      unpack(K, K_rows);
      for (int l = 0; l < batch.n_cells; ++l)
        if (batch.sound[l]) sink(batch.cell[l], R_rows[l], K_rows[l]);
    }
  };

  /// Calls visit<Face>(nodes) with the element and the nodes of boundary face f.
  template <class Visit>
  void with_face(int f, Visit&& visit) const {
    const auto& face = mesh_.boundary_faces[f];
    const auto collect = [&]<class Face>() {
      std::array<int, Face::n_nodes> nodes;
      for (int k = 0; k < Face::n_nodes; ++k)
        nodes[k] = mesh_.cells[face.cell][Element::face_nodes(face.local_face)[k]];
      visit.template operator()<Face>(nodes);
    };
    if constexpr (requires { typename Element::OtherFace; }) {
      if (Element::face_shape(face.local_face) == Element::OtherFace::shape)
        return collect.template operator()<typename Element::OtherFace>();
    }
    collect.template operator()<typename Element::Face>();
  }

  /// Reference (no u) or current positions.
  template <std::size_t m>
  [[nodiscard]] std::array<Vec<double, dim>, m> positions(const std::array<int, m>& nodes,
                                                          std::span<const double> u) const {
    std::array<Vec<double, dim>, m> x;
    for (std::size_t k = 0; k < m; ++k) {
      x[k] = mesh_.points[nodes[k]];
      if (!u.empty())
        for (int i = 0; i < dim; ++i) x[k][i] += u[nodes[k] * dim + i];
    }
    return x;
  }

  void check_parameters() const;
  void check_mesh() const;
  [[noreturn]] void bad_cell(int c, const std::string& what) const;

  std::string name_;
  GlobalMesh<Element> mesh_;
  Law law_;
  std::vector<Load> loads_;
};

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
SolidBody<E, Law, Form, Coords, Rule, lanes>::SolidBody(std::string name, GlobalMesh<Element> mesh, Law law,
                                                        Parameters solid)
    : parameters(solid), name_(std::move(name)), mesh_(std::move(mesh)), law_(std::move(law)) {
  check_parameters();
  check_mesh();
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
std::vector<int> SolidBody<E, Law, Form, Coords, Rule, lanes>::all_cells() const {
  std::vector<int> cells(n_cells());
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
std::vector<int> SolidBody<E, Law, Form, Coords, Rule, lanes>::faces_on(
    const std::string& boundary_name) const {
  std::vector<int> faces;
  const int wanted = boundary(boundary_name);
  for (int f = 0; f < static_cast<int>(mesh_.boundary_faces.size()); ++f)
    if (mesh_.boundary_faces[f].boundary == wanted) faces.push_back(f);
  return faces;
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
std::vector<int> SolidBody<E, Law, Form, Coords, Rule, lanes>::nodes_on(
    const std::string& boundary_name) const {
  std::vector<int> nodes;
  for (int f : faces_on(boundary_name)) {
    const auto& face = mesh_.boundary_faces[f];
    for (int a : Element::face_nodes(face.local_face)) nodes.push_back(mesh_.cells[face.cell][a]);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
DeformationReport SolidBody<E, Law, Form, Coords, Rule, lanes>::residual(const SolidState& state,
                                                                         std::span<const int> cells,
                                                                         const CellResidualSink& sink) const {
  Unpacked out;
  return for_each_batch(state, cells, [&](const Kernel& kernel, const Batch& batch) {
    kernel.residual(parameters, out.residual());
    out.send(batch, sink);
  });
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
DeformationReport SolidBody<E, Law, Form, Coords, Rule, lanes>::residual_and_tangent(
    const SolidState& state, const StateSlopes& slopes, std::span<const int> cells,
    const CellTangentSink& sink) const {
  Unpacked out;
  return for_each_batch(state, cells, [&](const Kernel& kernel, const Batch& batch) {
    kernel.residual_and_tangent(parameters, slopes, out.residual(), out.tangent());
    out.send(batch, sink);
  });
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
DeformationReport SolidBody<E, Law, Form, Coords, Rule, lanes>::residual_and_robust_tangent(
    const SolidState& state, std::span<const double> u_before, const StateSlopes& slopes,
    std::span<const int> cells, const CellTangentSink& sink) const requires(Formulation::mean_dilatation) {
  Unpacked out;
  return for_each_batch(state, cells, [&](const Kernel& kernel, const Batch& batch) {
    const SolidCellData<Element, T> before = gather(batch, {u_before}), now = gather(batch, state);
    std::array<Vec<T, dim>, n> du;
    for (int a = 0; a < n; ++a) du[a] = now.u[a] - before.u[a];
    const T pressure = Kernel(before, law_).predicted_pressure(du);
    kernel.residual_and_tangent(parameters, slopes, out.residual(), out.tangent(), &pressure);
    out.send(batch, sink);
  });
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
auto SolidBody<E, Law, Form, Coords, Rule, lanes>::totals(const SolidState& state,
                                                          std::span<const int> cells) const
    -> SolidTotals<dim> {
  SolidTotals<dim> sum;
  sum.deformation = for_each_batch(state, cells, [&](const Kernel& kernel, const Batch& batch) {
    const auto cell = kernel.totals(parameters);
    for (int l = 0; l < batch.n_cells; ++l) {
      if (!batch.sound[l]) continue;
      sum.volume += cell.volume[l];
      sum.reference_volume += cell.reference_volume[l];
      sum.elastic_energy += cell.elastic[l];
      sum.kinetic_energy += cell.kinetic[l];
      for (int i = 0; i < dim; ++i) sum.momentum[i] += cell.momentum[i][l];
    }
  });
  return sum;
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
void SolidBody<E, Law, Form, Coords, Rule, lanes>::add_traction(const Vec<double, dim>& traction,
                                                                std::span<const int> faces,
                                                                const FaceResidualSink& sink) const {
  for (int f : faces)
    with_face(f, [&]<class Face>(const std::array<int, Face::n_nodes>& nodes) {
      const auto r = SurfaceLoad<Face, Coordinates>::dead(positions(nodes, {}), traction);
      sink(std::span<const int>(nodes), std::span<const double>(r.R[0].data, nodes.size() * dim));
    });
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
void SolidBody<E, Law, Form, Coords, Rule, lanes>::add_pressure(double pressure, std::span<const double> u,
                                                                const StateSlopes& slopes,
                                                                std::span<const int> faces,
                                                                const FaceTangentSink& sink) const {
  for (int f : faces)
    with_face(f, [&]<class Face>(const std::array<int, Face::n_nodes>& nodes) {
      const auto r = SurfaceLoad<Face, Coordinates>::pressure(positions(nodes, u), pressure, slopes.u);
      sink(std::span<const int>(nodes), std::span<const double>(r.R[0].data, nodes.size() * dim),
           std::span<const double>(r.K[0][0].data, nodes.size() * nodes.size() * dim * dim));
    });
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
void SolidBody<E, Law, Form, Coords, Rule, lanes>::add_loads(double factor, std::span<const double> u,
                                                             const StateSlopes& slopes,
                                                             const LoadSink& sink) const {
  for (const Load& load : loads_)
    for (const int& f : load.faces) {
      const int cell = mesh_.boundary_faces[f].cell;
      add_traction(factor * load.traction, {&f, 1},
                   [&](std::span<const int> nodes, std::span<const double> R) { sink(cell, nodes, R, {}); });
      if (load.pressure != 0.0)
        add_pressure(factor * load.pressure, u, slopes, {&f, 1},
                     [&](std::span<const int> nodes, std::span<const double> R, std::span<const double> K) {
                       sink(cell, nodes, R, K);
                     });
    }
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
SolidFields SolidBody<E, Law, Form, Coords, Rule, lanes>::fields(std::span<const double> u) const {
  FieldAverage average(n_nodes());
  for_each_batch({u}, all_cells(), [&](const Kernel& kernel, const Batch& batch) {
    const auto sigma = kernel.cauchy_stresses();
    for (int q = 0; q < Rule::n; ++q) {
      const Mat<T, 3> strain = kernel.green_lagrange(q);
      const T J = det(kernel.deformation_gradient(q)), dV = kernel.reference_volume(q);
      for (int l = 0; l < batch.n_cells; ++l) {
        const Mat<double, 3> sigma_l = lane(sigma[q], l), strain_l = lane(strain, l);
        for (int a = 0; a < n; ++a)
          average.add(mesh_.cells[batch.cell[l]][a], std::abs(BasisTable<Element, Rule>::N[q][a]) * dV[l],
                      sigma_l, strain_l, J[l]);
      }
    }
  });
  return average.fields();
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
void SolidBody<E, Law, Form, Coords, Rule, lanes>::add_principal_samples(std::span<const double> u,
                                                                         PrincipalSamples& samples) const {
  for_each_batch({u}, all_cells(), [&](const Kernel& kernel, const Batch& batch) {
    const auto sigma = kernel.cauchy_stresses();
    for (int q = 0; q < Rule::n; ++q) {
      const Mat<T, 3> strain = kernel.green_lagrange(q);
      const T dV = kernel.reference_volume(q);
      for (int l = 0; l < batch.n_cells; ++l) samples.add(lane(sigma[q], l), lane(strain, l), dV[l]);
    }
  });
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
auto SolidBody<E, Law, Form, Coords, Rule, lanes>::gather(const Batch& batch, const SolidState& state) const
    -> SolidCellData<Element, T> {
  SolidCellData<Element, T> data;
  for (int l = 0; l < lanes; ++l)
    for (int a = 0; a < n; ++a) {
      const int node = mesh_.cells[batch.cell[l]][a];
      for (int i = 0; i < dim; ++i) {
        const int dof = node * dim + i;
        data.X[a][i].set(l, mesh_.points[node][i]);
        data.u[a][i].set(l, state.u[dof]);
        data.v[a][i].set(l, state.v.empty() ? 0.0 : state.v[dof]);
        data.a[a][i].set(l, state.a.empty() ? 0.0 : state.a[dof]);
      }
    }
  return data;
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
void SolidBody<E, Law, Form, Coords, Rule, lanes>::check_parameters() const {
  const std::pair<const char*, double> not_negative[] = {{"rho_s", parameters.rho_s},
                                                         {"rho_f", parameters.rho_f},
                                                         {"mu_f", parameters.mu_f},
                                                         {"mu_s", parameters.mu_s}};
  for (const auto& [key, value] : not_negative)
    if (!(value >= 0 && std::isfinite(value)))
      throw Error(ExitCode::configuration, "solid '" + name_ + "': " + key + " = " + std::to_string(value) +
                                               ", expected a finite number >= 0");
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
void SolidBody<E, Law, Form, Coords, Rule, lanes>::check_mesh() const {
  if (!mesh_.point_node.empty())
    throw Error(ExitCode::configuration, "solid '" + name_ + "': the mesh of a solid cannot be periodic");
  if (mesh_.cells.empty()) throw Error(ExitCode::file, "solid '" + name_ + "': the mesh has no cells");
  for (int c = 0; c < n_cells(); ++c) {
    const auto X = mesh_.cell_coordinates(c);
    for (int q = 0; q < Rule::n; ++q) {
      const double J = det(jacobian(BasisTable<Element, Rule>::dN[q], X));
      if (!(J > 0)) bad_cell(c, "is inside out: its Jacobian determinant is " + std::to_string(J));
    }
    if constexpr (Coordinates::axisymmetric)
      for (const auto& x : X)
        if (!(x[0] >= 0)) bad_cell(c, "of a body of revolution reaches r = " + std::to_string(x[0]));
  }
}

template <ReferenceElement E, SolidLaw Law, class Form, class Coords, class Rule, int lanes>
void SolidBody<E, Law, Form, Coords, Rule, lanes>::bad_cell(int c, const std::string& what) const {
  std::string at;
  for (double x : mesh_.points[mesh_.cells[c][0]].data) at += (at.empty() ? "" : ", ") + std::to_string(x);
  throw Error(ExitCode::file,
              "solid '" + name_ + "': cell " + std::to_string(c) + " at (" + at + ") " + what);
}

// The bodies that scenes name are compiled once, in src/instantiate.
extern template class SolidBody<Quad1, NeoHookean>;
extern template class SolidBody<Quad1, StVenantKirchhoff>;
extern template class SolidBody<Quad1, UncoupledNeoHookean>;
extern template class SolidBody<Quad1, CircumferentialFibre>;
extern template class SolidBody<Quad2, StVenantKirchhoff>;
extern template class SolidBody<Quad1, UncoupledNeoHookean, Displacement, Axisymmetric>;
extern template class SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation>;
extern template class SolidBody<Quad1, UncoupledNeoHookean, MeanDilatation, Axisymmetric>;
extern template class SolidBody<Hex1, UncoupledNeoHookean, MeanDilatation>;
extern template class SolidBody<Wedge1, UncoupledNeoHookean, MeanDilatation>;
extern template class SolidBody<Hex1, NeoHookean, MeanDilatation>;
extern template class SolidBody<Wedge1, NeoHookean, MeanDilatation>;
extern template class SolidBody<Hex2, NeoHookean>;
extern template class SolidBody<Quad1, ThinSheet<NeoHookean>>;
extern template class SolidBody<Quad1, ThinSheet<StVenantKirchhoff>>;
extern template class SolidBody<Quad1, ThinSheet<UncoupledNeoHookean>>;
extern template class SolidBody<Hex2, TensionFibres<ThinSheet<NeoHookean>>, FibredSheet>;

}  // namespace ifsi
