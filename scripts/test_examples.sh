#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs the examples of every command's --help, in a folder of their own, on the town and the walk that those
# of `synth` make: test_examples.sh [PROGRAM]. A quarter of an hour on two cores.
set -eu
cd "$(dirname -- "$0")/.."
program=$(realpath "${1:-build/release/bin/ridgeline}")
work=build/examples
rm -rf $work
mkdir -p $work
cd $work
PATH=$(dirname "$program"):$PATH
names=$(ridgeline --help | sed -n '/^Subcommands:/,/^$/p' | sed -n 's/^  \([a-z]*\) .*/\1/p')
# The town first, and results before what reads them.
failed=''
for name in synth bench $(echo "$names" | grep -vx -e synth -e bench); do
  ridgeline "$name" --help | sed -n '/^Example:/,$p' | sed '1d; s/^  //' > "$name.sh"
  if [ ! -s "$name.sh" ]; then
    echo "$name: no example"
    failed="$failed $name"
    continue
  fi
  started=$(date +%s)
  # 3: an abstention is an answer.
  if bash -eu "$name.sh" > "$name.log" 2>&1 || [ $? -eq 3 ]; then
    echo "$name: $(($(date +%s) - started)) s"
  else
    echo "$name: failed, see $work/$name.log"
    tail -3 "$name.log"
    failed="$failed $name"
  fi
done
[ -z "$failed" ] || exit 1
echo "The examples of all commands run."
