// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/kept_work.h"
#include "cli/run_outputs.h"
#include "eval/bench.h"
#include "eval/bench_task.h"
#include "eval/provenance.h"
#include "eval/shard.h"

namespace ridgeline {

// What `ridgeline bench` is asked for.
struct BenchArguments {
  std::string dataset;
  std::string out;
  std::string protocol;
  std::string world;
  std::string perturb;
  std::string score_only;
  std::string sensors;
  bool no_report = false;
  int seed = 1;
  int seeds = 1;
  RunOutputs outputs;
  KeptWork work;
  ConfigArguments config;
  std::string options_json;  // the resolved options in place of `config`; of results to go on with
};

LocalizerOptions OptionsOf(const BenchArguments& arguments);

// Reads the dataset, and chooses queries. Throws InputError for arguments that do not fit together.
BenchTask TaskOf(const BenchArguments& arguments,
                 const LocalizerOptions& options,
                 const Context& context);

// Seeds, shard and threads.
BenchOptions BenchOptionsOf(const BenchArguments& arguments, const Context& context);

// What the results of a task depend on.
Provenance ProvenanceOf(const BenchArguments& arguments,
                        const BenchTask& task,
                        const LocalizerOptions& options);

// The arguments that results were made with, with the whole's work: no shard, no outputs.
BenchArguments BenchArgumentsFrom(const Provenance& provenance);

// The command that makes the results again, without where they go.
std::string CommandOf(const BenchArguments& arguments);

// Makes what is not finished yet, and writes the results.
int RunBenchCommand(const BenchArguments& arguments, const Context& context);

}  // namespace ridgeline
