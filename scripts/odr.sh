#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds the program with link-time optimization and asks the linker for types and functions that are
# not the same everywhere (-Wodr). An error for each. Takes a whole build of its own, in build/odr: for
# before a release; the test names.unique finds the usual fault in a second.
set -eu
cd "$(dirname -- "$0")/.."
./scripts/install_packages.sh
cmake --preset odr
nice -n 15 cmake --build --preset odr --target ridgeline
