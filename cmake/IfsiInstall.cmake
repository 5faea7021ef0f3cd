# `cmake --install build` and a package that find_package(ifsi) finds in the install tree and in the build tree.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(ifsi_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ifsi)
install(TARGETS ifsi EXPORT ifsi-targets ARCHIVE FILE_SET HEADERS)
install(EXPORT ifsi-targets NAMESPACE ifsi:: DESTINATION ${ifsi_package_dir})
export(EXPORT ifsi-targets NAMESPACE ifsi:: FILE ${PROJECT_BINARY_DIR}/ifsi-targets.cmake)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/ifsi-config.cmake.in
                              ${PROJECT_BINARY_DIR}/ifsi-config.cmake INSTALL_DESTINATION ${ifsi_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ifsi-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
configure_file(${CMAKE_CURRENT_LIST_DIR}/IfsiDependencies.cmake ${PROJECT_BINARY_DIR} COPYONLY)
install(FILES ${PROJECT_BINARY_DIR}/ifsi-config.cmake ${PROJECT_BINARY_DIR}/ifsi-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/IfsiDependencies.cmake
        DESTINATION ${ifsi_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
