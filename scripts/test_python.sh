#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests the Python package as its users have it: makes the wheel, installs it without network in a
# new virtual environment, and runs the tests and the notebooks there. Says so and does nothing
# where the package is not built.
set -eu
cd "$(dirname -- "$0")/.."
python=$(sed -n 's/^_Python_EXECUTABLE:INTERNAL=//p' build/release/CMakeCache.txt)
if [ ! -d build/release/python ] || [ -z "$python" ]; then
  echo "The Python package was not built; cmake --preset release says why. Its tests are skipped."
  exit 0
fi
RIDGELINE_BUILT=1 ./scripts/wheel.sh build/wheel
rm -rf build/venv
# NumPy, pytest and Matplotlib are the system's.
"$python" -m venv --system-site-packages build/venv
build/venv/bin/pip install --quiet --no-index --no-deps build/wheel/ridgeline-*.whl
export RIDGELINE_PROGRAM="$PWD/build/release/bin/ridgeline"
# Beside the folder python/, so that the wheel is what is imported.
build/venv/bin/python -m pytest -q -p no:cacheprovider python/tests "$@"
