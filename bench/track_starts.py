#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Errors of `ridgeline track` after its start, over many starts along drives.

Each drive (a folder of `ridgeline synth --drive`) is cut into stretches. Each stretch starts from a
place drawn within +- --start metres of the truth, of any heading, and is tracked with the drive's
odometry. What counts is the last frame of the stretch, as it came.

  bench/track_starts.py --program build/src/cli/ridgeline --out starts drive_1 drive_2
"""
import argparse
import csv
import json
import pathlib
import random
import subprocess
import sys


def stretch(drive, first, count, start_m, folder):
    dataset = json.loads((drive / "dataset.json").read_text())
    queries = dataset["queries"][first : first + count]
    for query in queries:
        query["image"] = str((drive / query["image"]).resolve())
    dataset["queries"] = queries
    for key in ("model", "dtm"):
        value = dataset[key]
        resolve = lambda name: str((drive / name).resolve())
        dataset[key] = [resolve(v) for v in value] if isinstance(value, list) else resolve(value)
    rng = random.Random(f"{drive.name} {first}")
    place = queries[0]["truth"]["position"]
    queries[0]["prior"] = {
        "position": [place[i] + rng.uniform(-start_m, start_m) for i in range(2)]
    }
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "dataset.json").write_text(json.dumps(dataset))


def track(program, drive, folder, options):
    done = subprocess.run(
        [program, "track", "--quiet", str(folder / "dataset.json"), "--odometry",
         str(drive / "odometry.csv"), "--out", str(folder / "out"), *options],
        stdout=subprocess.DEVNULL, check=False)
    if done.returncode not in (0, 3):
        sys.exit(f"{folder}: ridgeline track ended with {done.returncode}")
    with open(folder / "out" / "frames.csv") as file:
        return list(csv.DictReader(file))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("drives", nargs="+", type=pathlib.Path)
    parser.add_argument("--program", default="ridgeline")
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--start", type=float, default=20.0)
    parser.add_argument("--frames", type=int, default=10)
    parser.add_argument("--options", default="", help="more options of track, e.g. '--threads 1'")
    arguments = parser.parse_args()
    last, frames = [], []
    for drive in arguments.drives:
        queries = len(json.loads((drive / "dataset.json").read_text())["queries"])
        for first in range(0, queries - arguments.frames + 1, arguments.frames):
            folder = arguments.out / f"{drive.name}_{first:03d}"
            stretch(drive, first, arguments.frames, arguments.start, folder)
            rows = track(arguments.program, drive, folder, arguments.options.split())
            end = rows[-1]
            print(f"{folder.name:24} {end['state']:12} error {end['error_m'] or '-':>8} m "
                  f"{end['error_deg'] or '-':>8} deg, confidence {end['confidence']}, evidence "
                  f"{end['explained']}, {sum(float(r['milliseconds']) for r in rows) / 1e3:.1f} s",
                  flush=True)
            last.append(end)
            frames += rows
    error = lambda row, name: float(row[name]) if row[name] else float("inf")
    share = lambda rows, test: f"{100.0 * sum(map(test, rows)) / max(1, len(rows)):.1f} %"
    print(f"{len(last)} starts; at frame {arguments.frames}:")
    for metres in (1, 3, 5):
        print(f"  within {metres} m: {share(last, lambda r: error(r, 'error_m') <= metres)}")
    print(f"  within 5 deg: {share(last, lambda r: error(r, 'error_deg') <= 5.0)}")
    print(f"  tracking: {share(last, lambda r: r['state'] == 'tracking')}")
    sure = [r for r in frames if float(r["confidence"]) >= 0.9]
    wrong = sum(1 for r in sure if error(r, "error_m") > 5.0)
    print(f"{len(frames)} frames, {len(sure)} of confidence 0.9 or more, {wrong} of them off by > 5 m")


if __name__ == "__main__":
    main()
