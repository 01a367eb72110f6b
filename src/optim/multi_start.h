// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "optim/batch_search.h"
#include "optim/sampler_options.h"

namespace ridgeline {

// Local descents from the best of ever more evenly spread points; after multi-level single linkage
// (Rinnooy Kan and Timmer 1987), with a downhill simplex. Each round adds Sobol points and starts
// simplices from the best points that are apart from each other and from earlier starts. The
// distance that counts as apart, which is also the simplex's first edge, shrinks with the number of
// points as their spacing does. A descent that ends at the best point so far is polished with
// smaller simplices. Never ends.
SearchRoutine MultiStart(StrategyContext context, MultiStartOptions options);

}  // namespace ridgeline
