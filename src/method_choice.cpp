#include "ifsi/linalg/method_choice.hpp"

namespace ifsi {

MethodChoice choose_method(const SystemTraits& system) {
  long limit = 5'000;
  std::string where = "in the plane where few sweeps serve the velocity";
  if (system.dim == 3) {
    limit = 3'000;
    where = "in space";
  } else if (system.immersed) {
    limit = 400'000;
    where = "in the plane with immersed solids";
  } else if (system.ranks > 1) {
    where = "in the plane on several ranks";
  } else if (system.needs_amg) {
    limit = 150'000;
    where = "in the plane on one rank where the velocity needs AMG";
  } else if (system.diffusive) {
    limit = 40'000;
    where = "in the plane on one rank where diffusion crosses cells";
  }
  const bool direct = system.unknowns <= limit;
  return {direct, (direct ? "at most " : "more than ") + std::to_string(limit) + ", the limit " + where};
}

}  // namespace ifsi
