// SPDX-License-Identifier: Apache-2.0
#include "augment/insertion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "base/angle.h"
#include "base/error.h"
#include "base/parallel.h"

namespace ridgeline {
namespace {

constexpr int kStripRows = 16;
// Shadow rays begin this far off their surface [m].
constexpr double kOffM = 0.03;
constexpr int kHatchPx = 6;

// A part of a camera's picture as a camera of its own.
PinholeCamera Cropped(const PinholeCamera& camera, const cv::Rect& part) {
  PinholeCamera cropped = camera;
  cropped.width = part.width;
  cropped.height = part.height;
  cropped.cx -= part.x;
  cropped.cy -= part.y;
  return cropped;
}

// Where the mesh can be in the picture.
cv::Rect OutlineOf(const TexturedMesh& mesh, const PinholeCamera& camera, const Pose& pose) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  Eigen::AlignedBox2d seen;
  const cv::Rect whole(0, 0, camera.width, camera.height);
  bool before = false, behind = false;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d corner =
        box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    const Eigen::Vector3d p = pose.CameraFromWorld(corner);
    constexpr double kNearM = 0.1;
    (p.z() > kNearM ? before : behind) = true;
    if (p.z() > kNearM) seen.extend(camera.ImageFromCamera(p));
  }
  if (!before) return {};
  if (behind) return whole;
  const Eigen::Vector2d least = seen.min().cwiseMax(-1e6).cwiseMin(1e6);
  const Eigen::Vector2d most = seen.max().cwiseMax(-1e6).cwiseMin(1e6);
  const cv::Point first(static_cast<int>(std::floor(least.x())), static_cast<int>(std::floor(least.y())));
  const cv::Point last(static_cast<int>(std::ceil(most.x())), static_cast<int>(std::ceil(most.y())));
  return cv::Rect(first, last) & whole;
}

Eigen::Vector3f Barycentric(const TexturedMesh& mesh, std::uint32_t face, const Eigen::Vector3d& p) {
  const auto& v = mesh.faces[face].vertices;
  const Eigen::Vector3d a = mesh.vertices[v[1]] - mesh.vertices[v[0]];
  const Eigen::Vector3d b = mesh.vertices[v[2]] - mesh.vertices[v[0]];
  const Eigen::Vector3d c = p - mesh.vertices[v[0]];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), ca = c.dot(a), cb = c.dot(b);
  const double area = aa * bb - ab * ab;
  if (area <= 0.0) return {1.0f, 0.0f, 0.0f};
  const double s = (bb * ca - ab * cb) / area, t = (aa * cb - ab * ca) / area;
  return Eigen::Vector3d(1.0 - s - t, s, t).cast<float>();
}

Eigen::Vector3d NormalAt(const ViewBuffers& view, int x, int y) {
  const cv::Vec3f& n = view.normals.at<cv::Vec3f>(y, x);
  return {n[0], n[1], n[2]};
}

}  // namespace

// Rows of the picture that one thread draws.
struct Inserter::Strip {
  cv::Rect part;  // of the picture
  const PinholeCamera& camera;
  const Pose& pose;
  const InsertionOptions& options;
  const cv::Mat& photo;
  const cv::Mat& foreground;
  bool has_sun;

  // Point that a pixel of a view of the part shows at a depth.
  Eigen::Vector3d PointAt(const PinholeCamera& of_part, int x, int y, float depth) const {
    return pose.center_in_world + pose.cam_from_world.conjugate() *
                                      (of_part.RayFromImage({x + 0.5, y + 0.5}) * depth);
  }
};

void InsertionOptions::Validate() const {
  const auto require = [](bool ok, const char* option, double value, const char* expected) {
    if (!ok) throw InputError(option, "", std::to_string(value), expected);
  };
  require(samples >= 1 && samples <= 8, "--samples", samples, "1 to 8");
  require(opacity > 0.0 && opacity <= 1.0, "--opacity", opacity, "(0, 1]");
  require(reveal >= 0.0 && reveal <= 1.0, "--reveal", reveal, "[0, 1]");
  require(ambient >= 0.0 && ambient <= 1.0, "--ambient", ambient, "[0, 1]");
}

Eigen::Vector3d Towards(double azimuth_deg, double elevation_deg) {
  const double level = std::cos(elevation_deg * kRadPerDeg);
  return {level * std::sin(azimuth_deg * kRadPerDeg),
          level * std::cos(azimuth_deg * kRadPerDeg),
          std::sin(elevation_deg * kRadPerDeg)};
}

Inserter::Inserter(const Scene& city, const TexturedMesh& mesh)
    : city_(city), mesh_(mesh), ray_model_(RayModelOf(mesh)), building_(ray_model_, TerrainMesh{}) {}

bool Inserter::InShadow(const Eigen::Vector3d& point,
                        const Eigen::Vector3d& normal,
                        const Eigen::Vector3d& towards_sun) const {
  const Eigen::Vector3d from = point + kOffM * normal;
  return building_.Cast(from.cast<float>(), towards_sun.cast<float>()).has_value() ||
         city_.Raycast(from, towards_sun).has_value();
}

