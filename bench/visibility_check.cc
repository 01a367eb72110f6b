// SPDX-License-Identifier: Apache-2.0
// Exact visibility of edges against rays, on samples of a dataset's model:
//   visibility_check DATASET.json [--samples 1000000] [--positions 2000] [--seed 1]
// Every difference is explained or printed: at the end of a visible part, at the tolerance of surfaces,
// at the lowered terrain's edge, or on an edge both of whose faces look away.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "city/terrain.h"
#include "input/dataset.h"
#include "input/world.h"
#include "projection/ray_visibility.h"
#include "projection/scene.h"

namespace ridgeline {
namespace {

constexpr double kEyeM = 1.6;
constexpr double kReachM = 200.0;
// Floats hold positions a kilometre from the origin to 0.06 mm; parts' ends are that and the angle of
// grazing rays off.
constexpr double kEndM = 0.02;
constexpr double kDepthM = 0.005;
constexpr double kTerrainM = 0.05;
constexpr double kFacingM = 0.06;

enum Kind { kAgree, kAtEnd, kAtTolerance, kAtTerrain, kLooksAway, kUnexplained, kKinds };
constexpr const char* kKindNames[] = {"agree",
                                      "differ at the end of a visible part",
                                      "differ at the tolerance of surfaces",
                                      "differ at the edge of the terrain",
                                      "differ on edges that look away",
                                      "differ, unexplained"};

struct Part {
  double first, last;
};

class Checker {
 public:
  Checker(const CityModel& model, const HeightGrid* dtm, const ProjectionOptions& options)
      : model_(model), options_(options), scene_(model, dtm, options), rays_(model, dtm, options) {}

  // Counts `samples` of edges seen from one place.
  std::array<std::uint64_t, kKinds> From(const Eigen::Vector3d& eye, int samples, Random random) {
    std::array<std::uint64_t, kKinds> counts{};
    const VisibleSet visible = scene_.VisibleFrom(eye, Sector{});
    std::vector<std::uint32_t> near;
    for (std::size_t e = 0; e < model_.feature_edges.size(); ++e) {
      const FeatureEdge& edge = model_.feature_edges[e];
      const bool is_near = (0.5 * (edge.a + edge.b) - eye).norm() < kReachM;
      if (is_near && (edge.b - edge.a).norm() > 0.05) near.push_back(static_cast<std::uint32_t>(e));
    }
    if (near.empty()) return counts;
    for (int i = 0; i < samples; ++i) {
      const std::uint32_t e = near[random.Below(near.size())];
      ++counts[Compare(eye, e, random.Uniform(0.0, 1.0), visible)];
    }
    return counts;
  }

 private:
  Kind Compare(const Eigen::Vector3d& eye, std::uint32_t e, double t, const VisibleSet& visible) {
    const FeatureEdge& edge = model_.feature_edges[e];
    const Eigen::Vector3d along = edge.b - edge.a;
    const double length = along.norm();
    const Eigen::Vector3d point = edge.a + t * along;
    bool exact = false;
    double to_end_m = 1e9;
    const auto first = std::lower_bound(
        visible.pieces.begin(), visible.pieces.end(), e, [](const VisiblePiece& p, std::uint32_t i) {
          return p.edge < i;
        });
    for (auto it = first; it != visible.pieces.end() && it->edge == e; ++it) {
      const double a = along.dot(it->a.cast<double>() - edge.a) / (length * length);
      const double b = along.dot(it->b.cast<double>() - edge.a) / (length * length);
      exact = exact || (t >= std::min(a, b) && t <= std::max(a, b));
      to_end_m = std::min({to_end_m, std::abs(t - a) * length, std::abs(t - b) * length});
    }
    const RayVisibility::Seen seen = rays_.Look(eye, point);
    if (seen.visible == exact) return kAgree;
    // The ends of hidden parts move fast where the hiding outline runs along the edge.
    const double grazing = 1.0 / std::max(0.02, Sine(eye, point, along));
    if (to_end_m < kEndM * grazing) return kAtEnd;
    if (std::abs(seen.depth_m - options_.surface_tolerance_m) < kDepthM) return kAtTolerance;
    for (const double lift : {-kTerrainM, kTerrainM}) {
      const RayVisibility::Seen moved = rays_.Look(eye, point + Eigen::Vector3d(0.0, 0.0, lift));
      if (moved.by_terrain != seen.by_terrain) return kAtTerrain;
    }
    if (!exact && LooksAway(edge, eye)) return kLooksAway;
    Report(eye, e, t, exact, seen);
    return kUnexplained;
  }

  static double Sine(const Eigen::Vector3d& eye,
                     const Eigen::Vector3d& point,
                     const Eigen::Vector3d& along) {
    return (point - eye).normalized().cross(along.normalized()).norm();
  }

