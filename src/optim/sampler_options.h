// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/option_groups.h"
#include "base/options.h"

namespace ridgeline {

// Which sampler, and how it is set. Each sampler reads its own group only; gp_de those of gp and
// de, too.
struct SamplerOptions {
  // One of SamplerNames(), see sampler_table.h. The default won most often on recorded landscapes
  // after any number of evaluations, see docs/samplers.md.
  std::string name = "gp_de";
  // Those of all samplers in the table, e.g. groups.Get<TpeOptions>().
  OptionGroups groups;

  SamplerOptions();
  void Visit(OptionVisitor& v);
};

}  // namespace ridgeline
