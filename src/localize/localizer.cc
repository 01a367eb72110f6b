// SPDX-License-Identifier: Apache-2.0
#include "localize/localizer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "localize/gravity.h"
#include "localize/make_score.h"
#include "localize/pose_volume.h"
#include "localize/posterior.h"
#include "localize/refine_pose.h"
#include "localize/sampled_search.h"
#include "localize/settle_pose.h"

namespace ridgeline {
namespace {

class Stopwatch {
 public:
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Fewer lines cannot fix a pose: three lines in general position are the least.
constexpr std::size_t kMinLines = 4;

void CheckInput(const LocalizationInput& input, const CityModel& model) {
  if (input.picture.cols != input.camera.width || input.picture.rows != input.camera.height) {
    throw InputError(
        "",
        "image",
        std::to_string(input.picture.cols) + " x " + std::to_string(input.picture.rows),
        "the camera's " + std::to_string(input.camera.width) + " x " +
            std::to_string(input.camera.height));
  }
  constexpr double kMarginM = 500.0;  // a camera may stand beside the modelled buildings
  Eigen::AlignedBox2d extent;
  for (const Eigen::Vector3d& vertex : model.vertices) extent.extend(vertex.head<2>());
  const Eigen::Vector2d place = input.prior.position_in_world - model.origin_in_world.head<2>();
  if (place.allFinite() && extent.exteriorDistance(place) <= kMarginM) return;
  const auto text = [](const Eigen::Vector2d& p) {
    return std::to_string(std::lround(p.x())) + ", " + std::to_string(std::lround(p.y()));
  };
  throw InputError(
      "",
      "prior.position",
      place.allFinite() ? text(input.prior.position_in_world) : "numbers that are not finite",
      "a place in the model, between " + text(extent.min() + model.origin_in_world.head<2>()) +
          " and " + text(extent.max() + model.origin_in_world.head<2>()));
}

// Refines the first `count` modes, until those that are left could not become the best by gaining
// half as much again as the most any has gained.
void RefineWhileHopeful(const std::vector<ScoredPose>& modes,
                        std::size_t count,
                        const std::function<void(std::size_t first, std::size_t count)>& refine) {
  constexpr std::size_t kAtATime = 2;  // not the number of threads: results must not depend on it
  constexpr double kGainFactor = 1.5;
  constexpr double kMargin = 2.0;
  double best = modes.front().log_ratio;
  double gain = 0.0;
  for (std::size_t done = 0; done < count; done += kAtATime) {
    if (modes[done].log_ratio + kGainFactor * gain + kMargin < best) break;
    const std::size_t end = std::min(count, done + kAtATime);
    const std::vector<ScoredPose> before(modes.begin() + done, modes.begin() + end);
    refine(done, end - done);
    for (std::size_t i = done; i < end; ++i) {
      gain = std::max(gain, modes[i].log_ratio - before[i - done].log_ratio);
      best = std::max(best, modes[i].log_ratio);
    }
  }
}

}  // namespace

const char* NameOf(LocalizationStatus status) {
  switch (status) {
    case LocalizationStatus::kOk:
      return "ok";
    case LocalizationStatus::kTooFewLines:
      return "too_few_lines";
    case LocalizationStatus::kNoVisibleModel:
      return "no_visible_model";
    case LocalizationStatus::kAmbiguous:
      return "ambiguous";
  }
  return "";
}

cv::Mat BgrOf(const cv::Mat& picture) {
  cv::Mat eight_bit = picture;
  if (picture.depth() == CV_16U) picture.convertTo(eight_bit, CV_8U, 1.0 / 257.0);
  if (eight_bit.channels() == 3) return eight_bit;
  cv::Mat bgr;
  cv::cvtColor(eight_bit, bgr, eight_bit.channels() == 4 ? cv::COLOR_BGRA2BGR : cv::COLOR_GRAY2BGR);
  return bgr;
}

struct Localizer::Impl {
  Impl(const CityModel& city, std::optional<HeightGrid> heights, const LocalizerOptions& settings)
      : model(city),
        dtm(std::move(heights)),
        options(settings),
        footprints(city),
        scene(city, dtm ? &*dtm : nullptr, settings.projection) {}

