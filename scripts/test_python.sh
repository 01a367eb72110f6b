#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests the Python package as its users have it: packs the wheel, installs it without network in a new
# virtual environment, and runs the tests and the notebooks there. RIDGELINE_BUILD names the build
# folder (default: build/release), arguments go to pytest.
set -eu
cd "$(dirname -- "$0")/.."
build=${RIDGELINE_BUILD:-$PWD/build/release}
python=$(sed -n 's/^_Python_EXECUTABLE:INTERNAL=//p' "$build/CMakeCache.txt")
RIDGELINE_BUILD=$build ./scripts/wheel.sh "$build/wheel"
rm -rf "$build/venv"
# NumPy, pytest and Matplotlib are the system's.
"$python" -m venv --system-site-packages "$build/venv"
"$build/venv/bin/pip" install --quiet --no-index --no-deps "$build"/wheel/ridgeline-*.whl
RIDGELINE_PROGRAM="$build/bin/ridgeline" "$build/venv/bin/python" -m pytest -q \
  -p no:cacheprovider python/tests "$@"
