// SPDX-License-Identifier: Apache-2.0
// One frame of the skyline matcher, whole process (extraction, clean-up, match), on one thread,
// with pictures of the paper's size and larger.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/core/utility.hpp>

#include "base/random.h"
#include "score/sky_score.h"
#include "support/synthetic_city.h"
#include "track/skyline_tracker.h"

namespace ridgeline {
namespace {

struct World {
  CityModel model = testing::MakeCity(testing::TownHouses(10, 10, 3));
  Scene scene{model, nullptr, ProjectionOptions{}};
  Pose truth{CamFromWorld(ViewAngles{20.0, 8.0, 1.0}), {300.0, 330.0, 1.6}};
  Pose start{CamFromWorld(ViewAngles{29.0, 7.0, 2.0}), {300.0, 330.0, 1.6}};
};

const World& TheWorld() {
  static const World world;
  return world;
}

PinholeCamera CameraOf(int width) {
  return PinholeCamera{640, 480, 560.0, 560.0, 320.0, 240.0}.Scaled(width / 640.0);
}

// Sky down to the model's skyline, walls with noise below.
cv::Mat Picture(int width) {
  const World& world = TheWorld();
  const PinholeCamera camera = CameraOf(width);
  std::vector<float> rows(static_cast<std::size_t>(width));
  SkylineRows(SkylineDirections(world.scene.SkylineFrom(world.truth.center_in_world, Sector{})),
              camera,
              world.truth.cam_from_world.toRotationMatrix().cast<float>(),
              rows);
  cv::Mat picture(camera.height, width, CV_8UC3);
  Random random(1, 0);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool sky = static_cast<float>(y) < rows[static_cast<std::size_t>(x)];
      const double noise = 3.0 * random.Normal();
      const bool window = (y / 20) % 3 == 1 && (x / 16) % 3 == 1;
      const cv::Vec3d color = sky ? cv::Vec3d(228, 215, 205)
                                  : (window ? cv::Vec3d(60, 58, 55) : cv::Vec3d(130, 150, 165));
      for (int c = 0; c < 3; ++c) {
        picture.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<std::uint8_t>(color[c] + noise);
      }
    }
  }
  return picture;
}

void ExtractPath(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat picture = Picture(static_cast<int>(state.range(0)));
  const SkylineOptions options =
      state.range(1) != 0 ? SkylineTrackOptions().skyline : SkylineOptions();
  for (auto _ : state) benchmark::DoNotOptimize(ExtractSkyline(picture, options));
}
BENCHMARK(ExtractPath)
    ->ArgNames({"width", "video"})
    ->Args({640, 1})
    ->Args({1280, 1})
    ->Args({640, 0})
    ->Args({1280, 0})
    ->Unit(benchmark::kMillisecond);

void ExtractCanny(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat picture = Picture(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(ExtractCannySkyline(picture, CannySkylineOptions{}));
}
BENCHMARK(ExtractCanny)->ArgName("width")->Arg(640)->Unit(benchmark::kMillisecond);

void Distance(benchmark::State& state) {
  const World& world = TheWorld();
  const SkylineL1 l1(
      ExtractSkyline(Picture(640), SkylineOptions{}), CameraOf(640), SkylineL1Options{});
  const auto directions =
      SkylineDirections(world.scene.SkylineFrom(world.truth.center_in_world, {0.35, 1.0}));
  const Eigen::Matrix3f rotation = world.truth.cam_from_world.toRotationMatrix().cast<float>();
  for (auto _ : state) benchmark::DoNotOptimize(l1.Distance(directions, rotation));
}
BENCHMARK(Distance)->Unit(benchmark::kMicrosecond);

void Frame(benchmark::State& state, const char* method) {
  cv::setNumThreads(1);
  const World& world = TheWorld();
  const int width = static_cast<int>(state.range(0));
  const cv::Mat picture = Picture(width);
  const PinholeCamera camera = CameraOf(width);
  SkylineTrackOptions options;
  options.start = "sensors";
  options.match.method = method;
  double before = 0.0, after = 0.0, error = 0.0;
  for (auto _ : state) {
    SkylineTracker tracker(world.scene, options);
    const SkylineFrame frame = tracker.Track(picture, camera, world.start);
    before = frame.match.distance_before_px;
    after = frame.match.distance_after_px;
    error = RotationDistanceDeg(frame.match.best.cam_from_world, world.truth.cam_from_world);
  }
  state.counters["l1_before_px"] = before;
  state.counters["l1_after_px"] = after;
  state.counters["error_deg"] = error;
}
BENCHMARK_CAPTURE(Frame, 2d, "2d")
    ->ArgName("width")
    ->Arg(640)
    ->Arg(1280)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Frame, 2x2d, "2x2d")
    ->ArgName("width")
    ->Arg(640)
    ->Arg(1280)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Frame, 3d, "3d")
    ->ArgName("width")
    ->Arg(640)
    ->Arg(1280)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Frame, 6dof, "6dof")->ArgName("width")->Arg(640)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ridgeline
