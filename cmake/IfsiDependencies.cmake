# The libraries of a Debian 12 machine that ifsi stands on, used by the build and by the installed package.
# Those that show in public headers (MPI, Eigen) are linked publicly; the others are reached through
# ifsi_dependencies only.
include(CMakeFindDependencyMacro)
set(MPI_CXX_SKIP_MPICXX TRUE)  # the C interface is used; the headers of the old C++ one take time to compile
find_dependency(MPI COMPONENTS CXX)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(fmt)
find_dependency(ZLIB)

find_library(HYPRE_LIBRARY HYPRE REQUIRED)
find_path(HYPRE_INCLUDE_DIR HYPRE.h PATH_SUFFIXES hypre REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
find_library(UMFPACK_LIBRARY umfpack REQUIRED)
find_path(SUITESPARSE_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(TOMLPLUSPLUS_LIBRARY tomlplusplus REQUIRED)
mark_as_advanced(HYPRE_LIBRARY HYPRE_INCLUDE_DIR METIS_LIBRARY UMFPACK_LIBRARY SUITESPARSE_INCLUDE_DIR
                 TOMLPLUSPLUS_LIBRARY)

# MUMPS is optional: with it the ranks share the LU of large patches.
option(IFSI_MUMPS "Use MUMPS where it is installed" ON)
find_library(MUMPS_LIBRARY dmumps)
find_path(MUMPS_INCLUDE_DIR dmumps_c.h)
mark_as_advanced(MUMPS_LIBRARY MUMPS_INCLUDE_DIR)

# Imported, so that an exported ifsi::ifsi may name it without exporting it.
if(NOT TARGET ifsi_dependencies)
  add_library(ifsi_dependencies INTERFACE IMPORTED GLOBAL)
  target_include_directories(ifsi_dependencies SYSTEM INTERFACE ${HYPRE_INCLUDE_DIR}
                                                                ${SUITESPARSE_INCLUDE_DIR})
  target_link_libraries(ifsi_dependencies INTERFACE ${HYPRE_LIBRARY} ${METIS_LIBRARY} ${UMFPACK_LIBRARY}
                                                    ${TOMLPLUSPLUS_LIBRARY} fmt::fmt ZLIB::ZLIB)
  if(IFSI_MUMPS AND MUMPS_LIBRARY AND MUMPS_INCLUDE_DIR)
    target_include_directories(ifsi_dependencies SYSTEM INTERFACE ${MUMPS_INCLUDE_DIR})
    target_link_libraries(ifsi_dependencies INTERFACE ${MUMPS_LIBRARY})
  endif()
endif()
