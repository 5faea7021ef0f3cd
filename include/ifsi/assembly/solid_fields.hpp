#pragma once
/// \file
/// What the loops over a body take and give, whatever the body is made of.

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "ifsi/core/tensor.hpp"
#include "ifsi/solid/principal.hpp"
#include "ifsi/solid/volume_quantile.hpp"

namespace ifsi {

/// Nodal displacement, velocity and acceleration, dim numbers per node, each at its own level of the time
/// scheme. An empty velocity or acceleration is zero.
struct SolidState {
  std::span<const double> u, v = {}, a = {};
};

/// How an assembly went: the smallest det F at a quadrature point, and the cell that has it.
struct DeformationReport {
  double min_det_F = 1e300;
  int cell = -1;
  /// Some cell is turned inside out (or not a number): it was left out and the state must be rejected.
  [[nodiscard]] bool inverted() const { return cell >= 0 && !(min_det_F > 0); }
  /// Keeps the worse of both; a NaN is worst.
  void merge(double det_F, int c) {
    if (!(det_F >= min_det_F) && min_det_F == min_det_F) *this = {det_F, c};
  }
};

/// Balances of a body: volumes (areas in 2D), energies, momentum, mass times position.
template <int dim>
struct SolidTotals {
  double volume = 0, reference_volume = 0, elastic_energy = 0, kinetic_energy = 0;
  Vec<double, dim> momentum{};
  DeformationReport deformation;
};

/// Nodal averages for output. Tensors hold 6 numbers per node: xx, yy, zz, xy, yz, xz (for a body of
/// revolution x, y, z stand for r, z, theta); principal stresses and strains 3, largest first (eq. 30).
struct SolidFields {
  std::vector<double> cauchy, green_lagrange, principal, principal_strain, det_F;
};

/// The six numbers of a symmetric tensor in SolidFields: its rows and columns.
inline constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
/// The tensor of six numbers in that order.
template <class Entry>
Mat<double, 3> symmetric(Entry&& entry) {
  Mat<double, 3> S;
  for (int s = 0; s < 6; ++s) S(voigt[s][0], voigt[s][1]) = S(voigt[s][1], voigt[s][0]) = entry(s);
  return S;
}

/// Weighted means at nodes.
class FieldAverage {
 public:
  explicit FieldAverage(int n_nodes)
      : f_{std::vector<double>(6 * n_nodes), std::vector<double>(6 * n_nodes),
           std::vector<double>(3 * n_nodes), std::vector<double>(3 * n_nodes), std::vector<double>(n_nodes)},
        weight_(n_nodes) {}

  void add(int node, double w, const Mat<double, 3>& sigma, const Mat<double, 3>& E, double J) {
    weight_[node] += w;
    f_.det_F[node] += w * J;
    for (int s = 0; s < 6; ++s) {
      f_.cauchy[6 * node + s] += w * sigma(voigt[s][0], voigt[s][1]);
      f_.green_lagrange[6 * node + s] += w * E(voigt[s][0], voigt[s][1]);
    }
  }
  /// The means, and principal values of them.
  [[nodiscard]] SolidFields fields() const {
    SolidFields f = f_;
    for (int a = 0; a < static_cast<int>(weight_.size()); ++a) {
      if (weight_[a] == 0) continue;
      f.det_F[a] /= weight_[a];
      for (int s = 6 * a; s < 6 * (a + 1); ++s) f.green_lagrange[s] /= weight_[a], f.cauchy[s] /= weight_[a];
      const auto put_principal = [a](const std::vector<double>& tensors, std::vector<double>& values) {
        const auto v = principal_values(symmetric([&](int s) { return tensors[6 * a + s]; }));
        std::copy(v.begin(), v.end(), values.begin() + 3 * a);
      };
      put_principal(f.cauchy, f.principal), put_principal(f.green_lagrange, f.principal_strain);
    }
    return f;
  }

 private:
  SolidFields f_;
  std::vector<double> weight_;
};

/// Largest principal Cauchy stress and Green-Lagrange strain at each quadrature point (eq. 30), with the
/// reference volume there.
struct PrincipalSamples {
  std::vector<VolumeSample> stress, strain;

  void add(const Mat<double, 3>& sigma, const Mat<double, 3>& E, double volume) {
    stress.push_back({principal_values(sigma)[0], volume});
    strain.push_back({principal_values(E)[0], volume});
  }
};

/// What the loops over a body hand to their caller: R has dim numbers per node, K is made of dim x dim
/// blocks, block (a, b) of nodes a, b from (a n + b) dim^2 on, everything row-major.
using CellResidualSink = std::function<void(int cell, std::span<const double> R)>;
using CellTangentSink = std::function<void(int cell, std::span<const double> R, std::span<const double> K)>;
using FaceResidualSink = std::function<void(std::span<const int> nodes, std::span<const double> R)>;
using FaceTangentSink =
    std::function<void(std::span<const int> nodes, std::span<const double> R, std::span<const double> K)>;
/// The same of a face, with the cell it belongs to.
using LoadSink = std::function<void(int cell, std::span<const int> nodes, std::span<const double> R,
                                    std::span<const double> K)>;

}  // namespace ifsi
