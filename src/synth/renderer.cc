// SPDX-License-Identifier: Apache-2.0
#include "synth/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "projection/triangle_scene.h"
#include "synth/detail_mesh.h"
#include "synth/paint.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kOcclusionReachM = 7.0f;
constexpr float kHazeM = 2500.0f;
const Vector3f kSunLight(2.1f, 1.95f, 1.7f);

// Orthonormal directions around a normal (Duff et al. 2017).
void Tangents(const Vector3f& n, Vector3f& t, Vector3f& b) {
  const float sign = std::copysign(1.0f, n.z());
  const float a = -1.0f / (sign + n.z());
  const float c = n.x() * n.y() * a;
  t = Vector3f(1.0f + sign * n.x() * n.x() * a, sign * c, -sign * n.x());
  b = Vector3f(c, sign + n.y() * n.y() * a, -n.y());
}

// Two uniform numbers of a sample of a pixel.
Vector2f PixelSample(std::uint64_t pixel, std::uint64_t sample, std::uint64_t purpose) {
  const std::uint64_t bits =
      MixBits(MixBits(pixel * 16 + sample) + purpose * 0x9E3779B97F4A7C15ull);
  return {static_cast<float>(bits >> 40) * 0x1p-24f,
          static_cast<float>((bits >> 8) & 0xFFFFFF) * 0x1p-24f};
}

}  // namespace

struct TownRenderer::Impl {
  Impl(const Town& t, double overhang_m) : town(t) {
    AddBuildings(town, overhang_m, mesh);
    AddGround(town, mesh);
    AddStreetLife(town, mesh);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const DetailTriangle& triangle : mesh.triangles) triangles.push_back(triangle.vertices);
    scene.emplace(mesh.vertices, triangles);
  }

  Paint PaintAt(const DetailTriangle& triangle,
                const TriangleHit& hit,
                const Vector3f& point) const {
    switch (triangle.material) {
      case Material::kFacade: {
        const Vector2f uv = (1.0f - hit.u - hit.v) * mesh.uv[triangle.vertices[0]] +
                            hit.u * mesh.uv[triangle.vertices[1]] +
                            hit.v * mesh.uv[triangle.vertices[2]];
        return PaintFacade(mesh.walls[triangle.wall], uv);
      }
      case Material::kRoof:
        return PaintRoof(triangle.color, point);
      case Material::kGround:
        return PaintGround(town, point);
      case Material::kGlossy:
        return {triangle.color, 0.18f};
      default:
        return {triangle.color, 0.0f};
    }
  }

  // Light towards the camera along one ray.
  Vector3f Radiance(const Vector3f& from,
                    const Vector3f& direction,
                    const Weather& weather,
                    const Vector2f& random) const {
    const std::optional<TriangleHit> hit = scene->Cast(from, direction);
    if (!hit) return SkyColor(weather, direction);
    const DetailTriangle& triangle = mesh.triangles[hit->triangle];
    Vector3f normal = hit->normal;
    if (normal.dot(direction) > 0.0f) normal = -normal;
    const float distance = hit->distance;
    const Vector3f point = from + distance * direction;
    const Vector3f start = point + (1e-3f + 2e-5f * distance) * normal;
    const Paint paint = PaintAt(triangle, *hit, point);

    Vector3f light =
        SkyLight(weather) * (0.55f + 0.45f * normal.z()) * Openness(start, normal, random);
    const float facing = triangle.material == Material::kLeaves
                             ? 0.5f + 0.5f * std::abs(normal.dot(weather.to_sun))
                             : normal.dot(weather.to_sun);
    if (weather.sun > 0.0f && facing > 0.0f &&
        !scene->IsBlocked(start, weather.to_sun, std::numeric_limits<float>::infinity())) {
      light += weather.sun * facing * kSunLight;
    }
    Vector3f color = paint.albedo.cwiseProduct(light);
    if (paint.mirror > 0.0f) {
      const Vector3f mirrored = direction - 2.0f * direction.dot(normal) * normal;
      // Near the horizon a pane mirrors the houses opposite.
      const float sky_share = std::clamp((mirrored.z() - 0.15f) * 5.0f, 0.0f, 1.0f);
      color += paint.mirror * (0.12f + 0.88f * sky_share) * SkyColor(weather, mirrored);
    }
    const Vector3f haze(0.72f, 0.78f, 0.85f);
    return haze + (color - haze) * std::exp(-distance / kHazeM);
  }

  // Share of sky light that is not blocked near by, from one cosine-distributed ray.
  float Openness(const Vector3f& start, const Vector3f& normal, const Vector2f& random) const {
    Vector3f tangent;
    Vector3f bitangent;
    Tangents(normal, tangent, bitangent);
    const float r = std::sqrt(random.x());
    const float turn = 2.0f * std::numbers::pi_v<float> * random.y();
    const Vector3f direction = r * std::cos(turn) * tangent + r * std::sin(turn) * bitangent +
                               std::sqrt(1.0f - random.x()) * normal;
    return scene->IsBlocked(start, direction, kOcclusionReachM) ? 0.35f : 1.0f;
  }

  const Town& town;
  DetailMesh mesh;
  std::optional<TriangleScene> scene;
};

