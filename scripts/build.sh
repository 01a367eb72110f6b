#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Configures and builds the release preset: build.sh [TARGET ...], everything without targets.
set -eu
cd "$(dirname -- "$0")/.."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! cmake --preset release > "$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi
grep -E '^-- ridgeline:' "$log" || true
if [ $# -gt 0 ]; then
  cmake --build --preset release --target "$@"
else
  cmake --build --preset release
fi
