# What src/io/build_info.cpp reports. The commit is looked up at each build, in a header of its own that changes
# only when the commit does; nothing but build_info.cpp is compiled again for it.
set(ifsi_generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
set(write_commit ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_CURRENT_SOURCE_DIR}
                 -DHEADER=${ifsi_generated}/ifsi_commit.hpp -P ${CMAKE_CURRENT_LIST_DIR}/WriteCommit.cmake)
add_custom_target(ifsi_commit COMMAND ${write_commit} BYPRODUCTS ${ifsi_generated}/ifsi_commit.hpp)
add_dependencies(ifsi ifsi_commit)

string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
get_target_property(options ifsi COMPILE_OPTIONS)
list(JOIN options " " options)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} ${options}" flags)
set_source_files_properties(src/io/build_info.cpp PROPERTIES INCLUDE_DIRECTORIES ${ifsi_generated}
  COMPILE_DEFINITIONS "IFSI_VERSION=\"${PROJECT_VERSION}\";IFSI_FLAGS=\"${CMAKE_BUILD_TYPE}: ${flags}\";\
IFSI_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}\"")
