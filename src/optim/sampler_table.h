// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "optim/sampler_plugin.h"

namespace ridgeline {

// All samplers. Valid until the next AddSampler().
std::span<const SamplerPlugin* const> SamplerTable();

// Adds a sampler of a program of its own to the table (examples/custom_sampler.cc): at the
// program's start, before any options are made, which hold what the samplers declare. `plugin` must
// outlive the program's work. Throws InputError for a name that the table has.
void AddSampler(const SamplerPlugin& plugin);

// Names that SamplerOptions::name accepts, in the order of the table.
std::vector<std::string> SamplerNames();

// Throws InputError for a name that no sampler of the table has.
const SamplerPlugin& FindSampler(const std::string& name);

}  // namespace ridgeline
