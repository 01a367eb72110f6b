// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/options.h"

namespace ridgeline {

// Tree-structured Parzen estimator; the defaults are those of Optuna 3.1 (see tpe.h).
struct TpeOptions {
  // Uniform random trials before the densities are used, >= 1.
  int startup_trials = 10;
  // Draws from the density of the good trials, of which the best ratio is proposed, >= 1.
  int candidates = 24;
  // The good trials are the best min(ceil(good_fraction * n), good_max), at least one.
  double good_fraction = 0.1;
  int good_max = 25;
  // Weight of the prior kernel beside 1 per trial, > 0.
  double prior_weight = 1.0;
  // Lower limit of bandwidths: range / min(100, 1 + number of kernels).
  bool magic_clip = true;
  // Univariate rule: outermost kernels reach to the bounds.
  bool consider_endpoints = false;
  // Kernels are divided by their deviation, as in Optuna since 3.5. Undivided, as in 3.1, the
  // search does better on smooth functions and as well on recorded landscapes, see
  // docs/samplers.md.
  bool divide_by_deviation = false;

  void Visit(OptionVisitor& v);
};

// Gaussian-process Bayesian optimization (see gp_strategy.h).
struct GpOptions {
  // Sobol points before the model is used, >= 2.
  int startup_trials = 10;
  // Trials the model holds at most, >= 20: the better half are the best ones, the rest the latest.
  int max_points = 500;
  // The hyper-parameters are estimated anew when the number of trials has grown by this fraction.
  double refit_growth = 0.1;
  // Points that the expected improvement is looked at before its best ones are climbed from.
  int candidates = 192;
  int climbs = 4;

  void Visit(OptionVisitor& v);
};

// CMA-ES (see population.h).
struct CmaEsOptions {
  // Points per generation; 0: 4 + 3 ln(dimensions). Five at least.
  int population = 0;
  // First deviation as a fraction of the ranges.
  double sigma = 0.25;
  // Restart when the energies, or the coordinates (fractions of the ranges), differ by less.
  double ftol = 1e-11;
  double xtol = 1e-5;

  void Visit(OptionVisitor& v);
};

// Differential evolution (see population.h).
struct DifferentialEvolutionOptions {
  // 0: 10 + 2 * dimensions. Five at least.
  int population = 0;
  double weight = 0.8;
  double crossover = 0.9;
  // Sobol points of which the best make the first population, if more than that has.
  int first_points = 40;
  // pagmo's number of the strategy, 1 ... 10; 7 is rand/1/bin.
  int variant = 7;
  // Restart when the energies, or the coordinates (fractions of the ranges), of a generation differ
  // by less.
  double ftol = 1e-11;
  double xtol = 1e-3;

  void Visit(OptionVisitor& v);
};

// Gaussian process first, then differential evolution, with the options of both (see gp_de.h).
struct GpDeOptions {
  // Trials of the Gaussian process, >= 1.
  int gp_trials = 200;

  void Visit(OptionVisitor& v);
};

// Downhill simplex (see nelder_mead.h).
struct NelderMeadOptions {
  // Edges of the successive first simplices as fractions of the ranges, in (0, 1).
  std::vector<double> steps = {0.25, 0.1, 0.04, 0.015, 0.005};
  // Parameters that vary together, in turn, for each step: names with commas, or "*" for all.
  std::vector<std::string> groups = {"*"};
  // A simplex has converged when its extent is below this fraction of its first edge.
  double convergence = 0.1;

  void Visit(OptionVisitor& v);
};

// Dense coarse to fine (see grid_search.h).
struct GridOptions {
  // The coarse grid has at most this many points, and two per axis at least.
  int coarse_points = 1000;
  // Places refined after the coarse grid; half as many on each finer one.
  int keep = 8;
  // Ends when the spacing is below this fraction of the ranges.
  double finest = 1e-4;

  void Visit(OptionVisitor& v);
};

// Sobol points and downhill simplices in turn (see multi_start.h).
struct MultiStartOptions {
  // Sobol points of the first round, >= 4; each further round has `growth` (>= 1) times as many.
  int first_points = 32;
  double growth = 1.5;
  // Simplices started per round, >= 1.
  int descents = 4;

  void Visit(OptionVisitor& v);
};

// Which sampler, and how it is set. Each sampler reads its own group only; gp_de those of gp and
// de, too.
struct SamplerOptions {
  // One of SamplerNames(). The default won most often on recorded landscapes after any number of
  // evaluations, see docs/samplers.md.
  std::string name = "gp_de";
  TpeOptions tpe;
  GpOptions gp;
  CmaEsOptions cmaes;
  DifferentialEvolutionOptions de;
  GpDeOptions gp_de;
  NelderMeadOptions nelder_mead;
  GridOptions grid;
  MultiStartOptions multi_start;

  void Visit(OptionVisitor& v);
  // Throws InputError naming the field, e.g. "sampler.tpe.candidates".
  void Validate() const;
};

// Names that SamplerOptions::name accepts.
const std::vector<std::string>& SamplerNames();

}  // namespace ridgeline
