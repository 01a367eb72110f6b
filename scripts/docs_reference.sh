#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes the pages of the documents that follow from the code: docs/options.md from the sources,
# docs/commands.md from --help of the release build. With --check it writes nothing and fails if a page is
# not what the code says: docs_reference.sh [--check] [PROGRAM].
set -eu
cd "$(dirname -- "$0")/.."
check=''
if [ "${1:-}" = --check ]; then
  check=yes
  shift
fi
program=${1:-build/release/bin/ridgeline}
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT

commands() {
  echo '# Every command'
  echo
  echo '<!-- Written by scripts/docs_reference.sh from --help; not to be edited. -->'
  echo
  echo "What \`ridgeline COMMAND --help\` prints. Keys of \`--set\` are on [a page of their own](options.md)."
  names=$("$program" --help | sed -n '/^Subcommands:/,/^$/p' | sed -n 's/^  \([a-z]*\) .*/\1/p')
  for name in '' $names; do
    echo
    echo "## ridgeline $name" | sed 's/ $//'
    echo
    echo '```text'
    # shellcheck disable=SC2086  # no argument for the program's own help
    "$program" $name --help | sed 's/[[:space:]]*$//'
    echo '```'
  done
}
commands > "$made/commands.md"
python3 scripts/docs_options.py > "$made/options.md"

stale=''
for page in commands options; do
  cmp -s "$made/$page.md" "docs/$page.md" && continue
  stale="$stale docs/$page.md"
  if [ -n "$check" ]; then
    diff -u "docs/$page.md" "$made/$page.md" | head -20 || true
  else
    cp "$made/$page.md" "docs/$page.md"
  fi
done
if [ -n "$check" ] && [ -n "$stale" ]; then
  echo "docs_reference.sh: not what the code says:$stale; run scripts/docs_reference.sh" >&2
  exit 1
fi
echo "Commands and options:${stale:- as the code says}"
