// SPDX-License-Identifier: Apache-2.0
#include "score/evidence_options.h"

#include <string>

#include "base/error.h"
#include "score/cue_table.h"

namespace ridgeline {

EvidenceOptions::EvidenceOptions() {
  for (const CuePlugin* cue : CueTable()) cue->declare(cues);
}

void EvidenceOptions::Visit(OptionVisitor& v) {
  v.Field("work_size_px", work_size_px);
  v.Field("surface_step_deg", surface_step_deg);
  cues.Visit(v);
}

void EvidenceOptions::Validate() const {
  if (work_size_px < 64) {
    throw InputError("", "score.work_size_px", std::to_string(work_size_px), ">= 64");
  }
  if (!(surface_step_deg >= 0.05 && surface_step_deg <= 10.0)) {
    throw InputError("", "score.surface_step_deg", std::to_string(surface_step_deg), "[0.05, 10]");
  }
  cues.Validate();
}

}  // namespace ridgeline