TownRenderer::TownRenderer(const Town& town, double overhang_m)
    : impl_(std::make_unique<Impl>(town, overhang_m)) {}
TownRenderer::~TownRenderer() = default;

cv::Mat TownRenderer::Render(const CameraIntrinsics& camera,
                             const Pose& cam_from_local,
                             const Weather& weather,
                             int threads) const {
  const Eigen::Matrix3d world_from_cam =
      cam_from_local.cam_from_world.conjugate().toRotationMatrix();
  const Vector3f center = cam_from_local.center_in_world.cast<float>();
  const bool distorted = camera.HasDistortion();
  const PinholeCamera pinhole = camera.Pinhole();
  cv::Mat image(camera.height, camera.width, CV_32FC3);
  ParallelFor(static_cast<std::size_t>(camera.height), threads, [&](std::size_t y) {
    auto* row = image.ptr<cv::Vec3f>(static_cast<int>(y));
    for (int x = 0; x < camera.width; ++x) {
      const std::uint64_t pixel = y * static_cast<std::size_t>(camera.width) + x;
      Vector3f sum = Vector3f::Zero();
      for (int sample = 0; sample < 4; ++sample) {
        const Vector2f jitter = PixelSample(pixel, sample, 1);
        const Vector2d px(x + 0.5 * (sample % 2 + jitter.x()), y + 0.5 * (sample / 2 + jitter.y()));
        const Vector3d ray =
            distorted ? camera.Undistort(px).homogeneous().eval() : pinhole.RayFromImage(px);
        const Vector3f direction = (world_from_cam * ray).normalized().cast<float>();
        sum += impl_->Radiance(center, direction, weather, PixelSample(pixel, sample, 2));
      }
      row[x] = cv::Vec3f(0.25f * sum.x(), 0.25f * sum.y(), 0.25f * sum.z());
    }
  });
  return image;
}

ViewStatistics TownRenderer::Probe(const CameraIntrinsics& camera,
                                   const Pose& cam_from_local) const {
  constexpr int kRays = 32;
  const PinholeCamera pinhole = camera.Pinhole();
  ViewStatistics statistics;
  statistics.nearest_m = 1e9;
  std::vector<double> building_m;
  std::map<std::uint64_t, int> rays_of_building;
  for (int x = 0; x < kRays; ++x) {
    bool sky_above = false;
    bool skyline = false;
    for (int y = 0; y < kRays; ++y) {
      const Vector2d px((x + 0.5) * camera.width / kRays, (y + 0.5) * camera.height / kRays);
      const Vector3d ray = cam_from_local.cam_from_world.conjugate() * pinhole.RayFromImage(px);
      const std::optional<TriangleHit> hit = impl_->scene->Cast(
          cam_from_local.center_in_world.cast<float>(), ray.normalized().cast<float>());
      if (!hit) {
        statistics.sky_share += 1.0 / (kRays * kRays);
        sky_above = true;
        continue;
      }
      const DetailTriangle& triangle = impl_->mesh.triangles[hit->triangle];
      const double distance = hit->distance;
      if (triangle.material != Material::kGround) {
        statistics.nearest_m = std::min(statistics.nearest_m, distance);
      }
      const bool facade = triangle.material == Material::kFacade;
      if (facade) ++rays_of_building[impl_->mesh.walls[triangle.wall].look];
      if (!facade && triangle.material != Material::kRoof) continue;
      building_m.push_back(distance);
      skyline = skyline || sky_above;
    }
    if (skyline) statistics.skyline_share += 1.0 / kRays;
  }
  statistics.building_share = static_cast<double>(building_m.size()) / (kRays * kRays);
  for (const auto& [look, rays] : rays_of_building) {
    if (rays >= kRays * kRays / 100) ++statistics.buildings;
  }
  if (!building_m.empty()) {
    const auto middle = building_m.begin() + static_cast<long>(building_m.size() / 2);
    std::nth_element(building_m.begin(), middle, building_m.end());
    statistics.median_building_m = *middle;
  }
  return statistics;
}

}  // namespace ridgeline