void Inserter::DrawStrip(const Strip& strip,
                         cv::Mat& picture,
                         cv::Mat& coverage,
                         cv::Mat& counts) const {
  const InsertionOptions& o = strip.options;
  const int n = o.samples;
  const PinholeCamera fine = Cropped(strip.camera, strip.part).Scaled(n);
  const ViewBuffers near = building_.Render(fine, strip.pose, true);
  if (std::none_of(near.surfaces.begin(), near.surfaces.end(), [](std::uint32_t s) {
        return s != kNoSurface;
      })) {
    return;
  }
  const ViewBuffers around = city_.Render(fine, strip.pose, false);
  const float per_sample = 1.0f / static_cast<float>(n * n);
  for (int y = 0; y < strip.part.height; ++y) {
    for (int x = 0; x < strip.part.width; ++x) {
      const cv::Point at(strip.part.x + x, strip.part.y + y);
      const float free =
          strip.foreground.empty() ? 1.0f : 1.0f - strip.foreground.at<std::uint8_t>(at) / 255.0f;
      cv::Vec3f colour(0.0f, 0.0f, 0.0f);
      float weight = 0.0f, shown = 0.0f;
      int outline = 0;
      for (int k = 0; k < n * n; ++k) {
        const int fx = x * n + k % n, fy = y * n + k / n;
        const float depth = near.depth.at<float>(fy, fx);
        if (!std::isfinite(depth)) continue;
        ++outline;
        const bool hidden = depth > around.depth.at<float>(fy, fx);
        const bool hatched = (at.x + at.y) / kHatchPx % 2 == 0;
        if (hidden && (o.reveal == 0.0 || !hatched)) continue;
        const std::uint32_t face = near.surfaces[static_cast<std::size_t>(fy) * fine.width + fx];
        const Eigen::Vector3d point = strip.PointAt(fine, fx, fy, depth);
        const Eigen::Vector3d normal = NormalAt(near, fx, fy);
        double lit = strip.has_sun ? std::max(0.0, normal.dot(o.towards_sun)) : 0.0;
        if (lit > 0.0 && o.shadows && InShadow(point, normal, o.towards_sun)) lit = 0.0;
        const cv::Vec4f own = ColourAt(mesh_, face, Barycentric(mesh_, face, point));
        const auto light = static_cast<float>(o.ambient + (1.0 - o.ambient) * lit);
        const float alpha = static_cast<float>(hidden ? o.reveal : o.opacity) * own[3] * per_sample *
                            (hidden ? 1.0f : free);
        colour += alpha * light * cv::Vec3f(own[0], own[1], own[2]);
        weight += alpha;
        if (!hidden) shown += per_sample * free;
      }
      counts.at<cv::Vec2f>(at) = {static_cast<float>(outline) * per_sample, shown};
      if (weight == 0.0f) continue;
      coverage.at<std::uint8_t>(at) = cv::saturate_cast<std::uint8_t>(255.0f * shown);
      cv::Vec3b& pixel = picture.at<cv::Vec3b>(at);
      const cv::Vec3f mixed = colour + (1.0f - weight) * cv::Vec3f(pixel);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(mixed[c]);
    }
  }
}

// What the sun reaches in the photo and would not any more.
void Inserter::ShadeSurroundings(const Strip& strip, cv::Mat& picture) const {
  const InsertionOptions& o = strip.options;
  const PinholeCamera camera = Cropped(strip.camera, strip.part);
  const ViewBuffers view = city_.Render(camera, strip.pose, true);
  const Eigen::Vector3f sun = o.towards_sun.cast<float>();
  for (int y = 0; y < strip.part.height; ++y) {
    for (int x = 0; x < strip.part.width; ++x) {
      const float depth = view.depth.at<float>(y, x);
      if (!std::isfinite(depth)) continue;
      const Eigen::Vector3d normal = NormalAt(view, x, y);
      const double lit = normal.dot(o.towards_sun);
      if (lit <= 0.0) continue;
      const Eigen::Vector3d from = strip.PointAt(camera, x, y, depth) + kOffM * normal;
      if (!building_.Cast(from.cast<float>(), sun)) continue;
      if (city_.Raycast(from, o.towards_sun)) continue;  // in shadow already
      const auto left = static_cast<float>(o.ambient / (o.ambient + (1.0 - o.ambient) * lit));
      cv::Vec3b& pixel = picture.at<cv::Vec3b>(strip.part.y + y, strip.part.x + x);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(left * pixel[c]);
    }
  }
}

Insertion Inserter::Insert(const cv::Mat& photo,
                           const PinholeCamera& camera,
                           const Pose& cam_from_local,
                           const InsertionOptions& options,
                           const cv::Mat& foreground) const {
  options.Validate();
  Insertion result;
  result.picture = photo.clone();
  result.coverage = cv::Mat::zeros(photo.size(), CV_8U);
  cv::Mat counts = cv::Mat::zeros(photo.size(), CV_32FC2);  // outline, shown
  const bool has_sun = options.towards_sun.z() > 0.0;
  const auto in_strips = [&](const cv::Rect& area, const auto& draw) {
    const auto strips = static_cast<std::size_t>((area.height + kStripRows - 1) / kStripRows);
    ParallelFor(strips, options.threads, [&](std::size_t i) {
      const int first = area.y + static_cast<int>(i) * kStripRows;
      const cv::Rect part(
          area.x, first, area.width, std::min(kStripRows, area.y + area.height - first));
      draw(Strip{part, camera, cam_from_local, options, photo, foreground, has_sun});
    });
  };
  const cv::Rect whole(0, 0, photo.cols, photo.rows);
  if (options.shadows && has_sun) {
    in_strips(whole, [&](const Strip& strip) { ShadeSurroundings(strip, result.picture); });
  }
  const cv::Rect outline = OutlineOf(mesh_, camera, cam_from_local);
  if (!outline.empty()) {
    in_strips(outline, [&](const Strip& strip) {
      DrawStrip(strip, result.picture, result.coverage, counts);
    });
  }
  const cv::Scalar sums = cv::sum(counts);
  result.visible_share = sums[1] / static_cast<double>(photo.total());
  if (sums[0] > 0.0) result.hidden_share = 1.0 - sums[1] / sums[0];
  return result;
}

}  // namespace ridgeline
