// SPDX-License-Identifier: Apache-2.0
// A cue of one's own: what else of a picture can tell a right pose from a wrong one?
//
//   custom_cue DATASET QUERY        e.g. custom_cue town/dataset.json street_000
//
// The score of a pose is a weighted sum of cues. Each is a log likelihood ratio: how much likelier
// is what the picture shows if the camera stood there than if it stood anywhere. 0 says nothing,
// above 0 speaks for the pose, below 0 against it.
//
// The cue of this example is contrast. Where an edge of a building is seen, the brightness usually
// changes across it, more than it does between two pixels anywhere in the picture. To make a cue of
// that, three questions have to be answered.
//
// 1. What is measured? At samples along the visible edges, the step g of the brightness across the
//    edge.
// 2. How is it distributed? Steps in pictures are many and small, few and large. The simplest law
// of
//    that kind is the exponential. Anywhere its mean is m, which the picture itself tells; on an
//    edge it is f times as much, f > 1. The log ratio of one sample is then
//
//      log( 1/(f m) exp(-g / (f m)) ) - log( 1/m exp(-g / m) ) = (g / m) (1 - 1/f) - log f
//
//    which is negative where there is no step: an edge that should be seen and is not speaks
//    against the pose.
// 3. What must it not trust? Steps behind leaves say nothing of the building. A single huge step (a
//    white sign, a lamp) must not outvote the rest, so g / m is cut off.
//
// The samples of one edge are not independent, so their sum overstates its case. The weight makes
// up for it. The library's own weights were learned (bench/learn_weights.cc); this one is a guess.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "input/dataset.h"
#include "input/read_picture.h"
#include "input/world.h"
#include "localize/localizer.h"
#include "score/cue_table.h"

namespace {

using ridgeline::CuePose;
using ridgeline::PictureEvidence;

// The options of a cue are a struct that names its fields. They become keys like all others, here
// score.evidence.contrast.factor, in configuration files and for SetOption().
struct ContrastOptions {
  double factor = 2.0;      // f: how much larger steps on edges are
  double blur_px = 1.5;     // of the picture: an edge this far beside its line is still found
  double spacing_px = 4.0;  // of the samples
  double cut_off = 6.0;     // of g / m

  void Visit(ridgeline::OptionVisitor& v) {
    v.Field("factor", factor, ridgeline::MoreThan(1.0));
    v.Field("blur_px", blur_px, ridgeline::Positive());
    v.Field("spacing_px", spacing_px, ridgeline::Positive());
    v.Field("cut_off", cut_off, ridgeline::Positive());
  }
};

// A cue is made once per picture and asked for some hundred thousand poses. What depends on the
// picture alone is therefore done in the constructor; a pose costs a few look-ups per edge. It is
// asked by several threads at once, so LogRatios() is const and means it.
class ContrastCue final : public ridgeline::Cue {
 public:
  ContrastCue(const PictureEvidence& picture, const ContrastOptions& options)
      : options_(options), leaves_(picture.foliage()) {
    cv::Mat grey;
    cv::cvtColor(picture.bgr(), grey, cv::COLOR_BGR2GRAY);
    cv::GaussianBlur(grey, grey, cv::Size(), options.blur_px);
    cv::Sobel(grey, step_x_, CV_32F, 1, 0);
    cv::Sobel(grey, step_y_, CV_32F, 0, 1);
    // m: across edges of any direction, the mean over the two axes.
    const double sum = cv::norm(step_x_, cv::NORM_L1) + cv::norm(step_y_, cv::NORM_L1);
    mean_step_ = std::max(1e-3, sum / (2.0 * static_cast<double>(grey.total())));
  }

  // [cue
  // pose.segments are the visible edges of the model, projected into the picture that
  // PictureEvidence holds: reduced, undistorted, in its pixels. What hides what has been dealt
  // with.
  void LogRatios(const CuePose& pose,
                 Workspace* /*workspace*/,
                 std::span<float> log_ratios) const override {
    double sum = 0.0;
    for (const ridgeline::ProjectedSegment& segment : pose.segments) sum += Along(segment);
    log_ratios[0] = static_cast<float>(sum);
  }

