// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace ridgeline {

// sum of weights[i] * exp(-squares[i] / 2), squares >= 0; relative error below 1e-13. Terms beyond
// exp(-700) count as exp(-700). The order of the sum is fixed; on processors with AVX2 the last
// bits differ, as those of the C library do.
double KernelSum(const double* squares, const double* weights, std::size_t count);

}  // namespace ridgeline
