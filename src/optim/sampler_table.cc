// SPDX-License-Identifier: Apache-2.0
#include "optim/sampler_table.h"

#include <array>

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

std::span<const SamplerPlugin* const> SamplerTable() {
  static constexpr std::array kTable = {&kRandomSampler,
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
  return kTable;
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
