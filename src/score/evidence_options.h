// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/option_groups.h"
#include "base/options.h"

namespace ridgeline {

// How a picture is prepared to be compared, and the options of the cues.
struct EvidenceOptions {
  // The picture is reduced to this length of its longer side [px], never enlarged.
  int work_size_px = 960;
  // Resolution of the surfaces seen from a position [deg].
  double surface_step_deg = 0.5;
  // Those of all cues in the table.
  OptionGroups cues;

  EvidenceOptions();
  void Visit(OptionVisitor& v);
};

}  // namespace ridgeline
