#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Feeds a reader with damaged files: fuzz.sh TARGET MINUTES. The targets are the folders of
# tests/fuzz/corpus. Needs clang and its libFuzzer (Debian 12: clang, libclang-rt-14-dev). New inputs
# go to build/fuzz/corpus/TARGET; a finding ends it and is written to build/fuzz/findings: put it,
# made small with -minimize_crash=1, into tests/fuzz/corpus/TARGET, where the tests replay it.
set -eu
cd "$(dirname -- "$0")/.."
if [ $# -ne 2 ] || [ ! -d "tests/fuzz/corpus/$1" ]; then
  echo "fuzz.sh TARGET MINUTES; targets: $(ls tests/fuzz/corpus | tr '\n' ' ')" >&2
  exit 2
fi
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz --target ridgeline_fuzz
found="build/fuzz/findings"
grown="build/fuzz/corpus/$1"
mkdir -p "$found" "$grown"
# A reader that takes ten seconds or 1 GB for one input of 64 kB is a finding, too.
RIDGELINE_FUZZ_TARGET="$1" exec build/fuzz/tests/fuzz/ridgeline_fuzz "$grown" \
  "tests/fuzz/corpus/$1" "-artifact_prefix=$found/$1-" "-max_total_time=$(($2 * 60))" \
  -max_len=65536 -timeout=10 -rss_limit_mb=1024 -print_final_stats=1
