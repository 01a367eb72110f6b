#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes the figures of the documents, docs/figures/, of the demo town with the release build:
# docs_figures.sh. Needs the packages imagemagick and chromium. Some minutes; the same pictures again from
# the same program, but for the time in the report.
set -eu
cd "$(dirname -- "$0")/.."
for tool in convert chromium; do
  command -v $tool >/dev/null || { echo "docs_figures.sh: needs imagemagick and chromium" >&2; exit 2; }
done
./scripts/build.sh ridgeline
ridgeline=$PWD/build/release/bin/ridgeline
out=$PWD/docs/figures
work=build/figures
query=street_005
mkdir -p $work "$out"
cd $work
# The town of demo.sh.
if [ ! -f town/dataset.json ]; then
  "$ridgeline" synth --out town --seed 1 --queries 6 --tilted 1 --portrait 1 --drone 1
fi

# What the program says, without what differs from run to run.
"$ridgeline" localize --dataset town/dataset.json --query $query --out result --report result.html \
  2>/dev/null | grep -v '^time ' > "$out/first_result.txt"
"$ridgeline" study town/dataset.json --query $query --score evidence,line_energy --out study >/dev/null
"$ridgeline" skyline --dataset town/dataset.json --out sky --overlays >/dev/null
"$ridgeline" render --dataset town/dataset.json --query $query --at prior --no-legend --out prior.png
"$ridgeline" render --dataset town/dataset.json --query $query --shaded shaded.png

page() {  # NAME WIDTH HEIGHT
  chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size="$2,$3" \
    --screenshot="$PWD/$1.png" "file://$PWD/$1.html" >/dev/null 2>&1
}
# A figure is not of one commit.
sed -i 's/\(ridgeline [0-9.]*\)+[0-9a-z.]*/\1/g' result.html
page result 1000 1500

photo() {  # FROM NAME
  convert "$1" -resize 800x -strip -interlace none -quality 80 "$out/$2.jpg"
}
photo town/images/$query.jpg photo
photo prior.png prior
photo shaded.png model
photo result/overlay.png overlay
photo sky/${query}_overlay.jpg skyline
photo result.png report
for score in evidence line_energy; do
  convert study/maps/${query}_$score.png -strip -colors 128 "$out/map_$score.png"
done
ls -l "$out"
