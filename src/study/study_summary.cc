// SPDX-License-Identifier: Apache-2.0
#include "study/study_summary.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace ridgeline {

const std::array<FigureText, kFigures> kFigureTexts = {
    {{"minimum_m",
      "distance of the map's minimum from the truth [m]",
      [](const Reliability& r) { return r.minimum_m; }},
     {"minimum_deg",
      "angle of the map's minimum from the truth [deg]",
      [](const Reliability& r) { return r.minimum_deg; }},
     {"better_share",
      "share of poses better than the truth's neighbourhood",
      [](const Reliability& r) { return r.better_share; }},
     {"basin_m",
      "a local search comes home from up to [m]",
      [](const Reliability& r) { return r.basin_m; }},
     {"basin_deg",
      "a local search comes home from up to [deg]",
      [](const Reliability& r) { return r.basin_deg; }},
     {"margin",
      "margin of the best mode over the second",
      [](const Reliability& r) { return r.margin; }},
     {"rank_correlation",
      "rank correlation of energy with error within 5 m, 5 deg",
      [](const Reliability& r) { return r.rank_correlation; }}}};

StudySummary SummarizeStudies(std::span<const ScoreStudy* const> studies) {
  StudySummary summary;
  summary.queries = static_cast<int>(studies.size());
  std::vector<double> seconds;
  std::array<std::vector<double>, kFigures> values;
  for (const ScoreStudy* study : studies) {
    seconds.push_back(study->seconds);
    if (!study->figures) continue;
    const Reliability& figures = *study->figures;
    ++summary.with_figures;
    for (std::size_t t = 0; t < kStudyLimits.size(); ++t) {
      const StudyLimit& limit = kStudyLimits[t];
      const bool within =
          figures.minimum_m <= limit.translation_m && figures.minimum_deg <= limit.rotation_deg;
      if (within) summary.recall[t] += 1.0 / static_cast<double>(studies.size());
    }
    for (std::size_t f = 0; f < kFigures; ++f) values[f].push_back(kFigureTexts[f].of(figures));
  }
  for (std::size_t f = 0; f < kFigures; ++f) summary.median[f] = MedianOf(std::move(values[f]));
  summary.seconds = MedianOf(std::move(seconds));
  return summary;
}

std::vector<StudySummary> SummariesOf(std::span<const ScoreStudy> studies,
                                      std::span<const ScoreChoice> scores,
                                      const std::string& dataset_name) {
  std::vector<StudySummary> summaries;
  for (std::size_t s = 0; s < scores.size(); ++s) {
    std::map<std::string, std::vector<const ScoreStudy*>> sets;
    std::vector<const ScoreStudy*> all;
    for (const ScoreStudy& study : studies) {
      if (study.score != s) continue;
      sets[study.set.empty() ? dataset_name : study.set].push_back(&study);
      all.push_back(&study);
    }
    if (sets.size() > 1) sets["all"] = all;
    for (const auto& [set, members] : sets) {
      summaries.push_back(SummarizeStudies(members));
      summaries.back().score = scores[s].name;
      summaries.back().set = set;
    }
  }
  return summaries;
}

std::vector<EnergyGroup> ByEnergy(std::span<const ScoreStudy> studies,
                                  std::size_t score,
                                  int evaluations,
                                  std::size_t groups) {
  std::vector<SampledPose> poses;
  for (const ScoreStudy& study : studies) {
    if (study.score != score) continue;
    for (const SampledPose& pose : study.sampled) {
      if (pose.evaluation <= evaluations) poses.push_back(pose);
    }
  }
  std::stable_sort(poses.begin(), poses.end(), [](const SampledPose& a, const SampledPose& b) {
    return a.energy < b.energy;
  });
  groups = std::min(groups, poses.size());
  std::vector<EnergyGroup> result;
  for (std::size_t g = 0; g < groups; ++g) {
    std::array<std::vector<double>, 3> values;
    for (std::size_t i = g * poses.size() / groups; i < (g + 1) * poses.size() / groups; ++i) {
      values[0].push_back(poses[i].energy);
      values[1].push_back(poses[i].translation_m);
      values[2].push_back(poses[i].rotation_deg);
    }
    result.push_back({MedianOf(std::move(values[0])),
                      MedianOf(std::move(values[1])),
                      MedianOf(std::move(values[2]))});
  }
  return result;
}

std::vector<LevelSummary> LevelSummariesOf(std::span<const VariedStudy> studies,
                                           std::span<const ScoreChoice> scores) {
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::vector<const ScoreStudy*>>
      groups;
  for (const VariedStudy& varied : studies) {
    groups[{varied.variation, varied.study.score, varied.level}].push_back(&varied.study);
  }
  std::vector<LevelSummary> summaries;
  for (const auto& [key, members] : groups) {
    const auto [variation, score, level] = key;
    LevelSummary entry{variation, level, score, 0.0, SummarizeStudies(members)};
    entry.summary.score = scores[score].name;
    std::vector<double> edges;
    for (const ScoreStudy* study : members) edges.push_back(study->visible_edges);
    entry.visible_edges = MedianOf(std::move(edges));
    summaries.push_back(std::move(entry));
  }
  return summaries;
}

}  // namespace ridgeline
