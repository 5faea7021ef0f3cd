#include "ifsi/coupling/interpolation.hpp"

namespace ifsi {

IFSI_FOR_EACH_SPACE_CELL(IFSI_POINT_LOCATOR, )
IFSI_FOR_EACH_SPACE_CELL(IFSI_INTERPOLATION, )

}  // namespace ifsi
