#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the accuracy table of BENCHMARK.md, between its markers, from the results of benchmark.sh."""
import json
import pathlib
import platform
import subprocess
import sys

ROWS = [
    ("munich", "Munich, real photos", "`known-tilt`"),
    ("street", "Ingolstadt rendered, street", "`known-tilt`"),
    ("munich_phone", "Munich, real photos", "`phone`"),
    ("street_phone", "Ingolstadt rendered, street", "`phone`"),
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
# No right answer is in the search box: an answer with confidence is a failure.
WRONG_PLACES = [
    ("munich_outside", "Munich, box beside the truth", "`outside`"),
    ("street_outside", "street, box beside the truth", "`outside`"),
    ("munich_elsewhere", "Munich's photos in Ingolstadt", "`elsewhere`"),
    ("street_elsewhere", "street's pictures in Munich", "`elsewhere`"),
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


def wrong_place_row(summary, name, protocol):
    share = lambda s: (f"{100 * s['share']:.1f} % ({100 * s['ci95'][0]:.1f}–"
                       f"{100 * s['ci95'][1]:.1f})")
    abstained = {"share": summary["abstained"], "ci95": summary["abstained_ci95"]}
    found = summary.get("found_by_widening_2m_2deg")
    return " | ".join([
        f"| {name}", protocol, f"{summary['runs']}", share(summary["confidence_0.9"]["wrong"]),
        share(summary["doubtful"]), share(abstained),
        "– |" if found is None else f"{100 * found:.1f} % |"])


def main():
    results, page = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    lines = [
        f"Commit {commit.stdout.strip() or 'unknown'}, {processor()}.", "",
        "| set | protocol | runs | 2 m, 2° | 5 m, 5° | 9 m, 10° | median error | "
        "right (2 m, 2°) where confidence ≥ 0.9 | truth in the 95 % ellipse, heading interval | "
        "abstained | s per picture | poses/s |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
        "| Loeper et al., their own photos | | 26–30 | 3.9 % | 23.1 % | 34.6 % | – | – | – | – | – | – |",
    ]
    for folder, name, arguments in ROWS:
        path = results / folder / "summary.json"
        if path.exists():
            lines.append(row(json.loads(path.read_text()), name, arguments))
    lines += ["", "| set | protocol | runs | confident (≥ 0.9) and wrong | doubtful | abstained | "
              "found beyond the box (2 m, 2°) |", "|---|---|---|---|---|---|---|"]
    for folder, name, protocol in WRONG_PLACES:
        path = results / folder / "summary.json"
        if path.exists():
            lines.append(wrong_place_row(json.loads(path.read_text()), name, protocol))
    text = page.read_text()
    before, rest = text.split(BEGIN, 1)
    page.write_text(before + BEGIN + "\n" + "\n".join(lines) + "\n" + END + rest.split(END, 1)[1])


if __name__ == "__main__":
    main()
