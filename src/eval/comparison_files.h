// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "eval/comparison.h"

namespace ridgeline {

// What `ridgeline compare --out` writes; each comparison is of the first system with another. What
// is not known is a blank, or null.

// One row per comparison and figure.
std::string ComparisonCsv(std::span<const Comparison> comparisons);
// One row per comparison, query and seed.
std::string PairsCsv(std::span<const Comparison> comparisons);
std::string ComparisonJson(std::span<const Comparison> comparisons);
// For people.
std::string ComparisonText(const Comparison& comparison);

}  // namespace ridgeline
