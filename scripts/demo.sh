#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# From nothing to a localized picture: installs packages, builds, invents a town, localizes a picture of
# it, and says where to look. May be run again at any time; then it is quick.
set -eu
cd "$(dirname -- "$0")/.."
./scripts/install_packages.sh
./scripts/build.sh ridgeline
ridgeline=build/release/bin/ridgeline
town=build/demo/town
mkdir -p build/demo
if [ ! -f $town/dataset.json ]; then
  $ridgeline synth --out $town --seed 1 --queries 6 --tilted 1 --portrait 1 --drone 1
fi
echo
echo "Localizing $town/images/street_005.jpg from a prior that is off by up to 10 m and 20 degrees:"
$ridgeline localize --dataset $town/dataset.json --query street_005 --out build/demo/result \
  --report build/demo/result.html
echo
echo "Look at build/demo/result/overlay.png (the model's edges over the picture) and at the report:"
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && command -v xdg-open >/dev/null; then
  xdg-open build/demo/result.html >/dev/null 2>&1 &
  echo "  build/demo/result.html opens in your browser."
else
  echo "  $PWD/build/demo/result.html, in any browser."
fi
echo
echo "More: $ridgeline bench $town/dataset.json --out build/demo/bench"
