// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/report_data.h"

namespace ridgeline::testing {

// A made-up report: `runs` runs of which most are right, with photos, maps, ellipses and plots. The
// names hold what breaks careless pages: spaces, quotes, umlauts, <script>.
ReportData ExampleReport(int runs);

}  // namespace ridgeline::testing
