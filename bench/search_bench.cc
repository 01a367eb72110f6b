// SPDX-License-Identifier: Apache-2.0
// Where a localization spends its time, stage by stage, on one thread: a picture's lines and
// fields, a look from a place, poses at a place looked from, the map and the refinement, for a
// narrow box and one like a phone's. The town and its picture are made here.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "localize/localizer_options.h"
#include "localize/search_poses.h"
#include "score/score_table.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{4000, 3000, 3100.0, 3100.0, 2000.0, 1500.0};

// Sky, ground and the houses in flat shades of their own, with windows' worth of noise.
cv::Mat PictureOf(const Scene& scene, const Pose& cam_from_local) {
  const PinholeCamera small = kCamera.Scaled(0.25);
  const ViewBuffers buffers = scene.Render(small, cam_from_local);
  cv::Mat picture(small.height, small.width, CV_8UC3, cv::Scalar(235, 215, 190));
  picture.rowRange(small.height / 2, small.height).setTo(cv::Scalar(70, 75, 80));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::uint32_t surface =
          buffers.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
      if (surface == kNoSurface) continue;
      const Surface& s = scene.model().surfaces[surface];
      const int window = (x / 9 + y / 13) % 3 == 0 ? 25 : 0;
      const auto shade = static_cast<unsigned char>(
          110.0f + 40.0f * s.normal.x() + 7.0f * static_cast<float>(s.building % 5) - window);
      picture.at<cv::Vec3b>(y, x) = {
          shade, static_cast<unsigned char>(shade + s.building % 7), shade};
    }
  }
  cv::Mat full;
  cv::resize(picture, full, cv::Size(kCamera.width, kCamera.height), 0.0, 0.0, cv::INTER_LINEAR);
  return full;
}

struct World {
  CityModel model = testing::MakeCity(testing::TownHouses(10, 10, 3));
  Footprints footprints{model};
  Scene scene{model, nullptr, ProjectionOptions{}};
  Pose truth{CamFromWorld(ViewAngles{24.0, 6.0, 1.0}), {300.0, 331.0, 1.7}};
  cv::Mat picture = PictureOf(scene, truth);
  LocalizerOptions options;
  PictureEvidence evidence{picture, kCamera, options.lines, options.score.evidence, 1};
  std::unique_ptr<Score> score = MakeScore({evidence, scene, options.score});
};

const World& TheWorld() {
  static const World world;
  return world;
}

// A box of half sizes around a prior beside the truth.
PoseSpace SpaceOf(const World& world, double place_m, double heading_deg, double tilt_deg) {
  PosePrior prior;
  prior.position_in_world = world.truth.center_in_world.head<2>() + Eigen::Vector2d(3.3, -2.1);
  prior.height_in_world = world.truth.center_in_world.z();
  prior.heading_deg = 24.0 + 0.3 * heading_deg;
  prior.pitch_deg = 6.0;
  prior.roll_deg = 1.0;
  PoseSpaceOptions ranges;
  ranges.east_m = ranges.north_m = place_m;
  ranges.height_m = tilt_deg > 0.0 ? 1.0 : 0.0;
  ranges.heading_deg = heading_deg;
  ranges.pitch_deg = ranges.roll_deg = tilt_deg;
  return PoseSpace(prior, ranges, world.scene, nullptr, world.footprints);
}

PoseScorer ScorerOf(const World& world, const PoseSpace& space) {
  return PoseScorer(*world.score,
                    world.scene,
                    space,
                    world.evidence.camera(),
                    world.options.score.evidence.surface_step_deg);
}

void LinesAndFields(benchmark::State& state) {
  const World& world = TheWorld();
  for (auto _ : state) {
    const PictureEvidence evidence(
        world.picture, kCamera, world.options.lines, world.options.score.evidence, 1);
    benchmark::DoNotOptimize(evidence.segments().size());
  }
}
BENCHMARK(LinesAndFields)->Unit(benchmark::kMillisecond);

void LookFromAPlace(benchmark::State& state) {
  const World& world = TheWorld();
  const auto heading_deg = static_cast<double>(state.range(0));
  const PoseSpace space = SpaceOf(world, 10.0, heading_deg, 0.0);
  const PoseScorer scorer = ScorerOf(world, space);
  PoseScorer::Look look(scorer);
  const PanoramaRange range = scorer.RangeAround(space.center_angles(), {heading_deg, 0.0, 0.0});
  int i = 0;
  for (auto _ : state) {
    const Eigen::Vector3d shift(0.37 * (++i % 20), 0.0, 0.0);
    look.From(world.truth.center_in_world + shift, range);
    benchmark::DoNotOptimize(look.view().surfaces.surfaces.data());
  }
}
BENCHMARK(LookFromAPlace)->Arg(20)->Arg(180)->Unit(benchmark::kMillisecond);

void PosesAtAPlace(benchmark::State& state) {
  const World& world = TheWorld();
  const PoseSpace space = SpaceOf(world, 10.0, 20.0, 0.0);
  const PoseScorer scorer = ScorerOf(world, space);
  std::vector<PoseSpace::Offset> offsets(41);
  for (int i = 0; i < 41; ++i) offsets[i].heading_deg = i - 20.0;
  const Orientations orientations = scorer.OrientationsOf(offsets);
  PoseScorer::Look look(scorer);
  look.From(world.truth.center_in_world, scorer.RangeOver(offsets));
  for (auto _ : state) benchmark::DoNotOptimize(look.LogRatios(orientations).data());
  state.SetItemsProcessed(state.iterations() * 41);
}
BENCHMARK(PosesAtAPlace)->Unit(benchmark::kMicrosecond);

void Search(benchmark::State& state, double place_m, double heading_deg, double tilt_deg) {
  const World& world = TheWorld();
  const PoseSpace space = SpaceOf(world, place_m, heading_deg, tilt_deg);
  const PoseScorer scorer = ScorerOf(world, space);
  std::uint64_t evaluations = 0;
  for (auto _ : state) {
    SearchedPoses found = SearchPoses(scorer, world.evidence, world.options.search, 1, 1);
    evaluations = found.evaluations + RefineModes(scorer, 1, found);
  }
  state.counters["poses"] = static_cast<double>(evaluations);
}
BENCHMARK_CAPTURE(Search, narrow, 10.0, 20.0, 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Search, phone, 20.0, 180.0, 8.0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ridgeline