  bool LooksAway(const FeatureEdge& edge, const Eigen::Vector3d& eye) const {
    for (const std::uint32_t surface : {edge.surface0, edge.surface1}) {
      if (surface == kNoSurface) return false;
      if (model_.surfaces[surface].normal.cast<double>().dot(eye - edge.a) > kFacingM) return false;
    }
    return true;
  }

  void Report(const Eigen::Vector3d& eye,
              std::uint32_t e,
              double t,
              bool exact,
              const RayVisibility::Seen& seen) {
    if (++reported_ > 20) return;
    const std::scoped_lock lock(mutex_);
    std::printf("unexplained: eye %.2f %.2f %.2f, edge %u at %.4f: exact %s, rays %s (depth %.4f m%s)\n",
                eye.x(), eye.y(), eye.z(), e, t, exact ? "visible" : "hidden",
                seen.visible ? "visible" : "hidden", seen.depth_m,
                seen.by_terrain ? ", terrain" : "");
  }

  const CityModel& model_;
  const ProjectionOptions options_;
  const Scene scene_;
  const RayVisibility rays_;
  std::atomic<int> reported_{0};
  std::mutex mutex_;
};

int Run(const std::string& file, long samples, long positions, std::uint64_t seed) {
  WorldRequest request = RequestFor(ReadDataset(file), 100.0);
  request.whole_model = true;
  request.needs_terrain = true;
  const World world = ReadWorld(request);
  const CityModel& model = world.model;
  ProjectionOptions options;
  options.min_piece_mrad = 0.0;  // short parts are dropped by their angle, not by visibility
  Checker checker(model, &*world.dtm, options);
  const Footprints footprints(model);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& v : model.vertices) box.extend(Eigen::Vector2d(v.head<2>()));
  std::vector<Eigen::Vector3d> eyes;
  Random places(seed, 0, 0);
  for (long tries = 0; static_cast<long>(eyes.size()) < positions && tries < 100 * positions; ++tries) {
    const Eigen::Vector2d xy(places.Uniform(box.min().x(), box.max().x()),
                             places.Uniform(box.min().y(), box.max().y()));
    const auto ground = world.dtm->HeightAt(xy);
    if (ground && !footprints.Contains(xy)) eyes.emplace_back(xy.x(), xy.y(), *ground + kEyeM);
  }
  if (eyes.empty()) {
    std::fprintf(stderr, "no place for an eye in %s\n", file.c_str());
    return 2;
  }
  const int each = static_cast<int>((samples + static_cast<long>(eyes.size()) - 1) /
                                    static_cast<long>(eyes.size()));
  std::vector<std::array<std::uint64_t, kKinds>> counts(eyes.size());
  ParallelFor(eyes.size(), 0, [&](std::size_t i) {
    counts[i] = checker.From(eyes[i], each, Random(seed, 1, i));
  });
  std::array<std::uint64_t, kKinds> sum{};
  std::uint64_t total = 0;
  for (const auto& one : counts) {
    for (int k = 0; k < kKinds; ++k) sum[static_cast<std::size_t>(k)] += one[static_cast<std::size_t>(k)];
  }
  for (const std::uint64_t n : sum) total += n;
  std::printf("%s: %zu places, %llu samples\n", file.c_str(), eyes.size(),
              static_cast<unsigned long long>(total));
  for (std::size_t k = 0; k < kKinds; ++k) {
    std::printf("  %-38s %10llu  %8.4f %%\n", kKindNames[k],
                static_cast<unsigned long long>(sum[k]),
                100.0 * static_cast<double>(sum[k]) / static_cast<double>(std::max<std::uint64_t>(1, total)));
  }
  return sum[kUnexplained] == 0 ? 0 : 1;
}

}  // namespace
}  // namespace ridgeline

int main(int argc, char** argv) {
  long samples = 1000000, positions = 2000;
  std::uint64_t seed = 1;
  std::string file;
  for (int i = 1; i < argc; ++i) {
    const auto value = [&]() { return i + 1 < argc ? std::atol(argv[++i]) : 0; };
    if (std::strcmp(argv[i], "--samples") == 0) {
      samples = value();
    } else if (std::strcmp(argv[i], "--positions") == 0) {
      positions = value();
    } else if (std::strcmp(argv[i], "--seed") == 0) {
      seed = static_cast<std::uint64_t>(value());
    } else {
      file = argv[i];
    }
  }
  if (file.empty() || samples <= 0 || positions <= 0) {
    std::fprintf(stderr, "usage: visibility_check DATASET.json [--samples N] [--positions N] [--seed K]\n");
    return 2;
  }
  try {
    return ridgeline::Run(file, samples, positions, seed);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
