// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "study/study.h"

namespace ridgeline {

// Limits [m, deg] of the recall of the map's minimum: those of Loeper et al., table 1.
struct StudyLimit {
  const char* name;
  double translation_m;
  double rotation_deg;
};
inline constexpr std::array<StudyLimit, 3> kStudyLimits = {
    {{"2m_2deg", 2.0, 2.0}, {"5m_5deg", 5.0, 5.0}, {"9m_10deg", 9.0, 10.0}}};

// A figure of reliability, as tables and plots name it.
struct FigureText {
  const char* key;      // in CSV and JSON
  const char* meaning;  // for people
  double (*of)(const Reliability&);
};
inline constexpr std::size_t kFigures = 7;
extern const std::array<FigureText, kFigures> kFigureTexts;

// One score on the queries of one set. Queries without figures count as not found, and are left out
// of the medians.
struct StudySummary {
  std::string score;
  std::string set;
  int queries = 0;
  int with_figures = 0;
  std::array<double, kStudyLimits.size()> recall{};  // of the map's minimum
  std::array<double, kFigures> median{};             // of each of kFigureTexts; NaN: not defined
  double seconds = 0.0;                              // of a map, median
};

StudySummary SummarizeStudies(std::span<const ScoreStudy* const> studies);

// By score, then set; where there are several sets, all together too (set "all").
// @param dataset_name  Stands for a set without name.
std::vector<StudySummary> SummariesOf(std::span<const ScoreStudy> studies,
                                      std::span<const ScoreChoice> scores,
                                      const std::string& dataset_name);

// Sampled poses of about one energy.
struct EnergyGroup {
  double energy = 0.0;  // medians
  double translation_m = 0.0;
  double rotation_deg = 0.0;
};

// The poses of a score's sampled searches up to an evaluation, in up to `groups` groups of equal
// size, the least energy first: a score that reflects the pose has its least errors there.
std::vector<EnergyGroup> ByEnergy(std::span<const ScoreStudy> studies,
                                  std::size_t score,
                                  int evaluations,
                                  std::size_t groups);

// One level of one variation and one score, over all queries.
struct LevelSummary {
  std::size_t variation = 0;
  std::size_t level = 0;
  std::size_t score = 0;
  double visible_edges = 0.0;  // median
  StudySummary summary;
};
std::vector<LevelSummary> LevelSummariesOf(std::span<const VariedStudy> studies,
                                           std::span<const ScoreChoice> scores);

}  // namespace ridgeline
