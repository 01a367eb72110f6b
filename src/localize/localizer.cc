// SPDX-License-Identifier: Apache-2.0
#include "localize/localizer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "base/error.h"
#include "localize/belief.h"
#include "localize/focal_search.h"
#include "localize/pose_scorer.h"
#include "localize/roof_doubt.h"
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

std::string NoVisibleModel(const Score& score) {
  const std::string unusable = score.unusable();
  return unusable.empty() ? "no admissible pose of the search box sees the model" : unusable;
}

// Whether two poses are one answer, the second with more freedom.
bool IsBeside(const PoseSpace::Offset& a, const PoseSpace::Offset& b) {
  constexpr double kBesideM = 5.0;
  constexpr double kBesideDeg = 10.0;
  return std::hypot(a.east_m - b.east_m, a.north_m - b.north_m) < kBesideM &&
         std::abs(HeadingDifferenceDeg(a.heading_deg, b.heading_deg)) < kBesideDeg;
}

std::string WordsOf(const RoofShift& shift, const CityModel& model) {
  char metres[80];
  std::snprintf(metres,
                sizeof(metres),
                ": its roof is taken %+.1f m from where the model has it",
                shift.up_m);
  return "building " + NameOf(model.buildings[shift.building]) + metres;
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

  // Search and belief for a picture whose camera is known.
  Localization LocalizeWith(const PictureEvidence& picture,
                            const PosePrior& prior,
                            const PoseSpaceOptions& ranges,
                            std::uint64_t seed,
                            int threads) const;

  // Where the picture puts roofs at other heights than the model: searches again with the roofs
  // there, and takes that answer if it explains the picture better by far. Returns the best pose.
  ScoredPose WithRoofsInDoubt(const PictureEvidence& picture,
                              const PoseSpace& space,
                              std::uint64_t seed,
                              int threads,
                              const ScoredPose& as_modelled,
                              Localization& result) const;

  // What one box gives.
  struct BoxAnswer {
    Localization result;
    std::optional<ScoredPose> best;  // none sees the model
    std::vector<std::string> limits;  // reached by the best
  };
  BoxAnswer AnswerOf(const PictureEvidence& picture,
                     const Score& score,
                     const PoseSpace& space,
                     std::uint64_t seed,
                     int threads) const;

  // Whether a larger box has nothing that outweighs the smaller one's answer, which is then believed
  // by as much less as it comes near to that.
  bool KeepSmallerBox(BoxAnswer& smaller, BoxAnswer& larger) const;

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

Localizer::Impl::BoxAnswer Localizer::Impl::AnswerOf(const PictureEvidence& picture,
                                                     const Score& score,
                                                     const PoseSpace& space,
                                                     std::uint64_t seed,
                                                     int threads) const {
  BoxAnswer answer;
  Localization& result = answer.result;
  Stopwatch watch;
  const auto lap = [&](const char* stage) { result.times.push_back({stage, watch.Lap()}); };
  // Search: over all of the admissible box; refine what is found.
  const PoseScorer scorer(
      score, scene, space, picture.camera(), options.score.evidence.surface_step_deg);
  const SearchedPoses found = SearchAndRefine(scorer, picture, options, seed, threads);
  result.evaluations = found.evaluations;
  if (found.volume) result.map = MapOf(*found.volume, space, model);
  lap("search");
  if (found.modes.empty()) {
    result = Abstained(
        std::move(result), LocalizationStatus::kNoVisibleModel, NoVisibleModel(score));
    return answer;
  }
  // Believe: as much as the evidence carries.
  Believe(found, scorer, options.confidence, result);
  lap("confidence");
  // A sampler keeps to its evaluations.
  answer.best = options.search.method == "map"
                    ? WithRoofsInDoubt(picture, space, seed, threads, found.modes.front(), result)
                    : found.modes.front();
  answer.limits = LimitsReached(answer.best->offset, space);
  lap("roofs");
  return answer;
}

Localization Localizer::Impl::LocalizeWith(const PictureEvidence& picture,
                                           const PosePrior& prior,
                                           const PoseSpaceOptions& ranges,
                                           std::uint64_t seed,
                                           int threads) const {
  const std::unique_ptr<Score> score = MakeScore({picture, scene, options.score});
  // A sampler keeps to its box and its evaluations.
  const int widenings = options.search.method == "map" ? options.search.widenings : 0;
  PoseSpaceOptions box = ranges;
  BoxAnswer kept;
  for (int widening = 0;; ++widening) {
    const PoseSpace space(prior, box, scene, dtm ? &*dtm : nullptr, footprints);
    BoxAnswer answer = AnswerOf(picture, *score, space, seed, threads);
    if (widening > 0) {
      answer.result.Include(kept.result);
      answer.result.notes.push_back("searched further: " + WordsOf(box));
      if (KeepSmallerBox(kept, answer)) break;
    }
    kept = std::move(answer);

    // Look further where the evidence carries nothing, or the answer lies on a limit.
    const bool is_explained =
        kept.best && kept.result.confidence >= options.confidence.doubtful_below;
    if (widening == widenings || (is_explained && kept.limits.empty())) break;
    box = Widened(space,
                  kept.best ? kept.best->offset : PoseSpace::Offset{},
                  !is_explained && widening == 0);
    if (box == space.ranges()) break;
  }
  return std::move(kept.result);
}

bool Localizer::Impl::KeepSmallerBox(BoxAnswer& smaller, BoxAnswer& larger) const {
  // The box asked for is far likelier than what is around it.
  constexpr double kOutsideNat = 6.0;
  if (!smaller.best || !larger.best) return !larger.best && smaller.best;
  // Beyond the limit that the answer reached it goes on.
  if (IsBeside(smaller.best->offset, larger.best->offset)) return false;
  const double advantage = larger.best->log_ratio - smaller.best->log_ratio - kOutsideNat;
  Localization& result = smaller.result;
  if (advantage > 0.0 && larger.result.confidence >= result.confidence) return false;
  // What explains less in absolute terms outweighs nothing, whatever its score.
  Reconsider(1.0 / (1.0 + std::exp(std::min(advantage, 0.0))),
             !smaller.limits.empty(),
             options.confidence,
             result);
  result.evaluations = larger.result.evaluations;
  result.times = std::move(larger.result.times);
  result.notes = std::move(larger.result.notes);
  return true;
}

ScoredPose Localizer::Impl::WithRoofsInDoubt(const PictureEvidence& picture,
                                             const PoseSpace& space,
                                             std::uint64_t seed,
                                             int threads,
                                             const ScoredPose& as_modelled,
                                             Localization& result) const {
  constexpr int kRounds = 2;
  constexpr double kLeastGain = 4.0;  // [nat]
  ScoredPose best = as_modelled;
  std::vector<RoofShift> shifts;
  for (int round = 0; round < kRounds; ++round) {
    const std::optional<RoofShift> doubted =
        RoofInDoubt({picture, model, space, options, shifts}, result.goodness, best);
    if (!doubted) break;
    std::vector<RoofShift> tried = shifts;
    tried.push_back(*doubted);
    const CityModel shifted = WithShiftedRoofs(model, tried);
    const Scene shifted_scene(shifted, dtm ? &*dtm : nullptr, options.projection);
    const std::unique_ptr<Score> score = MakeScore({picture, shifted_scene, options.score});
    const PoseScorer scorer(
        *score, shifted_scene, space, picture.camera(), options.score.evidence.surface_step_deg);
    const SearchedPoses found = SearchAndRefine(scorer, picture, options, seed, threads);
    result.evaluations += found.evaluations;
    if (found.modes.empty() || found.modes.front().log_ratio < best.log_ratio + kLeastGain) break;
    best = found.modes.front();
    shifts = std::move(tried);
    if (found.volume) result.map = MapOf(*found.volume, space, model);
    Believe(found, scorer, options.confidence, result);
  }
  for (const RoofShift& shift : shifts) result.doubts.push_back(WordsOf(shift, model));
  return best;
}

Localization Localizer::Localize(const LocalizationInput& input,
                                 const PoseSpaceOptions& ranges,
                                 std::uint64_t seed,
                                 int threads) const {
  CheckOptions(ranges, "search");
  CheckInput(input, impl_->model);
  // Look: at the picture.
  Stopwatch watch;
  const LocalizerOptions& options = impl_->options;
  const PictureEvidence picture(UndistortImage(BgrOf(input.picture), input.camera),
                                input.camera.Pinhole(),
                                options.lines,
                                options.score.evidence,
                                threads,
                                input.lines);
  const StageTime looked{"picture", watch.Lap()};
  Localization result;
  if (std::string reason = TooFewLines(picture.segments().size()); !reason.empty()) {
    result = Abstained({}, LocalizationStatus::kTooFewLines, std::move(reason));
  } else {
    result = WithBestFocal(picture, input.focal_lengths, [&](const PictureEvidence& evidence) {
      return impl_->LocalizeWith(evidence, input.prior, ranges, seed, threads);
    });
  }
  result.times.insert(result.times.begin(), looked);
  return result;
}

}  // namespace ridgeline
