# SPDX-License-Identifier: Apache-2.0
# cmake -DSOURCE=... -DVERSION=... -DOUT=... -P: the header with git's part of the version; written only
# where it changed, so that a commit costs one small file and a link.
include(${CMAKE_CURRENT_LIST_DIR}/GitRevision.cmake)
ridgeline_git_revision(${SOURCE} ${VERSION} revision)
set(text "// SPDX-License-Identifier: Apache-2.0\n#pragma once\n#define RIDGELINE_REVISION \"${revision}\"\n")
file(CONFIGURE OUTPUT ${OUT} CONTENT "${text}" @ONLY)
