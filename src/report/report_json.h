// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "report/report_data.h"

namespace ridgeline {

// The parts of the report that its script reads, as JSON that is safe inside <script>: no '<'.
// The summary has everything the first view needs; photos and details are read when they are shown.
std::string SummaryJson(const ReportData& data);
std::string PhotoJson(const ReportPhoto& photo, int max_side_px);
std::string RunDetailJson(const ReportRun& run);

}  // namespace ridgeline
