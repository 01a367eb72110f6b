// SPDX-License-Identifier: Apache-2.0
#include "optim/sampler_table.h"

#include <algorithm>

#include "base/error.h"

namespace ridgeline {

extern const SamplerPlugin kRandomSampler;
extern const SamplerPlugin kSobolSampler;
extern const SamplerPlugin kTpeSampler;
extern const SamplerPlugin kMultivariateTpeSampler;
extern const SamplerPlugin kGpSampler;
extern const SamplerPlugin kCmaEsSampler;
extern const SamplerPlugin kDifferentialEvolutionSampler;
extern const SamplerPlugin kGpDeSampler;
extern const SamplerPlugin kNelderMeadSampler;
extern const SamplerPlugin kGridSampler;
extern const SamplerPlugin kMultiStartSampler;

namespace {

std::vector<const SamplerPlugin*>& Table() {
  static std::vector<const SamplerPlugin*> table = {&kRandomSampler,
                                                    &kSobolSampler,
                                                    &kTpeSampler,
                                                    &kMultivariateTpeSampler,
                                                    &kGpSampler,
                                                    &kCmaEsSampler,
                                                    &kDifferentialEvolutionSampler,
                                                    &kGpDeSampler,
                                                    &kNelderMeadSampler,
                                                    &kGridSampler,
                                                    &kMultiStartSampler};
  return table;
}

}  // namespace

std::span<const SamplerPlugin* const> SamplerTable() { return Table(); }

void AddSampler(const SamplerPlugin& plugin) {
  const std::vector<std::string> taken = SamplerNames();
  if (std::find(taken.begin(), taken.end(), plugin.name) != taken.end()) {
    throw InputError(
        "", "sampler", "\"" + std::string(plugin.name) + "\" again", "a name of its own");
  }
  Table().push_back(&plugin);
}

std::vector<std::string> SamplerNames() {
  std::vector<std::string> names;
  for (const SamplerPlugin* sampler : SamplerTable()) names.emplace_back(sampler->name);
  return names;
}

const SamplerPlugin& FindSampler(const std::string& name) {
  for (const SamplerPlugin* sampler : SamplerTable()) {
    if (sampler->name == name) return *sampler;
  }
  throw InputError("",
                   "sampler.name",
                   "\"" + name + "\"",
                   "a known sampler, e.g. \"" + NearestName(name, SamplerNames()) + "\"");
}

}  // namespace ridgeline
