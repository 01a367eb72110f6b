#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Learns the outcome models of the confidence (docs/confidence.md) from what `bench` writes.

    scripts/learn_confidence.py RUNS... [--judge RUNS...]

RUNS are evidence.csv files or folders that hold some, at any depth. The models are logistic
regressions with a small ridge (Newton's method); --judge names runs that nothing is learned from:
how the learned confidence does on them is printed, with exact binomial bounds. Needs Debian's
python3-numpy and python3-scipy.
"""

import argparse
import csv
import json
import pathlib

import numpy as np
from scipy.stats import beta

RIDGE = 0.3


def elsewhere(folder):
    summary = folder / "summary.json"
    return summary.is_file() and json.loads(summary.read_text())["protocol"] == "elsewhere"


def read(paths):
    rows = []
    for path in map(pathlib.Path, paths):
        files = [path] if path.is_file() else sorted(path.rglob("evidence.csv"))
        for file in files:
            with open(file, newline="") as text:
                for row in csv.DictReader(text):
                    # Searched in another place, no pose is right, and there is no error to write.
                    if not row["candidate_t_err_m"] and elsewhere(file.parent):
                        row.update(candidate_t_err_m="inf", candidate_r_err_deg="inf")
                    if row["candidate_t_err_m"]:
                        rows.append({"run": file.parent.name, **row})
    return rows


def features(rows):
    """As OutcomeModel::Probability (src/localize/confidence.cc)."""
    mass = np.clip([float(r["posterior_mass"]) for r in rows], 1e-3, 1 - 1e-3)
    explained = np.clip([float(r["explained"]) for r in rows], -0.5, 1.5)
    observed = np.clip([float(r["observed_nat"]) for r in rows], -5.0, 15.0)
    return np.stack([np.ones(len(rows)), np.log(mass / (1 - mass)), explained, observed], axis=1)


def outcomes(rows):
    t = np.array([float(r["candidate_t_err_m"]) for r in rows])
    a = np.array([float(r["candidate_r_err_deg"]) for r in rows])
    return (t <= 2) & (a <= 2), (t > 5) | (a > 5)


def fit(x, y):
    penalty = np.eye(x.shape[1]) * RIDGE
    penalty[0, 0] = 0
    b = np.zeros(x.shape[1])
    for _ in range(100):
        p = 1 / (1 + np.exp(-x @ b))
        step = np.linalg.solve((x.T * (p * (1 - p))) @ x + penalty + 1e-9 * np.eye(len(b)),
                               x.T @ (y - p) - penalty @ b)
        b = b + step
        if np.abs(step).max() < 1e-9:
            break
    return b


def upper_bound(wrong, count):
    """Clopper and Pearson, one-sided 95 %."""
    return 1.0 if wrong >= count else beta.ppf(0.95, wrong + 1, count - wrong)


def judge(rows, b_right):
    right, gross = outcomes(rows)
    p = 1 / (1 + np.exp(-features(rows) @ b_right))
    print(f"{'run':32} {'n':>5} {'right':>6} {'>=0.9':>6} {'wrong':>6} {'gross':>6} {'kept':>6} {'<0.15':>6}")
    for name in sorted({r["run"] for r in rows}) + ["all"]:
        here = np.array([name in ("all", r["run"]) for r in rows])
        sure = here & (p >= 0.9)
        kept = (sure & right).sum() / max(1, (here & right).sum())
        print(f"{name:32} {here.sum():5} {(here & right).sum():6} {sure.sum():6} "
              f"{(sure & ~right).sum():6} {(sure & gross).sum():6} {kept:6.2f} {(here & (p < 0.15)).sum():6}")
    for least in (0.5, 0.9, 0.99):
        sure = p >= least
        wrong = int((sure & ~right).sum())
        print(f"confidence >= {least}: {wrong} of {sure.sum()} wrong, "
              f"at most {100 * upper_bound(wrong, int(sure.sum())):.2f} % (95 %)")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("runs", nargs="+")
    parser.add_argument("--judge", nargs="+", default=[])
    arguments = parser.parse_args()
    rows = read(arguments.runs)
    x = features(rows)
    models = [("right", fit(x, outcomes(rows)[0])), ("gross", fit(x, outcomes(rows)[1]))]
    for name, b in models:
        print(name, dict(zip(["offset", "mass", "explained", "observed"], np.round(b, 3).tolist())))
    print(f"\nlearned from {len(rows)} runs:")
    judge(rows, models[0][1])
    if arguments.judge:
        print("\njudged on:")
        judge(read(arguments.judge), models[0][1])


if __name__ == "__main__":
    main()
