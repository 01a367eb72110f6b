#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests of what reads from outside, under the address and undefined-behaviour sanitizers (preset dev):
# sanitized_tests.sh [FOLDER ...], folders of tests/, those below without. "fuzz" is each reader on its
# corpus and damaged copies of it; CI runs that one. The folders above (track, score, localize, eval,
# study, report, cli) take long under sanitizers; run them by hand with ctest --preset dev.
set -eu
cd "$(dirname -- "$0")/.."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --preset dev > "$log" 2>&1 || { cat "$log" >&2; exit 1; }
folders=${*:-base camera city input lines convert fuzz}
# shellcheck disable=SC2046
cmake --build --preset dev --target $(for folder in $folders; do echo "${folder}_tests"; done)
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"
failed=''
for folder in $folders; do
  # Left out, since they take minutes and read nothing that others do not: the counts over all models
  # at hand.
  case $folder in
    city) which='-DataCounts.*' ;;
    *) which='*' ;;
  esac
  echo "== $folder, with sanitizers"
  "build/dev/tests/$folder/${folder}_tests" --gtest_brief=1 "--gtest_filter=$which" ||
    failed="$failed $folder"
done
if [ -n "$failed" ]; then
  echo "sanitized_tests.sh: failed:$failed" >&2
  exit 1
fi
echo "The sanitizers found nothing."
