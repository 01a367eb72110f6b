#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the protocols of docs/dataset.md on many invented towns in trouble and puts all results into
one table, from which a confidence can be learned and on which it can be judged.

    scripts/calibrate.py --towns 100 --out build/calibration
    scripts/calibrate.py --towns 1000 --shard 3/8 --out build/calibration     (one of eight machines)

Everything follows from the number of a town, so that shards together make the same table as one
run. What is there is not made again: after an interruption, or with more towns, call it again.
Writes OUT/towns/NNNN (synth), OUT/runs/NNNN_PROTOCOL (bench) and OUT/results.csv: one row per run
with the town's number, its half ("learn": even numbers, "judge": odd ones), its trouble, and the
columns of bench's results.csv.
"""

import argparse
import collections
import concurrent.futures
import csv
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import threading

PROTOCOLS = ["known-tilt", "phone", "outside", "elsewhere"]
# Shares of the kinds of pictures.
KINDS = {"street": 5, "tilted": 3, "portrait": 2, "drone": 1, "low": 1}
# One job at a time makes a town; another process of the same folder may make it too.
MAKING = collections.defaultdict(threading.Lock)


def trouble_of(town):
    """What is wrong with a town: a fifth of them nearly nothing, a fifth nearly all of it."""
    draw = random.Random(f"town {town}")
    level = min(1.0, max(0.0, draw.uniform(-0.25, 1.25)))
    up_to = lambda most: round(level * draw.uniform(0.0, most), 3)
    return {
        "town.style": draw.choice(["mixed", "suburb", "centre", "village", "estate"]),
        "town.relief_m": round(draw.uniform(0.0, 8.0), 2),
        "town.block_m": round(draw.uniform(70.0, 110.0), 1),
        "town.trees": round(draw.uniform(0.0, 2.0), 2),
        "overhang_m": round(draw.uniform(0.0, 0.8), 2),
        "survey_sigma_m": round(draw.uniform(0.03, 0.3), 3),
        "trouble.wrong_share": up_to(0.6),
        "trouble.roof_m": up_to(2.0),
        "trouble.outline_m": up_to(1.0),
        "trouble.missing_share": up_to(0.2),
        "trouble.gone_share": up_to(0.15),
        "trouble.focal_share": up_to(0.05),
        "trouble.lod": 1 if draw.random() < 0.05 * level else 2,
        "grey": draw.random() < 0.05,
    }


def pictures_of(count):
    """So many pictures of each kind that they are `count` together."""
    whole = sum(KINDS.values())
    counts = {kind: count * share // whole for kind, share in KINDS.items()}
    counts["street"] += count - sum(counts.values())
    return counts


def run(command):
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr}")


def make_town(args, town):
    """The dataset of a town; made if it is not there."""
    with MAKING[town]:
        folder = args.out / "towns" / f"{town:04d}"
        if not (folder / "dataset.json").exists():
            synthesize(args, town, folder)
        return folder / "dataset.json"


def synthesize(args, town, folder):
    command = [args.program, "synth", "--quiet", "--seed", str(1000 + town), "--size", args.size,
               "--threads", str(args.threads)]
    settings = {**trouble_of(town), **pictures_of(args.pictures),
                "town.blocks_east": 3, "town.blocks_north": 3}
    for key, value in settings.items():
        command += ["--set", f"{key}={json.dumps(value) if isinstance(value, bool) else value}"]
    # Two shards may want the same town: the first one there keeps it.
    made = pathlib.Path(tempfile.mkdtemp(dir=args.out / "towns"))
    run(command + ["--out", str(made / "town")])
    try:
        os.rename(made / "town", folder)
    except OSError:
        pass
    shutil.rmtree(made, ignore_errors=True)


def run_protocol(args, town, protocol):
    folder = args.out / "runs" / f"{town:04d}_{protocol}"
    if (folder / "summary.json").exists():
        return
    command = [args.program, "bench", str(make_town(args, town)), "--quiet", "--no-report",
               "--threads", str(args.threads), "--protocol", protocol, "--seed", str(town + 1),
               "--seeds", str(args.seeds), "--resume", "--out", str(folder)]
    if protocol == "elsewhere":
        command += ["--world", str(make_town(args, (town + 1) % args.towns))]
    run(command + args.bench)


def collect(args):
    """All results there are, in the order of towns and protocols."""
    table = args.out / "results.csv"
    partial = table.with_suffix(f".{os.getpid()}")
    rows = 0
    with open(partial, "w", newline="") as out:
        writer = None
        for folder in sorted((args.out / "runs").iterdir()):
            if not (folder / "summary.json").exists():
                continue
            town, protocol = folder.name.split("_", 1)
            half = "learn" if int(town) % 2 == 0 else "judge"
            for row in csv.DictReader(open(folder / "results.csv", newline="")):
                whole = {"town": int(town), "half": half, "protocol": protocol,
                         **trouble_of(int(town)), **row}
                if writer is None:
                    writer = csv.DictWriter(out, whole.keys())
                    writer.writeheader()
                writer.writerow(whole)
                rows += 1
    os.replace(partial, table)
    print(f"{table}: {rows} runs")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/bin/ridgeline")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("build/calibration"))
    parser.add_argument("--towns", type=int, default=100)
    parser.add_argument("--pictures", type=int, default=12, help="of each town")
    parser.add_argument("--size", default="480x360", help="of the pictures")
    parser.add_argument("--seeds", type=int, default=1, help="priors of each picture and protocol")
    parser.add_argument("--protocols", default=",".join(PROTOCOLS))
    parser.add_argument("--shard", default="0/1", help="i/n: towns whose number leaves i by n")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes at once")
    parser.add_argument("--threads", type=int, default=1, help="of each process")
    parser.add_argument("bench", nargs="*", help="after --: more arguments for bench")
    args = parser.parse_args()
    shard, shards = (int(part) for part in args.shard.split("/"))
    if args.towns < 2 or not 0 <= shard < shards:
        parser.error("at least two towns, and a shard i/n with 0 <= i < n")
    for folder in ("towns", "runs"):
        (args.out / folder).mkdir(parents=True, exist_ok=True)
    tasks = [(town, protocol) for town in range(shard, args.towns, shards)
             for protocol in args.protocols.split(",")]
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        running = [pool.submit(run_protocol, args, *task) for task in tasks]
        for done, future in enumerate(concurrent.futures.as_completed(running), 1):
            future.result()
            print(f"\r{done} of {len(tasks)}", end="", file=sys.stderr)
    print(file=sys.stderr)
    collect(args)


if __name__ == "__main__":
    main()
