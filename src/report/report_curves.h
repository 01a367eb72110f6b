// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "report/report_data.h"

namespace ridgeline {

// Share with its 95 % interval.
struct Share95 {
  double x = 0.0;
  double share = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  int count = 0;
};

// Share of the runs with truth within (x m, x degrees), for x from 0.25 to 10. Wilson intervals
// with the number of queries. Empty without truth.
std::vector<Share95> RecallCurve(std::span<const ReportRun> runs);

// Share of right poses among the answered runs with truth, in bins of reported confidence; x is the
// mean confidence of the bin. Wilson intervals. Empty bins are left out.
std::vector<Share95> Reliability(std::span<const ReportRun> runs, int bins);

}  // namespace ridgeline
