# SPDX-License-Identifier: Apache-2.0
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY RIDGELINE_MODULES)
# Two components: `program`, which is also what a package holds, and `library`.
install(TARGETS ${modules} EXPORT ridgelineTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(EXPORT ridgelineTargets NAMESPACE ridgeline:: COMPONENT library
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ridgeline)
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ridgeline COMPONENT library
        FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE)
configure_package_config_file(
  cmake/ridgelineConfig.cmake.in ridgelineConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ridgeline)
write_basic_package_version_file(ridgelineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/ridgelineConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/ridgelineConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ridgeline COMPONENT library)
install(DIRECTORY configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ridgeline/configs
        COMPONENT program)

# Documents. ${plotly_license} is that of the library in the HTML reports (ReportWeb.cmake).
set(plotly_license_text " Without the plotting library in this build.")
get_property(plotly_license GLOBAL PROPERTY RIDGELINE_PLOTLY_LICENSE)
if(plotly_license)
  file(STRINGS ${plotly_license} lines)
  list(TRANSFORM lines PREPEND " ")
  list(TRANSFORM lines REPLACE "^ +$" " .")
  list(JOIN lines "\n" plotly_license_text)
endif()
configure_file(cmake/copyright.in copyright @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/copyright LICENSE README.md CHANGELOG.md CITATION.cff
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

add_custom_target(
  uninstall
  COMMAND ${CMAKE_COMMAND} -DMANIFEST=${CMAKE_CURRENT_BINARY_DIR}/install_manifest.txt -P
          ${CMAKE_CURRENT_SOURCE_DIR}/cmake/Uninstall.cmake
  VERBATIM)
