// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "base/option_groups.h"
#include "optim/strategy.h"

namespace ridgeline {

// How a sampler joins the table (sampler_table.cc). It is documented beside its strategy, with its
// source.
struct SamplerPlugin {
  const char* name;                // what SamplerOptions::name calls it
  void (*declare)(OptionGroups&);  // adds its options
  // Whether it begins at StrategyContext::start by itself; else that point is proposed before its
  // own.
  bool begins_at_start = false;
  std::unique_ptr<Strategy> (*make)(const StrategyContext&, const OptionGroups&);
};

}  // namespace ridgeline
