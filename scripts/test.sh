#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs packages, builds everything, runs all tests. Fails if any test fails. May be run again at
# any time; then it is quick. Arguments go to ctest, e.g. test.sh -R synth.
set -eu
cd "$(dirname -- "$0")/.."
./scripts/install_packages.sh
./scripts/build.sh
if command -v mkdocs >/dev/null; then
  ./scripts/site.sh
fi
ctest --preset release --no-tests=error --parallel "$(nproc)" "$@"
