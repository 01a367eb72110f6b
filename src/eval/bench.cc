// SPDX-License-Identifier: Apache-2.0
#include "eval/bench.h"

#include <chrono>
#include <cmath>

#include "base/error.h"
#include "eval/binomial.h"
#include "eval/pose_json.h"
#include "eval/run_folder.h"
#include "eval/run_json.h"
#include "lines/segments_file.h"

namespace ridgeline {
namespace {

// Quantile of the chi-square distribution with two degrees of freedom at 0.95: -2 ln 0.05.
constexpr double kChiSquare95 = 5.991464547107979;

}  // namespace

PoseSpaceOptions RangesOf(const PoseSpaceOptions& options, const Perturbation& perturb) {
  PoseSpaceOptions ranges = options;
  ranges.east_m = perturb.east_m;
  ranges.north_m = perturb.north_m;
  ranges.height_m = perturb.height_m;
  ranges.heading_deg = perturb.heading_deg;
  ranges.pitch_deg = perturb.pitch_deg;
  ranges.roll_deg = perturb.roll_deg;
  return ranges;
}

LocalizationInput InputOf(const Query& query,
                          const LocalizerOptions& options,
                          PictureReader& pictures) {
  LocalizationInput input;
  input.picture = pictures.Read(query);
  if (!query.camera) {
    throw InputError(query.image.string(), "camera", "none", "a camera for query " + query.id);
  }
  input.camera = *query.camera;
  if (query.prior) input.prior = *query.prior;
  input.focal_lengths = query.focal_lengths;
  if (options.lines.detector == "file") {
    if (!query.lines) {
      throw InputError(query.image.string(),
                       "lines",
                       "none",
                       "a file of segments, since lines.detector is \"file\"");
    }
    input.lines = ReadSegments(*query.lines, *query.camera);
  }
  return input;
}

PinholeCamera CameraOf(const Query& query, const Localization& localization) {
  PinholeCamera camera = query.camera->Pinhole();
  if (localization.focal_px) camera.fx = camera.fy = *localization.focal_px;
  return camera;
}

RunRecord RecordOf(const Query& query, int seed, const Localization& localization, double seconds) {
  RunRecord record;
  record.query = query.id;
  record.set = query.set;
  record.seed = seed;
  record.status = StatusOf(localization);
  record.reason = localization.reason;
  record.energy = localization.energy;
  record.confidence = localization.confidence;
  record.pose = localization.pose;
  record.posterior_mass = localization.posterior_mass;
  const bool is_judged = localization.goodness.is_known() || std::isfinite(localization.energy);
  record.explained = is_judged ? localization.goodness.explained() : NAN;
  record.observed_nat = is_judged ? localization.goodness.observed : NAN;
  record.information_nat = is_judged ? localization.goodness.information() : NAN;
  record.above_background_nat = localization.above_background;
  if (!localization.modes.empty() && query.truth) {
    record.candidate_error = ErrorOf(localization.modes.front().pose, *query.truth);
  }
  record.has_truth = query.truth.has_value();
  record.evaluations = localization.evaluations;
  record.seconds = seconds;
  if (!localization.pose || !query.truth) return record;
  record.error = ErrorOf(*localization.pose, *query.truth);
  const Eigen::Vector2d offset =
      (localization.pose->center_in_world - query.truth->center_in_world).head<2>();
  record.ellipse_holds_truth =
      offset.dot(localization.spread.position_covariance.inverse() * offset) <= kChiSquare95;
  const double heading_error =
      HeadingDifferenceDeg(ViewAnglesOf(localization.pose->cam_from_world).heading_deg,
                           ViewAnglesOf(query.truth->cam_from_world).heading_deg);
  record.interval_holds_truth =
      std::abs(heading_error) <= kNormal95 * localization.spread.heading_sigma_deg;
  return record;
}

std::vector<PlannedRun> PlanRuns(const BenchQueries& queries, const BenchOptions& options) {
  std::vector<PlannedRun> planned;
  std::size_t index = 0;
  for (const std::size_t q : queries.usable()) {
    for (const int seed : options.seeds) {
      if (options.shard.Takes(index)) planned.push_back({q, seed, index});
      ++index;
    }
  }
  return planned;
}

std::string PieceNameOf(const PlannedRun& planned, const Query& query) {
  return PieceName(planned.index, query.id + "_" + std::to_string(planned.seed));
}

BenchRun MakeRun(const PlannedRun& planned,
                 const BenchQueries& queries,
                 const Localizer& localizer,
                 PictureReader& pictures,
                 int threads) {
  const Query& query = queries.dataset().queries[planned.query];
  const auto start = std::chrono::steady_clock::now();
  LocalizationInput input = InputOf(query, localizer.options(), pictures);
  const SearchStart from = queries.Start(planned.query, planned.seed, localizer);
  input.prior = from.prior;
  BenchRun run;
  run.query = planned.query;
  run.prior = from.prior;
  run.ranges = from.ranges;
  run.localization = localizer.Localize(input, from.ranges, planned.seed, threads);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.record = RecordOf(query, planned.seed, run.localization, seconds);
  return run;
}

std::vector<BenchRun> RunBench(const BenchQueries& queries,
                               const Localizer& localizer,
                               const BenchOptions& options,
                               const BenchProgress& progress) {
  PictureReader own_pictures;
  PictureReader& pictures = options.pictures != nullptr ? *options.pictures : own_pictures;
  std::vector<BenchRun> runs;
  const std::vector<PlannedRun> plan = PlanRuns(queries, options);
  for (const PlannedRun& planned : plan) {
    const Query& query = queries.dataset().queries[planned.query];
    const std::string piece = PieceNameOf(planned, query);
    const std::optional<std::string> kept =
        options.folder != nullptr ? options.folder->Find(piece) : std::nullopt;
    if (kept) {
      runs.push_back(ReadRun(*kept, query, planned.query, piece));
    } else {
      runs.push_back(MakeRun(planned, queries, localizer, pictures, options.threads));
      if (options.folder != nullptr) options.folder->Keep(piece, RunText(runs.back()));
    }
    if (progress) progress(runs.back(), runs.size(), plan.size());
  }
  return runs;
}

}  // namespace ridgeline
