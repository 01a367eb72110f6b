#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Learns the outcome models of the confidence (docs/confidence.md) from what `bench` writes.

    scripts/learn_confidence.py RUNS... [--half RUNS...] [--judge RUNS...] [--from OPTIONS.json]

RUNS are evidence.csv files or folders that hold some, at any depth. The models are a logistic
function of the evidence times a power of the posterior mass. Runs of --half count half; --judge
names runs that nothing is learned from: how the learned confidence does on them is printed, with
exact binomial bounds. --from takes weights that were learned from other runs (`ridgeline options`):
the new ones stay near them where the RUNS are few. Needs Debian's python3-numpy and python3-scipy.
"""

import argparse
import csv
import json
import pathlib

import numpy as np
from scipy.optimize import minimize
from scipy.stats import beta

RIDGE = 0.02
NAMES = ["offset", "explained", "above_background", "information", "mass_power"]
# How far weights learned from a few hundred runs may be off: one standard deviation (of the power:
# of its logarithm).
SPREAD = np.array([1.5, 1.0, 1.0, 0.1, 0.25])
# As in src/localize/confidence.cc.
INFORMATION_NAT = 15.0
LEAST_INFORMATION_NAT = 5.0
UNKNOWN_SHARE = 0.6


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
    """As OutcomeModel::Probability (src/localize/confidence.cc): the columns of the logistic part,
    and the posterior mass."""
    explained = np.clip([float(r["explained"]) for r in rows], -0.5, 1.5)
    mass = np.clip([float(r["posterior_mass"]) for r in rows], 1e-6, 1.0)
    information = np.array([float(r["information_nat"]) for r in rows])
    tellable = np.maximum(information, LEAST_INFORMATION_NAT)
    share = [float(r["above_background_nat"]) / most if r["above_background_nat"] else UNKNOWN_SHARE
             for r, most in zip(rows, tellable)]
    background = np.clip(np.minimum(share, [float(r["explained"]) for r in rows]), -0.5, 1.2)
    missing = np.minimum(0.0, information - INFORMATION_NAT)
    return np.stack([np.ones(len(rows)), explained, background, missing], axis=1), mass


def outcomes(rows):
    """Within 2 m and 2 degrees; within 5 m and 5 degrees."""
    t = np.array([float(r["candidate_t_err_m"]) for r in rows])
    a = np.array([float(r["candidate_r_err_deg"]) for r in rows])
    return (t <= 2) & (a <= 2), (t <= 5) & (a <= 5)


def probability(b, x, mass):
    """b: offset, explained, above_background, information, log of mass_power."""
    return mass ** np.exp(b[4]) / (1 + np.exp(-np.clip(x @ b[:4], -30, 30)))


def fit(x, mass, y, count, earlier=None):
    """Highest likelihood with a small ridge, the power drawn to 1; or near earlier weights. `count`:
    how often each run is counted."""
    def loss(b):
        p = np.clip(probability(b, x, mass), 1e-6, 1 - 1e-6)
        likelihood = (count * (y * np.log(p) + (1 - y) * np.log(1 - p))).sum()
        if earlier is not None:
            return -likelihood + 0.5 * (((b - earlier) / SPREAD) ** 2).sum()
        return -likelihood + RIDGE * (b[1:4] ** 2).sum() + 0.5 * b[4] ** 2
    starts = [np.array([offset, 1.0, 0.1, 0.1, 0.0]) for offset in (-4.0, -2.0, 0.0)]
    starts = starts if earlier is None else [earlier]
    return min((minimize(loss, start, method="BFGS") for start in starts), key=lambda r: r.fun).x


def earlier_weights(path, name):
    """Of an outcome, from the program's options; None without a file."""
    if path is None:
        return None
    weights = json.loads(pathlib.Path(path).read_text())["confidence"][name]
    return np.array([*(weights[key] for key in NAMES[:4]), np.log(weights["mass_power"])])


def upper_bound(wrong, count):
    """Clopper and Pearson, one-sided 95 %."""
    return 1.0 if wrong >= count else beta.ppf(0.95, wrong + 1, count - wrong)


def judge(rows, b_right):
    right, near = outcomes(rows)
    gross = ~near
    p = probability(b_right, *features(rows))
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
    parser.add_argument("--half", nargs="+", default=[])
    parser.add_argument("--judge", nargs="+", default=[])
    parser.add_argument("--from", dest="earlier", metavar="OPTIONS.json")
    arguments = parser.parse_args()
    whole, half = read(arguments.runs), read(arguments.half)
    rows = whole + half
    count = np.array([1.0] * len(whole) + [0.5] * len(half))
    models = [(name, fit(*features(rows), outcome, count, earlier_weights(arguments.earlier, name)))
              for name, outcome in zip(["right", "near"], outcomes(rows))]
    for name, b in models:
        print(name, dict(zip(NAMES, np.round([*b[:4], np.exp(b[4])], 3).tolist())))
    print(f"\nlearned from {len(rows)} runs:")
    judge(rows, models[0][1])
    if arguments.judge:
        print("\njudged on:")
        judge(read(arguments.judge), models[0][1])


if __name__ == "__main__":
    main()
