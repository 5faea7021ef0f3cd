#pragma once
/// \file
/// Values of nodal fields at fixed positions, on any number of ranks.

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "ifsi/core/error.hpp"
#include "ifsi/coupling/point_locator.hpp"

namespace ifsi {

/// Finds its positions once; every rank gets every value. Collective throughout.
template <class Element>
class Probe {
 public:
  static constexpr int dim = Element::dim;
  using Point = Vec<double, dim>;

  /// \throws Error (configuration) naming the first position that lies outside of the mesh.
  Probe(const Mesh<Element>& mesh, const std::vector<Point>& positions) : mesh_(mesh) {
    const PointLocator<Element> locator(mesh);
    for (const Point& x : positions) {
      auto location = locator.find(x);
      const double none = std::numeric_limits<double>::max();
      const double key = location.found() ? mesh.input_cell[location.cell] : none;
      const double winner = mesh.comm.min(key);
      if (winner == none)
        throw Error(ExitCode::configuration, "position" + text(x) + " lies outside of the mesh");
      if (key != winner || location.cell >= mesh.n_owned_cells) location.cell = -1;
      locations_.push_back(location);
    }
  }

  /// All `block` unknowns per node at all positions, position after position.
  [[nodiscard]] std::vector<double> values(std::span<const double> u, int block) const {
    std::vector<double> result(locations_.size() * block, 0.0);
    for (std::size_t k = 0; k < locations_.size(); ++k) {
      if (!locations_[k].found()) continue;
      std::array<double, Element::n_nodes> N;
      Element::shape_functions(locations_[k].xi, N);
      for (int a = 0; a < Element::n_nodes; ++a)
        for (int i = 0; i < block; ++i)
          result[k * block + i] +=
              N[a] * u[static_cast<std::size_t>(mesh_.cells[locations_[k].cell][a]) * block + i];
    }
    mesh_.comm.sum_in_place(result.data(), static_cast<int>(result.size()));
    return result;
  }

 private:
  static std::string text(const Point& x) {
    std::string s;
    for (int i = 0; i < dim; ++i) s += " " + std::to_string(x[i]);
    return s;
  }
  const Mesh<Element>& mesh_;
  std::vector<typename PointLocator<Element>::Location> locations_;
};

}  // namespace ifsi
