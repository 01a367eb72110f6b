// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "input/dataset.h"
#include "study/study.h"
#include "study/study_summary.h"

namespace ridgeline {

// The tables that `ridgeline study --out` writes (docs/study.md), as text. What is not defined is
// an empty field. Positions are in the dataset's system.

// All that the rows of several queries and scores are named by.
struct StudyNames {
  const Dataset& dataset;
  std::span<const ScoreChoice> scores;
  std::span<const Variation> variations;
};

// One row per query and score.
std::string FiguresCsv(const StudyNames& names, std::span<const ScoreStudy> studies);
// One row per score and set.
std::string SummaryCsv(const Protocol& protocol, std::span<const StudySummary> summaries);
// The same, for --json.
std::string StudySummaryJson(const std::string& dataset,
                             const Protocol& protocol,
                             std::span<const StudySummary> summaries);
// Energy by position of one query and score, the least over orientations.
std::string MapCsv(const EnergyMap& map);
// Energy by heading, the least over positions.
std::string HeadingsCsv(const StudyNames& names, std::span<const ScoreStudy> studies);
// Energy and share that comes home by distance and by angle from the truth.
std::string ProfilesCsv(const StudyNames& names, std::span<const ScoreStudy> studies);
// The poses of the sampled searches: class, energy and error.
std::string SampledCsv(const StudyNames& names, std::span<const ScoreStudy> studies);
// One row per query, score and level.
std::string SensitivityCsv(const StudyNames& names, std::span<const VariedStudy> studies);
// One row per score and level.
std::string SensitivitySummaryCsv(const StudyNames& names, std::span<const LevelSummary> summaries);
// The exploration of X, Y with the best angles; for "skyline_l1" with its distance in pixels.
std::string ExploredCsv(const ExploredMap& explored, const ScoreChoice& score);

// The distance of "skyline_l1" that an energy of it stands for [px at 640].
double SkylineDistanceOf(double energy, const ScoreOptions& options);

}  // namespace ridgeline
