#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the tables of docs/skyline.md, between their markers, from runs of `ridgeline skyline`.

skyline_table.py PROGRAM WORK [MUNICH]: PROGRAM is build/.../bin/ridgeline; walks are made in the
folder WORK, or taken from it if they are there; MUNICH is the folder of the real sequence
(default: ../shared/data/munich; left out if absent). About ten minutes.
"""
import collections
import csv
import json
import pathlib
import subprocess
import sys

SEEDS = (1, 2, 3)
WALK_FRAMES = 60
SENSORS = ["start=sensors"]
PLAIN = ["l1.robust=false", "match.max_distance_px=12"]
KNOWN = SENSORS + ["match.position_sigma_m=0.3"]
# Name, whether the true position is given, options.
METHODS = [
    ("2d, GNSS position", False, SENSORS + ["match.method=2d"]),
    ("2x2d, GNSS position", False, SENSORS + ["match.method=2x2d"]),
    ("3d, GNSS position", False, SENSORS + ["match.method=3d"]),
    ("2d, known position", True, KNOWN + ["match.method=2d"]),
    ("2x2d, known position", True, KNOWN + ["match.method=2x2d"]),
    ("3d, known position", True, KNOWN + ["match.method=3d"]),
    ("3d, known position, plain L1", True, KNOWN + PLAIN + ["match.method=3d"]),
    ("6dof, each frame alone", False, SENSORS + ["match.method=6dof"]),
    ("default: from the last frame, key frames", False, []),
    ("default, plain L1", False, PLAIN),
]


def run(program, arguments):
    done = subprocess.run([program, "skyline", "--threads", "1", "--quiet", *arguments],
                          capture_output=True, text=True)
    if done.returncode not in (0, 3):  # 3: no frame matched, which is a result
        sys.exit(f"skyline_table.py: {done.stderr}")


def frames(program, work, name, dataset, sensors, options):
    out = work / "runs" / name
    if out.exists():
        for file in out.iterdir():
            file.unlink()
        out.rmdir()
    out.parent.mkdir(exist_ok=True)
    arguments = ["--dataset", str(dataset), "--out", str(out)]
    if sensors:
        arguments += ["--sensors", str(sensors)]
    for option in options:
        arguments += ["--set", option]
    run(program, arguments)
    with open(out / "frames.csv", newline="") as file:
        return list(csv.DictReader(file))


def with_known_positions(dataset, by_sensors, path):
    """The dataset with the true positions and the sensors' angles as priors."""
    text = json.loads(dataset.read_text())
    angles = {row["id"]: row for row in by_sensors}
    text["model"] = [str((dataset.parent / m).resolve()) for m in text["model"]]
    text["dtm"] = str((dataset.parent / text["dtm"]).resolve())
    text["queries"] = [q for q in text["queries"] if "truth" in q]
    for query in text["queries"]:
        row = angles[query["id"]]
        query["image"] = str((dataset.parent / query["image"]).resolve())
        query["prior"] = {"position": query["truth"]["position"],
                          "heading_deg": float(row["start_heading_deg"]) % 360.0,
                          "pitch_deg": float(row["start_pitch_deg"]),
                          "roll_deg": float(row["start_roll_deg"])}
    path.write_text(json.dumps(text))
    return path


def values(rows, column):
    return [float(r[column]) for r in rows if r[column] != ""]


def mean(rows, column):
    v = values(rows, column)
    return f"{sum(v) / len(v):.1f}" if v else "–"


def quantiles(rows, column):
    v = sorted(abs(x) for x in values(rows, column))
    return f"{v[len(v) // 2]:.2f} / {v[int(0.9 * (len(v) - 1))]:.2f}" if v else "–"


def fastest(rows, column):
    """The tenth fastest of a hundred: other programs on the machine disturb it least."""
    v = sorted(values(rows, column))
    return f"{v[len(v) // 10]:.1f}" if v else "–"


def line(name, rows):
    ok = [r for r in rows if r["status"] == "ok"]
    wrong = sum(1 for r in ok if r["heading_error_deg"] and abs(float(r["heading_error_deg"])) > 3)
    others = collections.Counter(r["status"] for r in rows if r["status"] != "ok")
    reasons = ", ".join(f"{n} {status}" for status, n in others.most_common()) or "none"
    return (f"| {name} | {mean(rows, 'l1_before_px')} → {mean(rows, 'l1_after_px')} "
            f"| {mean(rows, 'plain_l1_before_px')} → {mean(rows, 'plain_l1_after_px')} "
            f"| {len(ok)} of {len(rows)}; {reasons} | {wrong} | {quantiles(ok, 'heading_error_deg')} "
            f"| {quantiles(ok, 'pitch_error_deg')} | {quantiles(ok, 'roll_error_deg')} "
            f"| {fastest(rows, 'extract_ms')} + {fastest(rows, 'match_ms')} |")


def table(program, work, name, title, dataset, sensors, options):
    by_sensors = frames(program, work, name + "_sensors", dataset, sensors, options + SENSORS)
    known = with_known_positions(dataset, by_sensors, work / (name + "_known.json"))
    lines = [f"**{title}.** At the true poses L1 is {mean(by_sensors, 'l1_truth_px')} px, plain "
             f"{mean(by_sensors, 'plain_l1_truth_px')} px.", "",
             "| method | L1 [px] | plain L1 [px] | frames with a pose; without | wrong "
             "| heading [°] | pitch [°] | roll [°] | ms |",
             "|---|---|---|---|---|---|---|---|---|"]
    for index, (method, position_known, extra) in enumerate(METHODS):
        if position_known:
            rows = frames(program, work, f"{name}_{index}", known, None, extra)
        else:
            rows = frames(program, work, f"{name}_{index}", dataset, sensors, options + extra)
        lines.append(line(method, rows))
    return "\n".join(lines)


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    program, work = sys.argv[1], pathlib.Path(sys.argv[2])
    root = pathlib.Path(__file__).resolve().parent.parent
    munich = pathlib.Path(sys.argv[3]) if len(sys.argv) == 4 else root / "../shared/data/munich"
    work.mkdir(parents=True, exist_ok=True)
    parts = []
    for seed in SEEDS:
        walk = work / f"walk{seed}"
        if not walk.exists():
            subprocess.run([program, "synth", "--quiet", "--out", str(walk), "--seed", str(seed),
                            "--walk", str(WALK_FRAMES)], check=True)
        parts.append(table(program, work, f"walk{seed}", f"Synthetic walk {seed}",
                           walk / "dataset.json", walk / "sensors.csv",
                           ["sensors.declination_deg=4"]))
    if (munich / "dataset.json").exists():
        parts.append(table(program, work, "munich", "Munich, real photos (truth for every second)",
                           munich / "dataset.json", munich / "sensors.csv",
                           ["sensors.heading_reference=grid",
                            "sensors.roll_sense=counterclockwise"]))
    page = root / "docs/skyline.md"
    begin, end = "<!-- skyline tables: begin -->", "<!-- skyline tables: end -->"
    before, rest = page.read_text().split(begin)
    after = rest.split(end)[1]
    page.write_text(before + begin + "\n" + "\n\n".join(parts) + "\n" + end + after)


if __name__ == "__main__":
    main()
