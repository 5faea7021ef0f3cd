#pragma once
/// \file
/// The choice between a material as a volume and as a thin sheet.

#include <string>

#include "ifsi/io/parameters.hpp"
#include "ifsi/material/thin_sheet.hpp"

namespace ifsi {

/// Whether leaflets have their law as it is, or that of a thin sheet of it (eq. 29).
struct LawChoice {
  std::string law = "volume";
  double shear = 0.05, kappa = 0.3;  ///< of the sheet, in units of Young's modulus

  void declare(Parameters& params) {
    params.add_choice("solid.law", law, {"volume", "sheet"},
                      "the material as a volume, or its plane stress in a thin sheet");
    declare_sheet(params);
  }
  void declare_sheet(Parameters& params) {
    params.add("solid.sheet_shear", shear, "E", "stiffness of a sheet against transverse shear", {1e-6, 1.0});
    params.add("solid.sheet_kappa", kappa, "E", "stiffness of a sheet against change of volume", {1e-6, 1e3});
  }
  [[nodiscard]] bool is_sheet() const { return law == "sheet"; }
  template <SolidLaw Law>
  [[nodiscard]] ThinSheet<Law> sheet(const Law& volume, const Vec<double, 3>& normal) const {
    const double E = volume.young_modulus();
    return {volume, normal, shear * E, kappa * E};
  }
};

}  // namespace ifsi
