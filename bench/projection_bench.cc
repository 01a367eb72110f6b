// SPDX-License-Identifier: Apache-2.0
// Visible edges from a position against the paper's z-buffer and a plain depth buffer; the cost of
// a model's size; orientations at a known position; threads. The Munich model is read from
// ../shared/data; without it a town of like size takes its place.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>

#include "base/random.h"
#include "city/read_city.h"
#include "city/terrain.h"
#include "projection/scene.h"
#include "projection/surface_panorama.h"
#include "projection/zbuffer_hough.h"
#include "support/source_folder.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr PinholeCamera kCamera{1280, 1068, 1237.6, 1237.6, 639.5, 538.5};
constexpr PinholeCamera kSmallCamera{320, 240, 309.4, 309.4, 160.0, 120.0};

struct World {
  // Behind pointers: the scene keeps the model's address.
  std::unique_ptr<const CityModel> model;
  std::unique_ptr<const HeightGrid> dtm;
  std::unique_ptr<Scene> scene;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  ViewAngles angles;

  Pose PoseAt(const Eigen::Vector3d& center) const { return {CamFromWorld(angles), center}; }
  Sector LookingAhead() const { return {angles.heading_deg * kDegree, std::numbers::pi / 3.0}; }
};

World Town(int blocks) {
  World world;
  world.model =
      std::make_unique<CityModel>(testing::MakeCity(testing::TownHouses(blocks, blocks, 1)));
  const double middle = std::floor(blocks / 2.0) * testing::kBlockPitch;
  world.position = {middle, middle, 1.7};
  world.angles = {60.0, 3.0, 1.0};
  world.scene = std::make_unique<Scene>(*world.model, nullptr, ProjectionOptions{});
  return world;
}

World Munich(bool with_terrain) {
  const std::filesystem::path folder = std::string(kSourceFolder) + "/../shared/data/munich";
  if (!std::filesystem::exists(folder)) return Town(14);
  World world;
  world.model = std::make_unique<CityModel>(
      ReadCity({folder / "tum_campus_lod2.gml", folder / "tum_south_lod2.gml"}, {}));
  world.position = Eigen::Vector3d(690904.0, 5335937.0, 517.4) - world.model->origin_in_world;
  world.angles = {118.0, -10.0, 3.4};
  if (with_terrain) {
    std::vector<std::string> warnings;
    const Eigen::Vector2d here = world.position.head<2>();
    world.dtm = std::make_unique<HeightGrid>(
        ReadDtm(folder / "dtm.tif", *world.model, here, here, 400.0, warnings));
  }
  world.scene = std::make_unique<Scene>(*world.model, world.dtm.get(), ProjectionOptions{});
  return world;
}

const World& MunichWorld() {
  static const World world = Munich(false);
  return world;
}

const World& MunichWithTerrain() {
  static const World world = Munich(true);
  return world;
}

// Positions of a dense search: a 1 m grid of +-10 m.
Eigen::Vector3d GridPosition(const World& world, std::size_t i) {
  return world.position + Eigen::Vector3d(static_cast<double>(i % 21) - 10.0,
                                          static_cast<double>(i / 21 % 21) - 10.0,
                                          0.0);
}

void NewPositions(benchmark::State& state, const World& world) {
  std::size_t i = 0;
  std::size_t pieces = 0;
  for (auto _ : state) {
    const VisibleSet set = world.scene->VisibleFrom(GridPosition(world, i++), world.LookingAhead());
    pieces += set.pieces.size();
    benchmark::DoNotOptimize(set.skyline_elevation.data());
  }
  state.counters["pieces"] = benchmark::Counter(
      static_cast<double>(pieces) / static_cast<double>(i), benchmark::Counter::kAvgThreads);
  state.counters["triangles"] = benchmark::Counter(
      static_cast<double>(world.model->triangles.size()), benchmark::Counter::kAvgThreads);
}

void VisibleEdgesMunich(benchmark::State& state) { NewPositions(state, MunichWorld()); }
BENCHMARK(VisibleEdgesMunich)->Unit(benchmark::kMillisecond);
BENCHMARK(VisibleEdgesMunich)->Unit(benchmark::kMillisecond)->Threads(2)->UseRealTime();

