# SPDX-License-Identifier: Apache-2.0
# `cmake --build build/release --target package` makes a .deb of the program: what Debian's tools find
# that it needs, configurations, completion, manual, documents. The library is left to
# `cmake --install`, which has all.
include(GitRevision)
ridgeline_git_revision(${PROJECT_SOURCE_DIR} ${PROJECT_VERSION} revision)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ridgeline)
set(CPACK_PACKAGE_VENDOR "ridgeline")
set(CPACK_PACKAGE_CONTACT "ridgeline developers <ridgeline@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION}${revision})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "finds the pose of a photo from a city model alone")
set(CPACK_PACKAGE_DESCRIPTION
    "The straight edges of LoD2 buildings are laid on the straight edges of the picture, over all
poses that a terrain model allows. No image database, no training, no GNSS. The answer is the pose
with its confidence and the other modes, or an abstention with its reason.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Projections and grids are files that no library links.
set(CPACK_DEBIAN_PACKAGE_DEPENDS proj-data)
include(CPack)
