# SPDX-License-Identifier: Apache-2.0
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY RIDGELINE_MODULES)
install(TARGETS ${modules} EXPORT ridgelineTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT ridgelineTargets NAMESPACE ridgeline::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ridgeline)
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ridgeline
        FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE)
configure_package_config_file(
  cmake/ridgelineConfig.cmake.in ridgelineConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ridgeline)
write_basic_package_version_file(ridgelineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/ridgelineConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/ridgelineConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ridgeline)
install(DIRECTORY configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ridgeline/configs)
