// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "localize/localizer.h"
#include "report/bench_report.h"
#include "report/report_data.h"
#include "study/study_files.h"
#include "study/study_summary.h"

namespace ridgeline {

// The report of a score study: figures per score, score against error, how local searches come
// home, sensitivity, and each query and score with its map.
// @param localizer  Of the study, unvaried.
ReportData StudyReport(const ReportOrigin& origin,
                       const StudyNames& names,
                       const Localizer& localizer,
                       const StudyOptions& options,
                       std::span<const ScoreStudy> studies,
                       std::span<const StudySummary> summaries,
                       std::span<const LevelSummary> levels);

}  // namespace ridgeline
