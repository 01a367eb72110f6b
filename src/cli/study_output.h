// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "study/study_files.h"
#include "study/study_summary.h"

namespace ridgeline {

// All results of a study.
struct StudyResults {
  const StudyNames& names;
  const Protocol& protocol;
  const StudyOptions& options;
  std::span<const ScoreStudy> studies;
  std::span<const StudySummary> summaries;
  std::span<const VariedStudy> varied;
  std::span<const LevelSummary> levels;
};

// Writes the tables, pictures and maps of docs/study.md into an existing folder; each file appears
// whole or not at all.
// @param epsg  Of all coordinates; 0: not known.
void WriteStudy(const StudyResults& results, int epsg, const std::filesystem::path& folder);

}  // namespace ridgeline
