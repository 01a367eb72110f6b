// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/bench_queries.h"
#include "eval/metrics.h"
#include "eval/perturb.h"
#include "eval/shard.h"
#include "input/dataset.h"
#include "input/read_picture.h"
#include "localize/localizer.h"

namespace ridgeline {

class RunFolder;

struct BenchOptions {
  std::vector<int> seeds = {1};  // of the priors and of the samplers
  int threads = 0;
  Shard shard;  // of the runs, by query, then seed
  // Where finished runs are kept, and those of an earlier start are found; null: nowhere.
  const RunFolder* folder = nullptr;
  // For others who read the same pictures; null: they are read for the runs alone.
  PictureReader* pictures = nullptr;
};

// One run with all that a report shows.
struct BenchRun {
  RunRecord record;
  std::size_t query = 0;  // index into Dataset::queries
  bool is_given = false;    // the pose is another system's: no prior, no box, no search
  PosePrior prior;
  PoseSpaceOptions ranges;  // half-ranges of the search box around the prior
  Localization localization;
};

// Called after each run, in order, on the caller's thread.
using BenchProgress = std::function<void(const BenchRun&, std::size_t done, std::size_t total)>;

// A run to be made.
struct PlannedRun {
  std::size_t query = 0;  // index into Dataset::queries
  int seed = 0;
  std::size_t index = 0;  // among all runs, of every shard
};

// Every usable query with every seed, by query, then seed: those of the options' shard.
std::vector<PlannedRun> PlanRuns(const BenchQueries& queries, const BenchOptions& options);

// Name of a run's piece in a RunFolder.
std::string PieceNameOf(const PlannedRun& planned, const Query& query);

// One planned run, made now.
BenchRun MakeRun(const PlannedRun& planned,
                 const BenchQueries& queries,
                 const Localizer& localizer,
                 PictureReader& pictures,
                 int threads);

// Localizes every usable query with every seed. Of the truth a search sees nothing: its input is
// the picture, the camera, and what BenchQueries::Start gives. One run at a time, each on all
// threads, so that the seconds are those of a user.
std::vector<BenchRun> RunBench(const BenchQueries& queries,
                               const Localizer& localizer,
                               const BenchOptions& options,
                               const BenchProgress& progress);

// Half-ranges of the search for made priors: those of the perturbation.
PoseSpaceOptions RangesOf(const PoseSpaceOptions& options, const Perturbation& perturb);

// The prior and camera of a query, from the dataset or, where absent, from the picture. Throws
// InputError naming the query.
LocalizationInput InputOf(const Query& query,
                          const LocalizerOptions& options,
                          PictureReader& pictures);

// The camera of a query without its distortion, with the focal length that was found where it was
// not known for sure.
PinholeCamera CameraOf(const Query& query, const Localization& localization);

// The record of one localization.
RunRecord RecordOf(const Query& query, int seed, const Localization& localization, double seconds);

}  // namespace ridgeline
