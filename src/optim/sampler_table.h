// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "optim/sampler_plugin.h"

namespace ridgeline {

// All samplers.
std::span<const SamplerPlugin* const> SamplerTable();

// Names that SamplerOptions::name accepts, in the order of the table.
std::vector<std::string> SamplerNames();

// Throws InputError for a name that no sampler of the table has.
const SamplerPlugin& FindSampler(const std::string& name);

}  // namespace ridgeline
