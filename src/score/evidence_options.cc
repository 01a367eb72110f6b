// SPDX-License-Identifier: Apache-2.0
#include "score/evidence_options.h"

#include <string>

#include "score/cue_table.h"

namespace ridgeline {

EvidenceOptions::EvidenceOptions() {
  for (const CuePlugin* cue : CueTable()) cue->declare(cues);
}

void EvidenceOptions::Visit(OptionVisitor& v) {
  v.Field("work_size_px", work_size_px, AtLeast(64));
  v.Field("surface_step_deg", surface_step_deg, Closed(0.05, 10.0));
  cues.Visit(v);
}

}  // namespace ridgeline
