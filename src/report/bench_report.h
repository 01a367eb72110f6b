// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "eval/bench.h"
#include "input/read_picture.h"
#include "localize/localizer.h"
#include "report/report_data.h"

namespace ridgeline {

// What a report says about its making.
struct ReportOrigin {
  std::string title;
  std::string command;
  std::string version;
  std::string crs;
  std::string options_json;
  Protocol protocol;  // without a name: none, as of a single photo
};

// The report of localized queries: of one (`ridgeline localize`) or many (`ridgeline bench`).
// The photos are kept small; what was assumed of each query is a table.
ReportData BenchReport(const ReportOrigin& origin,
                       const std::vector<Query>& queries,
                       const Localizer& localizer,
                       std::span<const BenchRun> runs,
                       PictureReader& pictures);

// The photo of a query, undistorted and kept small.
ReportPhoto ReportPhotoOf(const Query& query, PictureReader& pictures);

// Model edges at the prior (thin, grey) and at the result (by kind) over the photo, on its
// undistorted picture; at the best mode if there is no result.
Overlay ResultOverlay(const Localizer& localizer, const PinholeCamera& camera, const BenchRun& run);

}  // namespace ridgeline
