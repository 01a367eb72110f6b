// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/options.h"
#include "optim/batch_search.h"

namespace ridgeline {

// CMA-ES.
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

// Differential evolution.
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

// CMA-ES (Hansen and Ostermeier 2001) by pagmo2, with restarts of doubled population (Auger and
// Hansen 2005) when it has converged. Starts around context.start, or at the best of a random
// population. Coordinates outside of the cube are folded into it, see FoldIntoCube().
SearchRoutine CmaEs(StrategyContext context, CmaEsOptions options);

// Differential evolution (Storn and Price 1997) by pagmo2. The first population is the best of some
// Sobol points and context.start; when the population has converged another one begins.
SearchRoutine DifferentialEvolution(StrategyContext context, DifferentialEvolutionOptions options);

}  // namespace ridgeline
