// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/bench_run.h"

namespace ridgeline {

// `ridgeline bench --score-only`: poses of another system in the same tables and pages. Their
// energies are those of our score at them, without a search; what our score cannot judge is blank,
// as is what other systems do not say: confidence, evaluations, time.
int RunScoreOnly(const BenchArguments& arguments, const Context& context);

}  // namespace ridgeline