 private:
  double Along(const ridgeline::ProjectedSegment& segment) const {
    const Eigen::Vector2f along = segment.b - segment.a;
    const float length = along.norm();
    if (length < 1.0f) return 0.0;
    const Eigen::Vector2f across(-along.y() / length, along.x() / length);
    const int samples = std::max(1, static_cast<int>(length / options_.spacing_px));
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) {
      const Eigen::Vector2f at = segment.a + along * ((i + 0.5f) / samples);
      // Pixel (column, row) covers [column, column + 1): (0, 0) is the corner of the first pixel.
      const cv::Point pixel(static_cast<int>(at.x()), static_cast<int>(at.y()));
      if (!pixel.inside(cv::Rect({}, step_x_.size())) || leaves_.at<uchar>(pixel) > 127) continue;
      sum += LogRatio(
          std::abs(step_x_.at<float>(pixel) * across.x() + step_y_.at<float>(pixel) * across.y()));
    }
    return sum;
  }

  double LogRatio(double step) const {
    const double relative = std::min(step / mean_step_, options_.cut_off);
    return relative * (1.0 - 1.0 / options_.factor) - std::log(options_.factor);
  }
  // cue]

  ContrastOptions options_;
  cv::Mat step_x_, step_y_;
  cv::Mat leaves_;
  double mean_step_ = 1.0;
};

// [table
// The line of the table. `parts` says what the cue reads of a view: what nobody reads is not
// computed.
constexpr ridgeline::CueName kNames[] = {{"contrast", 0.05}};
constexpr ridgeline::CuePlugin kContrast = {
    .names = kNames,
    .parts = {.edges_and_skyline = true, .surfaces = false},
    .declare = [](ridgeline::OptionGroups& options) { options.Add<ContrastOptions>("contrast"); },
    .make = [](const ridgeline::CueContext& context) -> std::shared_ptr<const ridgeline::Cue> {
      return std::make_shared<ContrastCue>(context.picture, context.options.Get<ContrastOptions>());
    }};
// table]

struct Error {
  double position_m = INFINITY;
  double rotation_deg = INFINITY;
};

// How far the best mode is off. Localization::pose would be empty where the confidence is low, and
// a cue on its own gives no reason for confidence.
Error ErrorWith(const ridgeline::LocalizerOptions& options,
                const ridgeline::World& world,
                const ridgeline::Query& query) {
  const ridgeline::Localizer localizer(world.model, world.dtm, options);
  ridgeline::LocalizationInput input;
  input.picture = ridgeline::ReadPicture(query);
  input.camera = query.camera.value();
  input.prior = query.prior.value();
  const ridgeline::Localization found = localizer.Localize(input, /*seed=*/1, /*threads=*/0);
  if (found.modes.empty()) return {};
  const ridgeline::Pose& pose = found.modes.front().pose;
  const ridgeline::Pose& truth = query.truth.value();
  return {(pose.center_in_world - truth.center_in_world).norm(),
          ridgeline::RotationDistanceDeg(pose.cam_from_world, truth.cam_from_world)};
}

// Three times the same photo: without the new cue, with it, and with nothing else. The last is the
// honest test of a cue: does it find the pose on its own? Exits with 1 where one of the three
// misses; alone, this cue does on some photos (few edges, a street under trees).
int Run(const char* dataset_file, const char* query_id) {
  ridgeline::AddCue(kContrast);  // before any options are made

  const ridgeline::Dataset dataset = ridgeline::ReadDataset(dataset_file);
  const ridgeline::Query& query =
      dataset.queries.at(ridgeline::FindQuery(dataset, query_id, "QUERY"));
  const ridgeline::World world = ridgeline::ReadWorld(dataset, 10.0);

  const ridgeline::LocalizerOptions with;
  ridgeline::LocalizerOptions without;
  without.score.weights["contrast"] = 0.0;
  ridgeline::LocalizerOptions alone;
  for (auto& [name, weight] : alone.score.weights) weight = name == "contrast" ? weight : 0.0;

  const auto report = [&](const char* cues, const ridgeline::LocalizerOptions& options) {
    const Error error = ErrorWith(options, world, query);
    std::printf("%-18s off by %.2f m, %.2f deg\n", cues, error.position_m, error.rotation_deg);
    return error.position_m < 2.0 && error.rotation_deg < 2.0;
  };
  const bool found_without = report("without contrast", without);
  const bool found_with = report("with contrast", with);
  const bool found_alone = report("contrast alone", alone);
  return found_without && found_with && found_alone ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "custom_cue DATASET QUERY\n"), 2;
  try {
    return Run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
