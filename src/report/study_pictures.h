// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "report/drawing.h"
#include "study/study_files.h"
#include "study/study_summary.h"

namespace ridgeline {

// Pictures of a score study, for `ridgeline study --out`.

// One score on one query: energy by position with truth, minimum and prior; energy by heading;
// energy by distance from the truth.
Drawing MapPicture(const StudyNames& names, const ScoreStudy& study);

// The exploration of X, Y (Ayadi et al., Fig. 9); pixels for "skyline_l1", else the energy.
Drawing ExploredPicture(const StudyNames& names, const ScoreStudy& study);

// Score against error of the sampled searches of all queries, after each class of evaluations from
// left to right (Loeper et al., Fig. 5), with the median error at an energy; translation above,
// rotation below.
Drawing ScatterPicture(const StudyNames& names,
                       std::span<const ScoreStudy> studies,
                       std::size_t score,
                       std::span<const int> classes);

// How the figures of each score change with one circumstance.
Drawing SensitivityPicture(const StudyNames& names,
                           std::span<const LevelSummary> summaries,
                           std::size_t variation);

}  // namespace ridgeline
