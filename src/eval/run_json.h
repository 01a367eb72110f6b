// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "eval/bench.h"

namespace ridgeline {

// A finished run as JSON on one line, to the last bit: what is read back stands for the run in
// every table and picture.
std::string RunText(const BenchRun& run);

// @param query  The run's.
// @param index  Of the query in its dataset.
// Throws InputError, naming `file`, for text that is no run.
BenchRun ReadRun(const std::string& text,
                 const Query& query,
                 std::size_t index,
                 const std::string& file);

// The same text without its times.
std::string WithoutTimes(const std::string& run_text);

}  // namespace ridgeline
