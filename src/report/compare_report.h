// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "eval/comparison.h"
#include "input/dataset.h"
#include "localize/localizer.h"
#include "report/report_data.h"

namespace ridgeline {

// What a comparison's page is about.
struct CompareTitle {
  std::string title;
  std::string command;
  std::string version;
  std::string crs;
};

// A page of tables and plots, with each photo on which two systems disagree and the model's edges at
// both poses, one system on each side of the slider. Each comparison is of the first system with
// another.
// @param dataset  Of the photos; null with `localizer`: no photos.
ReportData CompareReport(const CompareTitle& title,
                         std::span<const Comparison> comparisons,
                         const Dataset* dataset,
                         const Localizer* localizer);

}  // namespace ridgeline
