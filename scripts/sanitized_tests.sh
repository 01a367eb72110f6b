#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests of everything that reads from outside, under the address and undefined-behaviour sanitizers
# (preset dev): the folders below, which need no search. The folders above them (track, score, localize,
# eval, study, report, cli) take long under sanitizers; run them by hand with ctest --preset dev.
set -eu
cd "$(dirname -- "$0")/.."
cmake --preset dev > /dev/null
folders="base camera city input lines optim convert"
# shellcheck disable=SC2086
cmake --build --preset dev --target $(for folder in $folders; do echo "${folder}_tests"; done)
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"
for folder in $folders; do
  # Left out, since they take minutes and read nothing that others do not: the counts over all
  # models at hand; and of optim all but its files, the rest being searches on formulas.
  case $folder in
    city) which='-DataCounts.*' ;;
    optim) which='TraceFile.*:SearchBox.*' ;;
    *) which='*' ;;
  esac
  echo "== $folder, with sanitizers"
  "build/dev/tests/$folder/${folder}_tests" --gtest_brief=1 "--gtest_filter=$which"
done
