#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds the Python package and packs it as a wheel, without network: wheel.sh [FOLDER] (default:
# build/wheel). Install it with: pip install --no-index FOLDER/ridgeline-*.whl. It uses the system's
# libraries (OpenCV, GDAL, Embree, Ceres, pagmo), so it is for the system that it was built on.
# RIDGELINE_BUILD names a build folder in which it is built already.
set -eu
cd "$(dirname -- "$0")/.."
out=${1:-build/wheel}
[ -n "${RIDGELINE_BUILD:-}" ] || ./scripts/build.sh ridgeline_python
build=${RIDGELINE_BUILD:-$PWD/build/release}
python=$(sed -n 's/^_Python_EXECUTABLE:INTERNAL=//p' "$build/CMakeCache.txt")
if [ -z "$python" ] || [ ! -f "$build/python/ridgeline/VERSION" ]; then
  echo "wheel.sh: the Python package was not built; cmake --preset release says why" >&2
  exit 2
fi
mkdir -p "$out"
rm -f "$out"/ridgeline-*.whl
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -R python/pyproject.toml python/setup.py "$build/python/ridgeline" "$copy"
rm -rf "$copy/ridgeline/__pycache__"
"$python" -m pip wheel --quiet --no-index \
  --no-deps --no-build-isolation --wheel-dir "$out" "$copy"
ls "$out"/ridgeline-*.whl
