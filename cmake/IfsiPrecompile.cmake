# Precompiled headers: half of what a small source takes to compile is the standard library.
option(IFSI_PRECOMPILE "Precompile the headers of the standard library" ${PROJECT_IS_TOP_LEVEL})
set(ifsi_common_headers <algorithm> <array> <cmath> <functional> <map> <memory> <numeric> <span> <string> <vector>
                        <mpi.h>)

# ifsi_precompile(target header...): the common headers, and those named, for the sources of a target.
function(ifsi_precompile target)
  if(IFSI_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ifsi_common_headers} ${ARGN})
  endif()
endfunction()

# ifsi_precompile_as(target maker): the precompiled headers of another target with the same options.
function(ifsi_precompile_as target maker)
  if(IFSI_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${maker})
  endif()
endfunction()
