#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes build/package/ridgeline_VERSION_ARCHITECTURE.deb of the release build: the program alone, so that
# tests and libraries need not be built.
set -eu
cd "$(dirname -- "$0")/.."
./scripts/build.sh ridgeline
rm -rf build/package
cpack --config build/release/CPackConfig.cmake -B build/package
# The parts that it was packed from.
rm -rf build/package/_CPack_Packages
