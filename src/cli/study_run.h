// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/kept_work.h"
#include "eval/provenance.h"

namespace ridgeline {

// What `ridgeline study` is asked for.
struct StudyArguments {
  std::string dataset;
  std::string out;
  std::string report;
  std::vector<std::string> scores;
  std::vector<std::string> vary;
  std::vector<int> classes = {50, 100, 200};
  std::string protocol;
  std::string perturb;
  std::uint64_t seed = 1;
  bool explore = false;
  KeptWork work;
  ConfigArguments config;
  std::string options_json;  // the resolved options in place of `config`; of results to go on with
};

// Makes what is not finished yet, and writes the results.
int RunStudyCommand(const StudyArguments& arguments, const Context& context);

// The arguments that results were made with, with the whole's work: no shard, no outputs.
StudyArguments StudyArgumentsFrom(const Provenance& provenance);

}  // namespace ridgeline
