#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the accuracy table of BENCHMARK.md, between its markers, from the results of benchmark.sh."""
import json
import pathlib
import platform
import subprocess
import sys

ROWS = [
    ("munich", "Munich, real photos", "`--perturb 10,10,0,20`"),
    ("street", "Ingolstadt rendered, street", "`--perturb 10,10,0,20`"),
    ("tilted", "Ingolstadt rendered, tilted, 6 free", "`--perturb 10,10,0.5,20,5,5`"),
    ("drone", "Ingolstadt rendered, drone, 6 free",
     "`--perturb 10,10,10,15,5,5 --config configs/drone.json`"),
    ("street_wide", "street, wide prior", "`--perturb 40,40,0,180`"),
    ("munich_sensors", "Munich, the dataset's own priors (tilt off by up to 7°)", "none"),
    ("street_sensors", "street, the dataset's own priors", "none"),
    ("tilted_sensors", "tilted, the dataset's own priors", "none"),
    ("munich_skyline", "Munich, skyline L1 only", "`--perturb 10,10,0,20 --config configs/skyline.json`"),
    ("street_skyline", "street, skyline L1 only", "`--perturb 10,10,0,20 --config configs/skyline.json`"),
    ("munich_paper", "Munich, the published method", "`--perturb 10,10,0,20 --config configs/paper.json`"),
    ("street_paper", "street, the published method", "`--perturb 10,10,0,20 --config configs/paper.json`"),
]
BEGIN, END = "<!-- benchmark: begin -->", "<!-- benchmark: end -->"


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def recall(summary, key):
    low, high = summary["recall_ci95"][key]
    return f"{100 * summary['recall'][key]:.1f} % ({100 * low:.0f}–{100 * high:.0f})"


def row(summary, name, arguments):
    confident = summary.get("confidence_0.9") or {}
    coverage = summary.get("coverage_95") or {}
    right = confident.get("recall_2m_2deg")
    ellipse = coverage.get("position_ellipse")
    heading = coverage.get("heading_interval")
    percent = lambda x: "–" if x is None else f"{100 * x:.0f} %"
    return " | ".join([
        f"| {name}",
        arguments,
        f"{summary['runs_with_truth']}",
        recall(summary, "2m_2deg"), recall(summary, "5m_5deg"), recall(summary, "9m_10deg"),
        f"{summary['translation_error_m']['median']:.2f} m, "
        f"{summary['rotation_error_deg']['median']:.2f}°",
        f"{percent(right)} of {percent(confident.get('share'))}",
        f"{percent(ellipse)}, {percent(heading)}",
        percent(summary["abstained"]),
        f"{summary['seconds_per_query']['median']:.2f}",
        f"{summary['pose_evaluations_per_second']:.0f} |",
    ])


def main():
    results, page = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    lines = [
        f"Commit {commit.stdout.strip() or 'unknown'}, {processor()}.", "",
        "| set | prior | runs | 2 m, 2° | 5 m, 5° | 9 m, 10° | median error | "
        "right (2 m, 2°) where confidence ≥ 0.9 | truth in the 95 % ellipse, heading interval | "
        "abstained | s per picture | poses/s |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
        "| Loeper et al., their own photos | | 26–30 | 3.9 % | 23.1 % | 34.6 % | – | – | – | – | – | – |",
    ]
    for folder, name, arguments in ROWS:
        path = results / folder / "summary.json"
        if path.exists():
            lines.append(row(json.loads(path.read_text()), name, arguments))
    text = page.read_text()
    before, rest = text.split(BEGIN, 1)
    page.write_text(before + BEGIN + "\n" + "\n".join(lines) + "\n" + END + rest.split(END, 1)[1])


if __name__ == "__main__":
    main()
