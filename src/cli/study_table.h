// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "study/study_files.h"
#include "study/study_summary.h"

namespace ridgeline {

// Summaries of a study as text for people.
std::string TableOf(std::span<const StudySummary> summaries);
std::string SensitivityTextOf(const StudyNames& names, std::span<const LevelSummary> levels);

}  // namespace ridgeline
