// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "optim/batch_search.h"
#include "optim/sampler_options.h"

namespace ridgeline {

// CMA-ES (Hansen and Ostermeier 2001) by pagmo2, with restarts of doubled population (Auger and
// Hansen 2005) when it has converged. Starts around context.start, or at the best of a random
// population. Coordinates outside of the cube are folded into it, see FoldIntoCube().
SearchRoutine CmaEs(StrategyContext context, CmaEsOptions options);

// Differential evolution (Storn and Price 1997) by pagmo2. The first population is the best of some
// Sobol points and context.start; when the population has converged another one begins.
SearchRoutine DifferentialEvolution(StrategyContext context, DifferentialEvolutionOptions options);

}  // namespace ridgeline
