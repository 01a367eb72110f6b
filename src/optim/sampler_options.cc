// SPDX-License-Identifier: Apache-2.0
#include "optim/sampler_options.h"

#include "optim/sampler_table.h"

namespace ridgeline {

SamplerOptions::SamplerOptions() {
  for (const SamplerPlugin* sampler : SamplerTable()) sampler->declare(groups);
}

void SamplerOptions::Visit(OptionVisitor& v) {
  v.Field("name", name, OneOf{SamplerNames()});
  groups.Visit(v);
}

}  // namespace ridgeline
