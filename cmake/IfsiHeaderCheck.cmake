# The target ifsi_headers compiles every public header alone. A header that takes from the standard library without
# including it passes where that is precompiled: tools/check.py looks for those.
set(check_dir ${CMAKE_CURRENT_BINARY_DIR}/headers)
foreach(header ${ifsi_headers})
  file(RELATIVE_PATH name ${CMAKE_CURRENT_SOURCE_DIR}/include ${header})
  file(CONFIGURE OUTPUT ${check_dir}/${name}.cpp CONTENT "#include \"@name@\"\n" @ONLY)
  list(APPEND check_sources ${check_dir}/${name}.cpp)
endforeach()
add_library(ifsi_headers OBJECT EXCLUDE_FROM_ALL ${check_sources})
target_link_libraries(ifsi_headers PRIVATE ifsi::ifsi)
target_compile_options(ifsi_headers PRIVATE $<$<CONFIG:Release>:-O1>)
ifsi_precompile(ifsi_headers)
