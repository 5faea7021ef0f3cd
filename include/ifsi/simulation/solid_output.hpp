#pragma once
/// \file
/// A deformed body as a grid for ParaView.

#include <span>

#include "ifsi/assembly/solid_body.hpp"
#include "ifsi/io/vtu.hpp"

namespace ifsi {

/// The body moved by the displacement u (dim numbers per node), with displacement, det F, Cauchy stress, its
/// principal values and the Green-Lagrange strain at the nodes. Tensors as in SolidFields.
template <class Body>
[[nodiscard]] VtuPiece deformed_body(const Body& body, std::span<const double> u) {
  using Element = typename Body::Element;
  constexpr int dim = Body::dim;
  VtuPiece piece;
  VtuField displacement{"displacement", "length", 3, {}};
  for (int a = 0; a < body.n_nodes(); ++a)
    for (int i = 0; i < 3; ++i) {
      const double u_i = i < dim ? u[a * dim + i] : 0.0;
      displacement.values.push_back(u_i);
      piece.points.push_back(u_i + (i < dim ? body.mesh().points[a][i] : 0.0));
    }
  for (const auto& cell : body.mesh().cells) {
    for (int k : Element::vtk_order) piece.connectivity.push_back(cell[k]);
    piece.offsets.push_back(static_cast<long>(piece.connectivity.size()));
    piece.types.push_back(static_cast<unsigned char>(Element::vtk_type));
  }
  SolidFields fields = body.fields(u);
  piece.point_fields = {std::move(displacement),
                        {"det_F", "-", 1, std::move(fields.det_F)},
                        {"cauchy_stress", "force/area", 6, std::move(fields.cauchy)},
                        {"principal_stress", "force/area", 3, std::move(fields.principal)},
                        {"green_lagrange", "-", 6, std::move(fields.green_lagrange)},
                        {"principal_strain", "-", 3, std::move(fields.principal_strain)}};
  return piece;
}

}  // namespace ifsi
