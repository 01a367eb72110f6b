// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "input/query_request.h"

namespace ridgeline {

// --dataset, --query, --model, --dtm, --crs and --camera.
void AddQueryOptions(CLI::App& command, QueryArguments& arguments);

}  // namespace ridgeline
