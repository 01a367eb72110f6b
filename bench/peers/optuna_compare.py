#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Compares ridgeline's TPE with Optuna's on six functions: best value after 50, 100, 200 trials.

  /usr/bin/python3 optuna_compare.py --program build/bench/optim_quality --seeds 100 \
      --cache optuna_runs.csv --document docs/samplers.md

Needs Debian's python3-optuna (3.1.0) and python3-scipy. Optuna's runs are slow: they are appended to
the cache one by one, and an interrupted comparison goes on from there. Runs of the first TIMED_SEEDS
seeds are timed as Optuna is installed; in the others SciPy's log_ndtr and ndtri_exp stand in for
Optuna's own loops in Python, which give the same numbers, so that a hundred seeds take minutes. The table replaces the text between the
markers of the document; without --document it goes to stdout.

"corrected" is Optuna with its truncated normal density divided by the deviation, as Optuna does
since 3.5 (issue 5109) and ridgeline by default; ridgeline runs with the same.

Optuna seeds the generator of its startup trials and that of its densities alike, so that the first
draws from the densities repeat the startup trials' numbers. Here the startup trials have a seed of
their own, as random numbers should; "one_seed" is Optuna as it seeds itself.
"""
import argparse
import csv
import os
import subprocess
import sys
import time
import warnings

import numpy as np
import optuna
from optuna.samplers._tpe import _truncnorm
from scipy import special

TRIALS = 200
CHECKPOINTS = (50, 100, 200)
HEADER = ["sampler", "function", "seed", "best50", "best100", "best200", "ms_per_trial"]
BEGIN, END = "<!-- optuna_compare: begin -->", "<!-- optuna_compare: end -->"
UNDIVIDED = ":tpe.divide_by_deviation=false"
VARIANTS = {  # of Optuna: what ridgeline calls the same
    "tpe": "tpe" + UNDIVIDED,
    "tpe_corrected": "tpe",
    "multivariate": "tpe_multivariate" + UNDIVIDED,
    "multivariate_corrected": "tpe_multivariate",
    "tpe_one_seed": "tpe" + UNDIVIDED,
}
# Added to the seed of Optuna's startup trials.
OTHER_SEED = 1000000
TIMED_SEEDS = 2
FAULTY_LOGPDF = _truncnorm.logpdf
SLOW = {name: getattr(_truncnorm, name) for name in ("_ndtr", "_log_ndtr", "_ndtri_exp")}
FAST = {"_ndtr": special.ndtr, "_log_ndtr": special.log_ndtr, "_ndtri_exp": special.ndtri_exp}


def hartmann6(x):
    alpha = np.array([1.0, 1.2, 3.0, 3.2])
    a = np.array([[10, 3, 17, 3.5, 1.7, 8], [0.05, 10, 17, 0.1, 8, 14],
                  [3, 3.5, 1.7, 10, 17, 8], [17, 8, 0.05, 10, 0.1, 14]])
    p = np.array([[0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886],
                  [0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991],
                  [0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650],
                  [0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381]])
    return -float(alpha @ np.exp(-np.sum(a * (x - p) ** 2, axis=1)))


def branin(u):
    x, y = 15.0 * u[0] - 5.0, 15.0 * u[1]
    a = y - 5.1 / (4 * np.pi**2) * x**2 + 5 / np.pi * x - 6
    return a * a + 10 * (1 - 1 / (8 * np.pi)) * np.cos(x) + 10


def hole(x):
    square = np.sum((x - np.array([0.62, 0.27, 0.71])) ** 2) / 0.06**2
    return 1 - 0.7 * np.exp(-0.5 * square) + 0.02 * np.sum(np.sin(25 * x + np.arange(3)))


FUNCTIONS = {  # dimensions, lower, upper, energy
    "sphere": (3, -5.0, 5.0, lambda x: np.sum((x - 1) ** 2)),
    "rosenbrock": (3, -2.0, 2.0,
                   lambda x: np.sum(100 * (x[1:] - x[:-1] ** 2) ** 2 + (1 - x[:-1]) ** 2)),
    "rastrigin": (3, -5.12, 5.12, lambda x: np.sum(x**2 + 10 * (1 - np.cos(2 * np.pi * x)))),
    "branin": (2, 0.0, 1.0, branin),
    "hartmann6": (6, 0.0, 1.0, hartmann6),
    "hole": (3, 0.0, 1.0, hole),
}


def run_optuna(variant, name, seed):
    timed = seed < TIMED_SEEDS
    for function, implementation in (SLOW if timed else FAST).items():
        setattr(_truncnorm, function, implementation)
    _truncnorm.logpdf = FAULTY_LOGPDF
    if "corrected" in variant:
        _truncnorm.logpdf = lambda x, a, b, loc=0, scale=1: (
            FAULTY_LOGPDF(x, a, b, loc, scale) - np.log(scale))
    dims, low, high, energy = FUNCTIONS[name]
    sampler = optuna.samplers.TPESampler(seed=seed, multivariate=variant.startswith("multi"))
    if not variant.endswith("one_seed"):
        sampler._random_sampler = optuna.samplers.RandomSampler(seed=seed + OTHER_SEED)
    study = optuna.create_study(sampler=sampler)
    begin = time.process_time()
    study.optimize(lambda t: float(energy(np.array(
        [t.suggest_float(f"x{d}", low, high) for d in range(dims)]))), n_trials=TRIALS)
    ms = 1e3 * (time.process_time() - begin) / TRIALS if timed else float("nan")
    best = np.minimum.accumulate([t.value for t in study.trials])
    return [variant, name, seed] + [float(best[n - 1]) for n in CHECKPOINTS] + [ms]


def cached_runs(path, variants, seeds):
    rows = []
    if os.path.exists(path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))[1:]
    done = {(r[0], r[1], int(r[2])) for r in rows}
    with open(path, "a", newline="") as file:
        writer = csv.writer(file)
        if not rows:
            writer.writerow(HEADER)
        for seed in range(seeds):
            for variant in variants:
                for name in FUNCTIONS:
                    if (variant, name, seed) not in done:
                        row = run_optuna(variant, name, seed)
                        rows.append([str(v) for v in row])
                        writer.writerow(row)
                        file.flush()
    return rows


def collect(rows, sampler, name, seeds):
    picked = [r for r in rows if r[0] == sampler and r[1] == name and int(r[2]) < seeds]
    picked.sort(key=lambda r: int(r[2]))
    return np.array([[float(v) for v in r[3:]] for r in picked])


def interval(values, rng):
    medians = np.median(rng.choice(values, size=(4000, len(values))), axis=1)
    return np.percentile(medians, [2.5, 97.5])


def compare(ours, theirs, variants, seeds):
    rng = np.random.RandomState(0)
    lines = [f"Optuna {optuna.__version__}, {seeds} seeds, median of the best value [95 % bootstrap"
             " interval of the median].", "",
             "| function | trials | Optuna's sampler | Optuna | ridgeline | verdict |",
             "|---|---|---|---|---|---|"]
    for variant in variants:
        for name in FUNCTIONS:
            a = collect(theirs, variant, name, seeds)
            b = collect(ours, VARIANTS[variant], name, seeds)
            for k, n in enumerate(CHECKPOINTS):
                (la, ha), (lb, hb) = interval(a[:, k], rng), interval(b[:, k], rng)
                ma, mb = np.median(a[:, k]), np.median(b[:, k])
                if mb < la and hb < ma:
                    verdict = "better"
                elif mb <= ha or lb <= ma:
                    verdict = "equal"
                else:
                    verdict = "worse"
                lines.append(f"| {name} | {n} | {variant} | {ma:.4g} [{la:.4g}, {ha:.4g}] "
                             f"| {mb:.4g} [{lb:.4g}, {hb:.4g}] | {verdict} |")
    lines += ["", "CPU time per trial over 200 trials [ms], mean over seeds, on the same machine:", "",
              "| function (dimensions) | Optuna's sampler | Optuna | ridgeline | ratio |",
              "|---|---|---|---|---|"]
    for variant in variants:
        for name, (dims, *_) in FUNCTIONS.items():
            a = collect(theirs, variant, name, seeds)[:TIMED_SEEDS, 3].mean()
            b = collect(ours, VARIANTS[variant], name, seeds)[:, 3].mean()
            lines.append(f"| {name} ({dims}) | {variant} | {a:.2f} | {b:.4f} | {a / b:.0f} |")
    return "\n".join(lines) + "\n"


def write_document(path, table):
    with open(path) as file:
        text = file.read()
    if BEGIN not in text or END not in text:
        sys.exit(f"{path}: got no markers, expected {BEGIN} and {END}")
    head, rest = text.split(BEGIN)
    with open(path, "w") as file:
        file.write(head + BEGIN + "\n" + table + END + rest.split(END)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="the built optim_quality")
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--cache", default="optuna_runs.csv")
    parser.add_argument("--variants", nargs="+", default=list(VARIANTS), choices=list(VARIANTS))
    parser.add_argument("--document", help="Markdown file whose marked part is replaced")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    theirs = cached_runs(args.cache, args.variants, args.seeds)
    samplers = list(dict.fromkeys(VARIANTS[v] for v in args.variants))
    output = subprocess.run([args.program, str(args.seeds)] + samplers, check=True,
                            capture_output=True, text=True).stdout
    ours = [line.split(",") for line in output.splitlines()[1:]]
    table = compare(ours, theirs, args.variants, args.seeds)
    if args.document:
        write_document(args.document, table)
    else:
        print(table)


if __name__ == "__main__":
    main()
