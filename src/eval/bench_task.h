// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "eval/bench_queries.h"
#include "input/dataset.h"
#include "input/world.h"
#include "localize/localizer_options.h"

namespace ridgeline {

// What a benchmark is asked for, in the words of `ridgeline bench`.
struct BenchRequest {
  std::string dataset;   // dataset.json
  std::string protocol;  // of FindProtocol(); empty: the dataset's own priors
  std::string world;     // dataset.json of the place searched, for the protocol "elsewhere"
  std::string perturb;   // of PerturbedProtocol(), in place of a protocol
};

// The queries as the search gets them, and the dataset whose model is searched.
struct BenchTask {
  BenchQueries queries;
  Dataset searched;
  std::size_t asked = 0;  // queries that took a camera or a prior from their picture
};

// Reads what is asked for. Throws InputError naming the option of `ridgeline bench`.
BenchTask ReadBenchTask(const BenchRequest& request, const LocalizerOptions& options);

// The world that is searched, as far as it can be seen from the queries' places.
World ReadWorldOf(const BenchTask& task);

}  // namespace ridgeline
