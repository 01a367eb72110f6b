// SPDX-License-Identifier: Apache-2.0
#include "localize/localizer.h"

#include <chrono>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "base/error.h"
#include "localize/belief.h"
#include "localize/pose_scorer.h"
#include "localize/search_poses.h"
#include "localize/settle_pose.h"
#include "localize/widen.h"
#include "score/line_likelihood.h"
#include "score/picture_evidence.h"
#include "score/score_table.h"

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

Localization Abstained(Localization result, LocalizationStatus status, std::string reason) {
  result.status = status;
  result.reason = std::move(reason);
  result.pose.reset();  // a smaller box may have had one
  return result;
}

std::string TooFewLines(std::size_t lines) {
  return "the picture shows " + std::to_string(lines) + " straight lines; " +
         std::to_string(kMinLines) + " are the least";
}

std::string NoVisibleModel(const Score& score) {
  const std::string unusable = score.unusable();
  return unusable.empty() ? "no admissible pose of the search box sees the model" : unusable;
}

// Looks over the box of the scorer's space, and refines what it finds.
SearchedPoses SearchAndRefine(const PoseScorer& scorer,
                              const PictureEvidence& picture,
                              const LocalizerOptions& options,
                              std::uint64_t seed,
                              int threads) {
  SearchedPoses found = SearchPoses(scorer, picture, options.search, seed, threads);
  if (!options.search.refine || found.modes.empty()) return found;
  found.evaluations += RefineModes(scorer, threads, found);
  if (options.search.refinement == "fit") {
    found.modes.front() = SettlePose(scorer,
                                     {picture.segments(), picture.field(), picture.camera()},
                                     options.score.evidence.cues.Get<LineLikelihoodOptions>(),
                                     options.search.fit,
                                     found.modes.front());
  }
  return found;
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
    case LocalizationStatus::kNotExplained:
      return "not_explained";
    case LocalizationStatus::kUnprotected:
      return "unprotected";
    case LocalizationStatus::kDoubtful:
      return "doubtful";
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
  CheckOptions(ranges, "search");
  CheckInput(input, impl_->model);
  const LocalizerOptions& options = impl_->options;
  const Scene& scene = impl_->scene;
  Localization result;
  Stopwatch watch;
  const auto lap = [&](const char* stage) { result.times.push_back({stage, watch.Lap()}); };

  // Look: at the picture.
  const PictureEvidence picture(UndistortImage(BgrOf(input.picture), input.camera),
                                input.camera.Pinhole(),
                                options.lines,
                                options.score.evidence,
                                threads,
                                input.lines);
  const std::unique_ptr<Score> score = MakeScore({picture, scene, options.score});
  lap("picture");
  if (picture.segments().size() < kMinLines) {
    return Abstained(std::move(result),
                     LocalizationStatus::kTooFewLines,
                     TooFewLines(picture.segments().size()));
  }

  // A sampler keeps to its box and its evaluations.
  const int widenings = options.search.method == "map" ? options.search.widenings : 0;
  PoseSpaceOptions box = ranges;
  for (int widening = 0;; ++widening) {
    // Search: over all of the admissible box; refine what is found.
    const PoseSpace space(input.prior, box, scene, dtm(), impl_->footprints);
    const PoseScorer scorer(
        *score, scene, space, picture.camera(), options.score.evidence.surface_step_deg);
    const SearchedPoses found = SearchAndRefine(scorer, picture, options, seed, threads);
    result.evaluations += found.evaluations;
    if (found.volume) result.map = MapOf(*found.volume, space, impl_->model);
    lap("search");

    // Believe: as much as the evidence carries; look further where it carries nothing.
    const bool is_last = widening == widenings;
    if (found.modes.empty() && is_last) {
      return Abstained(
          std::move(result), LocalizationStatus::kNoVisibleModel, NoVisibleModel(*score));
    }
    PoseSpace::Offset best;
    if (!found.modes.empty()) {
      best = found.modes.front().offset;
      Believe(found, scorer, options.confidence, result);
    }
    lap("confidence");
    const bool is_explained =
        !found.modes.empty() && result.confidence >= options.confidence.doubtful_below;
    if (is_last || (is_explained && LimitsReached(best, space).empty())) break;
    const PoseSpaceOptions wider = Widened(space, best, !is_explained && widening == 0);
    if (wider == space.ranges()) break;
    box = wider;
    result.notes.push_back("searched further: " + WordsOf(box));
  }
  return result;
}

}  // namespace ridgeline