void VisibleEdgesMunichTerrain(benchmark::State& state) {
  NewPositions(state, MunichWithTerrain());
}
BENCHMARK(VisibleEdgesMunichTerrain)->Unit(benchmark::kMillisecond);

void SkylineMunichTerrain(benchmark::State& state) {
  const World& world = MunichWithTerrain();
  std::size_t i = 0;
  for (auto _ : state) {
    const VisibleSet set = world.scene->SkylineFrom(GridPosition(world, i++), world.LookingAhead());
    benchmark::DoNotOptimize(set.skyline_elevation.data());
  }
}
BENCHMARK(SkylineMunichTerrain)->Unit(benchmark::kMillisecond);

// As the scores use it: 120 x 60 degrees at 0.02 rad.
void SurfacePanoramaMunich(benchmark::State& state) {
  const World& world = MunichWorld();
  const Sector ahead = world.LookingAhead();
  const PanoramaRange range{{ahead.center, ahead.half_width, -0.5, 0.5}, 0.02};
  std::size_t i = 0;
  for (auto _ : state) {
    const SurfacePanorama panorama = SurfacesFrom(*world.scene, GridPosition(world, i++), range);
    benchmark::DoNotOptimize(panorama.surfaces.data());
  }
}
BENCHMARK(SurfacePanoramaMunich)->Unit(benchmark::kMillisecond);

void ZbufferHoughMunich(benchmark::State& state) {
  const World& world = MunichWorld();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ZbufferHoughSegments(
        *world.model, kCamera, world.PoseAt(GridPosition(world, i++)), ZbufferHoughOptions{}));
  }
}
BENCHMARK(ZbufferHoughMunich)->Unit(benchmark::kMillisecond);

void DepthBuffer320x240Munich(benchmark::State& state) {
  const World& world = MunichWorld();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        world.scene->Render(kSmallCamera, world.PoseAt(GridPosition(world, i++))).depth.data);
  }
}
BENCHMARK(DepthBuffer320x240Munich)->Unit(benchmark::kMillisecond);

void OrientationAtKnownPositionMunich(benchmark::State& state) {
  const World& world = MunichWorld();
  const VisibleSet visible = world.scene->VisibleFrom(world.position, world.LookingAhead());
  std::vector<ProjectedSegment> segments;
  double heading_deg = 0.0;
  for (auto _ : state) {
    heading_deg = heading_deg > 40.0 ? 0.0 : heading_deg + 1.0;
    const Pose pose{CamFromWorld(ViewAngles{world.angles.heading_deg - 20.0 + heading_deg,
                                            world.angles.pitch_deg,
                                            world.angles.roll_deg}),
                    world.position};
    ProjectPieces(visible, kCamera, pose, segments);
    benchmark::DoNotOptimize(segments.data());
  }
  state.counters["segments"] = static_cast<double>(segments.size());
}
BENCHMARK(OrientationAtKnownPositionMunich)->Unit(benchmark::kMicrosecond);

// Towns of about 10 k, 20 k, 100 k and 1 M triangles.
void VisibleEdgesTown(benchmark::State& state) {
  const World world = Town(static_cast<int>(state.range(0)));
  NewPositions(state, world);
  state.counters["MB"] = static_cast<double>(world.scene->memory_bytes()) * 1e-6;
}
BENCHMARK(VisibleEdgesTown)->Unit(benchmark::kMillisecond)->Arg(10)->Arg(14)->Arg(31)->Arg(99);

// From above, where much is visible.
void VisibleEdgesTownFromAbove(benchmark::State& state) {
  World world = Town(31);
  world.position.z() = static_cast<double>(state.range(0));
  NewPositions(state, world);
}
BENCHMARK(VisibleEdgesTownFromAbove)->Unit(benchmark::kMillisecond)->Arg(20)->Arg(60);

void SceneOfTown(benchmark::State& state) {
  const CityModel model = testing::MakeCity(testing::TownHouses(31, 31, 1));
  for (auto _ : state) {
    const Scene scene(model, nullptr, {});
    benchmark::DoNotOptimize(scene.memory_bytes());
  }
}
BENCHMARK(SceneOfTown)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ridgeline
