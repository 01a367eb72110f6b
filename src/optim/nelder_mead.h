// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "optim/batch_search.h"
#include "optim/sampler_options.h"

namespace ridgeline {

// Downhill simplex (Nelder and Mead 1965) with the strategy of Ayadi et al. 6.1.2: the variables
// change along the way (options.groups), each has its own step (a fraction of its range), and the
// steps decrease; for each, the simplex restarts from the last solution and runs to convergence.
// After the last step the whole begins again at a random point. It starts at context.start, or in
// the middle of the box.
SearchRoutine NelderMead(StrategyContext context, NelderMeadOptions options);

}  // namespace ridgeline
