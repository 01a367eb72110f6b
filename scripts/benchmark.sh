#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds with benchmarks, runs the accuracy and speed benchmarks, and writes their tables into
# BENCHMARK.md: benchmark.sh [DATA] [SEEDS]. DATA holds munich/ and ingolstadt/ (default:
# ../shared/data); raw results go to build/benchmark/. About an hour on two cores with five seeds.
set -eu
cd "$(dirname -- "$0")/.."
data=${1:-../shared/data}
seeds=${2:-5}
for set in munich/dataset.json ingolstadt/dataset_street.json; do
  if [ ! -f "$data/$set" ]; then
    echo "benchmark.sh: no $data/$set; give the folder that holds munich/ and ingolstadt/" >&2
    exit 2
  fi
done
cmake --preset bench
cmake --build --preset bench
program=build/bench/bin/ridgeline
out=build/benchmark
mkdir -p "$out"

# run NAME DATASET SEEDS ARGUMENTS...
run() {
  name=$1 dataset=$2 runs=$3
  shift 3
  echo "== $name"
  rm -rf "${out:?}/$name"
  "$program" bench "$data/$dataset" --seeds "$runs" --out "$out/$name" "$@"
}
run munich munich/dataset.json "$seeds" --protocol known-tilt
run street ingolstadt/dataset_street.json "$seeds" --protocol known-tilt
run munich_phone munich/dataset.json "$seeds" --protocol phone
run street_phone ingolstadt/dataset_street.json "$seeds" --protocol phone
run munich_outside munich/dataset.json "$seeds" --protocol outside
run street_outside ingolstadt/dataset_street.json "$seeds" --protocol outside
run munich_elsewhere munich/dataset.json "$seeds" --protocol elsewhere \
  --world "$data/ingolstadt/dataset_street.json"
run street_elsewhere ingolstadt/dataset_street.json "$seeds" --protocol elsewhere \
  --world "$data/munich/dataset.json"
run tilted ingolstadt/dataset_tilted.json "$seeds" --perturb 10,10,0.5,20,5,5
run drone ingolstadt/dataset_drone.json "$seeds" --config configs/drone.json \
  --perturb 10,10,10,15,5,5
run street_wide ingolstadt/dataset_street.json 1 --perturb 40,40,0,180
run munich_sensors munich/dataset.json 1
run street_sensors ingolstadt/dataset_street.json 1
run tilted_sensors ingolstadt/dataset_tilted.json 1
run munich_skyline munich/dataset.json 1 --config configs/skyline.json --perturb 10,10,0,20
run street_skyline ingolstadt/dataset_street.json 1 --config configs/skyline.json \
  --perturb 10,10,0,20
run munich_paper munich/dataset.json "$seeds" --config configs/paper.json --perturb 10,10,0,20
run street_paper ingolstadt/dataset_street.json 1 --config configs/paper.json \
  --perturb 10,10,0,20
for benchmark in projection_bench skyline_bench optim_suggest_bench city_bench; do
  echo "== $benchmark"
  "build/bench/bench/$benchmark" --benchmark_out="$out/$benchmark.json" \
    --benchmark_out_format=json || echo "$benchmark did not run"
done
python3 scripts/benchmark_tables.py "$out" BENCHMARK.md
