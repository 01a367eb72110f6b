#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills a command at random moments until it was killed so often, going on with --resume; when its
work is done, compares it with undisturbed work and starts over in an empty folder:

    kill_test.py KILLS WHOLE OUT PROGRAM ARGUMENTS...
"""
import csv
import io
import json
import pathlib
import random
import shutil
import signal
import subprocess
import sys

TIMES = {"seconds", "seconds_per_query", "pose_evaluations_per_second", "times"}


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(v) for key, v in value.items() if key not in TIMES}
    if isinstance(value, list):
        return [without_times(v) for v in value]
    return value


def content(path):
    """What a file holds, times apart; reports show times and are only there or not."""
    if path.suffix == ".html":
        return ""
    if path.suffix == ".json":
        return without_times(json.loads(path.read_text()))
    if path.suffix == ".csv":
        rows = list(csv.DictReader(io.StringIO(path.read_text())))
        return [{k: v for k, v in row.items() if k not in TIMES} for row in rows]
    return path.read_bytes()


def files(folder):
    return {str(p.relative_to(folder)): content(p) for p in sorted(folder.rglob("*")) if p.is_file()}


def main():
    kills, whole, out = int(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    command = sys.argv[4:] + ["--out", str(out), "--resume"]
    expected = files(whole)
    generator = random.Random(1)
    killed = rounds = 0
    while killed < kills:
        shutil.rmtree(out, ignore_errors=True)
        while True:
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                if killed < kills:
                    process.wait(generator.uniform(0.05, 1.5))
                else:
                    process.wait()
                if process.returncode != 0:
                    sys.exit(f"kill_test.py: exit code {process.returncode} of {' '.join(command)}")
                break
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGINT if killed % 3 == 2 else signal.SIGKILL)
                process.wait()
                killed += 1
        found = files(out)
        for name in sorted(expected.keys() | found.keys()):
            if expected.get(name) != found.get(name):
                sys.exit(f"kill_test.py: {name} differs after {killed} kills")
        rounds += 1
    print(f"{sys.argv[5]}: {killed} kills in {rounds} rounds, {len(expected)} files equal each time")


if __name__ == "__main__":
    main()
