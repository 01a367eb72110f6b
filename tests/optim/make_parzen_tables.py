#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes parzen_tables.h: log densities of Optuna 3.1.0's Parzen estimators by SciPy.

Weights, centres and deviations are Optuna's. The densities are SciPy's, because truncnorm.logpdf of
Optuna 3.1.0 forgets the division by the deviation; with that put right (below) both agree.

Run with Debian's python3-optuna and python3-scipy:
  /usr/bin/python3 make_parzen_tables.py > parzen_tables.h
"""
import numpy as np
import optuna
import scipy
from optuna.distributions import FloatDistribution
from optuna.samplers._tpe import _truncnorm
from optuna.samplers._tpe.parzen_estimator import _ParzenEstimator, _ParzenEstimatorParameters
from optuna.samplers._tpe.sampler import default_weights
from scipy.stats import truncnorm

_logpdf = _truncnorm.logpdf


def _corrected_logpdf(x, a, b, loc=0, scale=1):
    return _logpdf(x, a, b, loc, scale) - np.log(scale)


_truncnorm.logpdf = _corrected_logpdf


def estimator(points, multivariate, prior_weight, magic_clip, endpoints):
    names = [f"x{d}" for d in range(points.shape[1])]
    parameters = _ParzenEstimatorParameters(
        True, prior_weight, magic_clip, endpoints, default_weights, multivariate)
    return names, _ParzenEstimator({n: points[:, d] for d, n in enumerate(names)},
                                   {n: FloatDistribution(0.0, 1.0) for n in names}, parameters)


def scipy_log_density(pe, names, queries):
    density = np.zeros(len(queries))
    for k, weight in enumerate(pe._weights):
        product = np.full(len(queries), weight)
        for d, n in enumerate(names):
            mu, sigma = pe._mus[n][k], pe._sigmas[n][k]
            product *= truncnorm.pdf(queries[:, d], -mu / sigma, (1 - mu) / sigma, mu, sigma)
        density += product
    return np.log(density)


def table(values):
    return "{" + ", ".join(repr(float(v)) for v in np.ravel(values)) + "}"


def main():
    print("// SPDX-License-Identifier: Apache-2.0")
    print(f"// Made by make_parzen_tables.py: Optuna {optuna.__version__}, SciPy {scipy.__version__}.")
    print("#pragma once\n\n#include <vector>\n\n// clang-format off")
    print("struct ParzenCase {\n  int dimensions;\n  bool multivariate;\n  double prior_weight;")
    print("  bool magic_clip;\n  bool endpoints;\n  std::vector<double> points;  // row by row")
    print("  std::vector<double> queries;\n  std::vector<double> log_densities;")
    print("  std::vector<double> undivided;  // by the deviations, as Optuna 3.1.0 has it\n};\n")
    print("inline const std::vector<ParzenCase> kParzenCases = {")
    rng = np.random.RandomState(7)
    cases = [(0, 1, False, 1.0, True, False), (1, 1, False, 1.0, True, False),
             (5, 1, False, 1.0, True, False), (5, 1, False, 1.0, False, False),
             (5, 1, False, 0.5, True, True), (40, 1, False, 1.0, True, False),
             (120, 1, False, 1.0, True, False), (0, 2, True, 1.0, True, False),
             (3, 2, True, 1.0, True, False), (30, 3, True, 2.0, True, False),
             (60, 6, True, 1.0, True, False)]
    for n, dims, multivariate, prior, clip, endpoints in cases:
        points = np.round(rng.beta(0.7, 0.9, size=(n, dims)), 6)
        queries = np.round(rng.uniform(size=(6, dims)), 6)
        queries[0], queries[1] = 0.0, 1.0
        names, pe = estimator(points, multivariate, prior, clip, endpoints)
        values = scipy_log_density(pe, names, queries)
        optunas = pe.log_pdf({m: queries[:, d] for d, m in enumerate(names)})
        assert np.allclose(values, optunas, rtol=0, atol=1e-9)
        _truncnorm.logpdf = _logpdf
        undivided = pe.log_pdf({m: queries[:, d] for d, m in enumerate(names)})
        _truncnorm.logpdf = _corrected_logpdf
        flags = [str(b).lower() for b in (multivariate, clip, endpoints)]
        print(f"    {{{dims}, {flags[0]}, {prior}, {flags[1]}, {flags[2]},")
        print(f"     {table(points)},\n     {table(queries)},\n     {table(values)},\n     {table(undivided)}}},")
    print("};\n// clang-format on")


if __name__ == "__main__":
    main()
