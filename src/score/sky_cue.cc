// SPDX-License-Identifier: Apache-2.0
// The sky: the likelihood (sky_table.h, with the source) of the model's skyline in the picture's
// columns, given how much each pixel looks like sky.
#include <opencv2/imgproc.hpp>

#include "score/cue.h"
#include "score/sky_score.h"
#include "score/sky_table.h"
#include "skyline/sky_likelihood.h"

namespace ridgeline {
namespace {

// Leaves may be before sky or before a building.
cv::Mat SkyLogOddsOf(const PictureEvidence& picture) {
  cv::Mat log_odds = SkyLogOdds(picture.bgr(), SkyLikelihoodOptions{});
  cv::Mat covered;
  cv::resize(picture.foliage(), covered, log_odds.size(), 0.0, 0.0, cv::INTER_AREA);
  log_odds.setTo(0.0f, covered > 127);
  return log_odds;
}

class SkyCue final : public Cue {
 public:
  SkyCue(const cv::Mat& log_odds, const PinholeCamera& camera, const SkyTableOptions& options)
      : log_odds_(log_odds),
        options_(options),
        table_(log_odds, options),
        camera_(camera.Scaled(static_cast<double>(table_.columns()) / camera.width)) {}

  // Half as many columns and rows for a coarse grid.
  std::shared_ptr<const Cue> Tolerant(double factor) const override {
    constexpr int kLeastColumns = 100;
    if (!(factor > 1.0) || table_.columns() < 2 * kLeastColumns) return nullptr;
    cv::Mat half;
    cv::resize(log_odds_, half, {}, 0.5, 0.5, cv::INTER_AREA);
    SkyTableOptions options = options_;
    options.pixel_weight *= 2.0;  // a pixel is as high as two
    return std::make_shared<SkyCue>(half, camera_, options);
  }

  std::unique_ptr<Workspace> NewWorkspace() const override {
    auto memory = std::make_unique<Memory>();
    memory->rows.resize(table_.columns());
    return memory;
  }

  void LogRatios(const CuePose& pose,
                 Workspace* workspace,
                 std::span<float> log_ratios) const override {
    std::vector<float>& rows = static_cast<Memory*>(workspace)->rows;
    const PositionView& view = pose.view;
    SkylineRows(view.skyline,
                view.visible.first_azimuth,
                view.visible.azimuth_step,
                camera_,
                pose.cam_from_local,
                rows);
    log_ratios[0] = static_cast<float>(SkyLogRatio(table_, rows));
  }

 private:
  struct Memory final : Workspace {
    std::vector<float> rows;  // of the model's skyline, by column
  };

  cv::Mat log_odds_;
  SkyTableOptions options_;
  SkyTable table_;
  PinholeCamera camera_;
};

constexpr CueName kSkyNames[] = {{"sky", 4.44}};

}  // namespace

extern const CuePlugin kSkyCue;
constinit const CuePlugin kSkyCue = {
    .names = kSkyNames,
    .parts = {.edges_and_skyline = true, .surfaces = false},
    .declare = [](OptionGroups& options) { options.Add<SkyTableOptions>("sky"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      return std::make_shared<SkyCue>(
          SkyLogOddsOf(c.picture), c.picture.camera(), c.options.Get<SkyTableOptions>());
    }};

}  // namespace ridgeline
