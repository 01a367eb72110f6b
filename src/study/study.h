// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/bench_queries.h"
#include "eval/run_folder.h"
#include "eval/shard.h"
#include "input/dataset.h"
#include "localize/localizer.h"
#include "study/explore.h"
#include "study/reliability.h"
#include "study/score_choice.h"
#include "study/variation.h"

namespace ridgeline {

struct StudyOptions {
  std::uint64_t seed = 1;  // of priors, searches and variations
  // Evaluations of the sampled search after which the paper looks at score and error (its Fig. 5).
  std::vector<int> classes = {50, 100, 200};
  // Whether X, Y are explored as in Ayadi et al., Fig. 9.
  bool explore = false;
  int threads = 0;
  Shard shard;  // of the maps, by query, then score; of the changed ones by level before
  // Where finished maps are kept, and those of an earlier start are found; null: nowhere.
  const RunFolder* folder = nullptr;

  // Throws InputError naming the argument.
  void Validate() const;
};

// A pose that a sampled search looked at.
struct SampledPose {
  int evaluation = 0;  // from 1
  int after = 0;       // the class: the first of StudyOptions::classes that it belongs to
  double energy = 1.0;
  double translation_m = 0.0;
  double horizontal_m = 0.0;
  double rotation_deg = 0.0;
};

// One score on one query. The truth made the prior and the errors; the score never saw it.
struct ScoreStudy {
  std::size_t query = 0;  // index into Dataset::queries
  std::size_t score = 0;  // index into the scores
  std::string set;        // of the query
  PosePrior prior;
  PoseSpaceOptions ranges;             // half-ranges of the map around the prior
  std::optional<Reliability> figures;  // absent: every pose has the energy 1
  std::string reason;                  // why they are absent; empty where they are not
  Pose minimum;                        // world frame; of the map, where there are figures
  EnergyMap map;
  std::vector<double> heading_deg;     // of the map's headings
  std::vector<double> heading_energy;  // the least over all positions and tilts
  std::vector<ErrorBin> by_distance;
  std::vector<ErrorBin> by_angle;
  std::vector<SampledPose> sampled;
  std::optional<ExploredMap> explored;
  int visible_edges = 0;  // pieces of model edges in the picture at the truth
  int picture_lines = 0;
  double seconds = 0.0;  // of the map, with the score's look at the picture
};

// The same on a changed input: figures only.
struct VariedStudy {
  std::size_t variation = 0;
  std::size_t level = 0;  // index into its levels
  ScoreStudy study;
};

struct StudyProgress {
  std::size_t done = 0;
  std::size_t total = 0;
};
using StudyProgressFunction = std::function<void(const StudyProgress&)>;

// The queries of a study: those named, or all with a truth. Throws InputError for an id that is
// none (with the nearest), a named query without truth, and a dataset without any truth.
// @param sets  Of the queries; empty: any.
std::vector<std::size_t> StudyQueries(const Dataset& dataset,
                                      const std::vector<std::string>& ids,
                                      const std::vector<std::string>& sets = {});

// Every score on every query, by query, then score; the map covers the box that the protocol gives
// a search. `queries` are indices into the dataset of `source`, usable ones. One picture at a time,
// on all threads; the same result on any number of them.
std::vector<ScoreStudy> RunStudy(const BenchQueries& source,
                                 std::span<const std::size_t> queries,
                                 const Localizer& localizer,
                                 std::span<const ScoreChoice> scores,
                                 const StudyOptions& options,
                                 const StudyProgressFunction& progress);

// The maps' figures at every level of every variation, one circumstance at a time.
std::vector<VariedStudy> RunVariations(const BenchQueries& source,
                                       std::span<const std::size_t> queries,
                                       const Localizer& localizer,
                                       std::span<const ScoreChoice> scores,
                                       std::span<const Variation> variations,
                                       const StudyOptions& options,
                                       const StudyProgressFunction& progress);

}  // namespace ridgeline
