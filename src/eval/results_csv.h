// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "eval/metrics.h"

namespace ridgeline {

// The runs of a results.csv as ResultsCsv() writes it. What is blank there is NaN here, or absent;
// whether a query has a truth is known only where an error is given. Throws InputError naming the
// line.
std::vector<RunRecord> ReadResultsCsv(const std::filesystem::path& path);

}  // namespace ridgeline