  const CityModel& model;
  std::optional<HeightGrid> dtm;
  LocalizerOptions options;
  Footprints footprints;
  Scene scene;
};

Localizer::Localizer(const CityModel& model,
                     std::optional<HeightGrid> dtm,
                     const LocalizerOptions& options) {
  options.Validate();
  impl_ = std::make_unique<Impl>(model, std::move(dtm), options);
}

Localizer::~Localizer() = default;

const Scene& Localizer::scene() const { return impl_->scene; }
const HeightGrid* Localizer::dtm() const { return impl_->dtm ? &*impl_->dtm : nullptr; }
const Footprints& Localizer::footprints() const { return impl_->footprints; }
const LocalizerOptions& Localizer::options() const { return impl_->options; }

Localization Localizer::Localize(const LocalizationInput& input,
                                 std::uint64_t seed,
                                 int threads) const {
  return Localize(input, impl_->options.search.space, seed, threads);
}

Localization Localizer::Localize(const LocalizationInput& input,
                                 const PoseSpaceOptions& ranges,
                                 std::uint64_t seed,
                                 int threads) const {
  ranges.Validate();
  CheckInput(input, impl_->model);
  const LocalizerOptions& options = impl_->options;
  const Scene& scene = impl_->scene;
  Localization result;
  Stopwatch watch;
  const auto lap = [&](const char* stage) { result.times.push_back({stage, watch.Lap()}); };

  // The picture.
  const cv::Mat bgr = UndistortImage(BgrOf(input.picture), input.camera);
  const PinholeCamera camera = input.camera.Pinhole();
  const PictureEvidence evidence(
      bgr, camera, options.lines, options.score.evidence, threads, input.lines);
  const std::unique_ptr<Score> score = MakeScore(options.score, evidence, bgr, camera, scene, 1.0);
  lap("picture");
  if (evidence.segments().size() < kMinLines) {
    result.status = LocalizationStatus::kTooFewLines;
    result.reason = "the picture shows " + std::to_string(evidence.segments().size()) +
                    " straight lines; " + std::to_string(kMinLines) + " are the least";
    return result;
  }

  // The admissible box, and a look over all of it.
  const PoseSpace space(input.prior, ranges, scene, dtm(), impl_->footprints);
  const double surface_step_rad =
      options.score.evidence.surface_step_deg * std::numbers::pi / 180.0;
  std::optional<PoseVolume> volume;
  std::vector<ScoredPose> modes;
  if (options.search.method == "map") {
    const MapOptions& map = options.search.map;
    constexpr double kTiltSeparationDeg = 1.0;
    const std::vector<Tilt> tilts = FindTilts(evidence.segments(),
                                              evidence.camera(),
                                              space.center_angles(),
                                              ranges.pitch_deg,
                                              ranges.roll_deg,
                                              kTiltSeparationDeg,
                                              map.tilts);
    // Between the places of a wide grid the model's edges are off by as much as the model errs.
    const double spacing_m = SpacingOf(ranges, map);
    const std::unique_ptr<Score> wide_score =
        spacing_m > 1.0 ? MakeScore(options.score, evidence, bgr, camera, scene, spacing_m)
                        : nullptr;
    volume = ComputeVolume(wide_score ? *wide_score : *score,
                           scene,
                           space,
                           evidence.camera(),
                           tilts,
                           surface_step_rad,
                           map,
                           threads);
    result.evaluations = volume->evaluations;
    result.map = MapOf(*volume, space, impl_->model);
    modes = FindModes(*volume, space, map);
  } else {
    SampledSearch search = SampleSearch(
        *score, scene, space, evidence.camera(), surface_step_rad, options.search, seed, threads);
    result.evaluations = search.trace.trials.size();
    modes = std::move(search.modes);
  }
  lap("search");
  if (modes.empty()) {
    result.status = LocalizationStatus::kNoVisibleModel;
    const std::string unusable = score->unusable();
    result.reason =
        unusable.empty() ? "no admissible pose of the search box sees the model" : unusable;
    return result;
  }

  // The modes, refined on the exact score: all a little, the better half to the end.
  if (options.search.refine) {
    const auto refine = [&](std::size_t first, std::size_t count, const RefineSteps& steps) {
      std::vector<std::uint64_t> evaluations(count);
      ParallelFor(count, threads, [&](std::size_t i) {
        const RefinedPose refined = RefinePose(
            *score, scene, space, evidence.camera(), surface_step_rad, modes[first + i], steps);
        modes[first + i] = refined.pose;
        evaluations[i] = refined.evaluations;
      });
      for (const std::uint64_t n : evaluations) result.evaluations += n;
    };
    const auto best_first = [&] {
      std::stable_sort(modes.begin(), modes.end(), [](const ScoredPose& x, const ScoredPose& y) {
        return x.log_ratio > y.log_ratio;
      });
    };
    const double first_m = volume ? 0.5 * SpacingOf(ranges, options.search.map) : 0.5;
    refine(0, modes.size(), {first_m, 0.5, 0.3});
    best_first();
    const std::size_t better = (modes.size() + 2) / 3;
    RefineWhileHopeful(modes, better, [&](std::size_t first, std::size_t count) {
      refine(first, count, {0.25, 0.25, 0.06});
    });
    best_first();
    if (options.search.refinement == "fit") {
      modes.front() = SettlePose(*score,
                                 {evidence.segments(), evidence.field(), evidence.camera()},
                                 scene,
                                 space,
                                 surface_step_rad,
                                 options.score.evidence.lines,
                                 options.search.fit,
                                 modes.front());
    }
    lap("refinement");
  }

  // What to believe.
  const Posterior posterior = volume ? PosteriorOf(*volume, modes, space, options.confidence)
                                     : PosteriorOf(modes, options.confidence);
  result.confidence = posterior.confidence;
  result.spread = posterior.spread;
  for (const ScoredPose& mode : modes) {
    const std::optional<Pose> local = space.PoseAt(mode.offset);
    result.modes.push_back(
        {{local->cam_from_world, local->center_in_world + impl_->model.origin_in_world},
         Score::EnergyOf(mode.log_ratio)});
  }
  result.energy = result.modes.front().energy;
  if (result.confidence < options.confidence.abstain_below) {
    result.status = LocalizationStatus::kAmbiguous;
    result.reason = "other poses explain the picture about as well (confidence " +
                    std::to_string(result.confidence).substr(0, 4) + ")";
  } else {
    result.status = LocalizationStatus::kOk;
    result.pose = result.modes.front().pose;
  }
  lap("confidence");
  return result;
}

}  // namespace ridgeline
