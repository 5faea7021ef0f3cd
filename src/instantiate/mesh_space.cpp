#include "ifsi/io/mesh_output.hpp"
#include "ifsi/mesh/box.hpp"
#include "ifsi/mesh/distribute.hpp"
#include "ifsi/mesh/gmsh.hpp"

namespace ifsi {

IFSI_FOR_EACH_SPACE_CELL(IFSI_TOPOLOGY, )
IFSI_FOR_EACH_SPACE_CELL(IFSI_CHECK, )
IFSI_FOR_EACH_SPACE_CELL(IFSI_BOX, )
IFSI_FOR_EACH_SPACE_CELL(IFSI_DISTRIBUTE, )
IFSI_FOR_EACH_SPACE_CELL(IFSI_READ_GMSH, )
IFSI_FOR_EACH_SPACE_CELL(IFSI_MESH_OUTPUT, )

}  // namespace ifsi
