#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Kills bench and study (SIGKILL, every third time Ctrl-C's SIGINT) at random moments, goes on with
# --resume each time, and compares what is there in the end with undisturbed work, times apart:
# kill_test.sh [KILLS] [PROGRAM] [FOLDER]. Default: 100 kills of each command, on a small town.
set -eu
cd "$(dirname -- "$0")/.."
kills=${1:-100}
program=${2:-build/release/bin/ridgeline}
work=${3:-build/kill_test}
rm -rf "$work"
mkdir -p "$work"
"$program" synth --quiet --queries 3 --tilted 0 --portrait 0 --drone 0 --size 320x240 \
  --set town.blocks_east=2 --set town.blocks_north=2 --out "$work/town"
town=$work/town/dataset.json

# kill_one NAME ARGUMENTS...: starts over as often as the work ends before the kills do.
kill_one() {
  name=$1
  shift
  "$program" "$@" --quiet --out "$work/$name.whole"
  python3 scripts/kill_test.py "$kills" "$work/$name.whole" "$work/$name.killed" \
    "$program" "$@" --quiet
}
kill_one bench bench "$town" --protocol known-tilt --seeds 4 --set search.map.spacing_m=2
kill_one study study "$town" --perturb 4,4,0,8 --score evidence,line_energy --classes 20,40 \
  --vary focal=0,5
