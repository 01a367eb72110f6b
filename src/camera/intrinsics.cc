// SPDX-License-Identifier: Apache-2.0
#include "camera/intrinsics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "camera/focal_length.h"

namespace ridgeline {
namespace {

struct ModelLayout {
  const char* name;
  std::size_t num_params;
  bool two_focal_lengths;
  std::size_t num_radial;
  std::size_t num_tangential;
};

constexpr std::array<ModelLayout, 6> kModels = {{{"SIMPLE_PINHOLE", 3, false, 0, 0},
                                                 {"PINHOLE", 4, true, 0, 0},
                                                 {"SIMPLE_RADIAL", 4, false, 1, 0},
                                                 {"RADIAL", 5, false, 2, 0},
                                                 {"OPENCV", 8, true, 2, 2},
                                                 {"FULL_OPENCV", 12, true, 6, 2}}};

const ModelLayout* FindModel(const std::string& name) {
  const auto it = std::find_if(
      kModels.begin(), kModels.end(), [&](const ModelLayout& m) { return name == m.name; });
  return it == kModels.end() ? nullptr : &*it;
}

struct Distortion {
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;  // k3 to k6: rational
  double k4 = 0.0;
  double k5 = 0.0;
  double k6 = 0.0;
};

Distortion DistortionOf(const CameraIntrinsics& camera) {
  const ModelLayout& layout = *FindModel(camera.model);
  const std::size_t first = layout.two_focal_lengths ? 4 : 3;
  Distortion d;
  if (layout.num_radial > 0) d.k1 = camera.params[first];
  if (layout.num_radial > 1) d.k2 = camera.params[first + 1];
  if (layout.num_tangential > 0) {
    d.p1 = camera.params[first + 2];
    d.p2 = camera.params[first + 3];
  }
  if (layout.num_radial > 2) {
    d.k3 = camera.params[first + 4];
    d.k4 = camera.params[first + 5];
    d.k5 = camera.params[first + 6];
    d.k6 = camera.params[first + 7];
  }
  return d;
}

Eigen::Vector2d Displacement(const Distortion& d, const Eigen::Vector2d& u) {
  const double r2 = u.squaredNorm();
  const double numerator = r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double denominator = r2 * (d.k4 + r2 * (d.k5 + r2 * d.k6));
  const double radial = (numerator - denominator) / (1.0 + denominator);
  const double xy = u.x() * u.y();
  return {u.x() * radial + 2.0 * d.p1 * xy + d.p2 * (r2 + 2.0 * u.x() * u.x()),
          u.y() * radial + 2.0 * d.p2 * xy + d.p1 * (r2 + 2.0 * u.y() * u.y())};
}

std::string Rounded(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string OddFocal(double focal, int width, int height) {
  return Rounded("%.6g", focal) + ", " + Rounded("%.3g", DiagonalViewDeg(focal, width, height)) +
         " deg across " + std::to_string(width) + " x " + std::to_string(height) + " px";
}

// What a number that is no focal length in pixels is likely to be.
std::string MeantFocal(double focal, int width, int height) {
  constexpr double kFilmMm = 43.266615305567875;
  constexpr double kMostPart = 5.0;  // of the longer side
  const double part_px = focal * std::max(width, height);
  if (focal < kMostPart && IsPlausibleFocal(part_px, width, height)) {
    return "; as a part of the longer side it is " + Rounded("%.1f px", part_px);
  }
  const double film_px = focal * std::hypot(width, height) / kFilmMm;
  if (DiagonalViewDeg(focal, width, height) > 90.0) {
    if (!IsPlausibleFocal(film_px, width, height)) return "";
    return "; millimetres? As a 35 mm equivalent it is " + Rounded("%.1f px", film_px);
  }
  return "; of a larger picture, or in micrometres?";
}

// A principal point far outside of the picture, or distortion beyond any lens, is a slip; their
// squares would overflow.
void CheckParameters(const CameraIntrinsics& camera,
                     const std::string& file,
                     const std::string& field) {
  const std::vector<double>& params = camera.params;
  constexpr double kMostSides = 10.0;
  constexpr double kMostDistortion = 1e4;
  const ModelLayout& layout = *FindModel(camera.model);
  const std::size_t first = layout.two_focal_lengths ? 2 : 1;
  for (std::size_t i = first; i < params.size(); ++i) {
    const bool is_point = i < first + 2;
    const double most =
        is_point ? kMostSides * std::max(camera.width, camera.height) : kMostDistortion;
    if (std::abs(params[i]) <= most) continue;
    throw InputError(file,
                     field + "params[" + std::to_string(i) + "]",
                     Rounded("%.6g", params[i]),
                     is_point ? "a principal point in pixels, in the picture or near it"
                              : "a parameter of distortion (of normalized coordinates)");
  }
}

// The share of the way from the principal point to the farthest corner up to which distorted points
// go outwards as their rays do; 1: all of it.
double ShareWithoutFold(const CameraIntrinsics& camera) {
  const PinholeCamera pinhole = camera.Pinhole();
  const Distortion d = DistortionOf(camera);
  const double x = std::max(pinhole.cx, pinhole.width - pinhole.cx) / pinhole.fx;
  const double y = std::max(pinhole.cy, pinhole.height - pinhole.cy) / pinhole.fy;
  const double corner = std::hypot(x, y);
  constexpr double kSteps = 200.0;
  constexpr int kMostSteps = 4000;
  double before = 0.0;
  for (int i = 1; i <= kMostSteps && before < corner; ++i) {
    const Eigen::Vector2d ray(i * corner / kSteps, 0.0);
    const double radius =
        ray.x() + Displacement({d.k1, d.k2, 0, 0, d.k3, d.k4, d.k5, d.k6}, ray).x();
    if (!(radius > before)) break;
    before = radius;
  }
  return std::min(before / corner, 1.0);
}

void CheckShape(const CameraIntrinsics& camera, const std::string& file, const std::string& field) {
  constexpr double kMostAspect = 2.0;
  const PinholeCamera pinhole = camera.Pinhole();
  const double aspect = pinhole.fx / pinhole.fy;
  if (aspect > kMostAspect || aspect < 1.0 / kMostAspect) {
    throw InputError(file,
                     field + "params[1]",
                     Rounded("%.6g", pinhole.fy) + " beside " + Rounded("%.6g", pinhole.fx),
                     "focal lengths across and down that are nearly the same");
  }
  if (!camera.HasDistortion()) return;
  // Calibrations may fold near the corners, where they had no points.
  constexpr double kLeastShare = 0.5;
  const double share = ShareWithoutFold(camera);
  if (share >= kLeastShare) return;
  throw InputError(file,
                   field + "params",
                   "a distortion that folds the picture at " + Rounded("%.0f", 100.0 * share) +
                       " % of the way to its corner",
                   "that of a lens, in the order of " + camera.model);
}

}  // namespace

PinholeCamera PinholeCamera::Scaled(double scale) const {
  PinholeCamera scaled;
  scaled.width = std::max(1, static_cast<int>(std::lround(width * scale)));
  scaled.height = std::max(1, static_cast<int>(std::lround(height * scale)));
  const double sx = static_cast<double>(scaled.width) / width;
  const double sy = static_cast<double>(scaled.height) / height;
  scaled.fx = fx * sx;
  scaled.fy = fy * sy;
  scaled.cx = cx * sx;
  scaled.cy = cy * sy;
  return scaled;
}

void CameraIntrinsics::Validate(const std::string& file, const std::string& field) const {
  const std::string place = field.empty() ? "" : field + ".";
  const ModelLayout* layout = FindModel(model);
  if (layout == nullptr) {
    std::string names;
    for (const ModelLayout& m : kModels) names += (names.empty() ? "" : ", ") + std::string(m.name);
    throw InputError(file, place + "model", "\"" + model + "\"", "one of " + names);
  }
  if (width <= 0) throw InputError(file, place + "width", std::to_string(width), "> 0");
  if (height <= 0) throw InputError(file, place + "height", std::to_string(height), "> 0");
  if (std::int64_t{width} * height > limits::kPicturePixels) {
    throw InputError(file,
                     (field.empty() ? "" : field + ": ") + "limit",
                     std::to_string(width) + " x " + std::to_string(height) + " px",
                     "at most " + std::to_string(limits::kPicturePixels) + " px (a smaller copy)");
  }
  if (params.size() != layout->num_params) {
    throw InputError(file,
                     place + "params",
                     std::to_string(params.size()) + " numbers",
                     std::to_string(layout->num_params) + " for " + model);
  }
  for (std::size_t i = 0; i < params.size(); ++i) {
    const bool is_focal = i == 0 || (i == 1 && layout->two_focal_lengths);
    if (!std::isfinite(params[i]) || (is_focal && params[i] <= 0.0)) {
      throw InputError(file,
                       place + "params[" + std::to_string(i) + "]",
                       std::to_string(params[i]),
                       is_focal ? "a focal length > 0" : "a finite number");
    }
    if (is_focal && !IsPlausibleFocal(params[i], width, height)) {
      throw InputError(file,
                       place + "params[" + std::to_string(i) + "]",
                       OddFocal(params[i], width, height),
                       "a focal length in pixels, a field of view of 5 to 150 deg" +
                           MeantFocal(params[i], width, height));
    }
  }
  CheckParameters(*this, file, place);
  CheckShape(*this, file, place);
}

bool CameraIntrinsics::HasDistortion() const {
  const Distortion d = DistortionOf(*this);
  return d.k1 != 0.0 || d.k2 != 0.0 || d.p1 != 0.0 || d.p2 != 0.0 || d.k3 != 0.0 || d.k4 != 0.0 ||
         d.k5 != 0.0 || d.k6 != 0.0;
}

PinholeCamera CameraIntrinsics::Pinhole() const {
  const bool two = FindModel(model)->two_focal_lengths;
  return {width, height, params[0], params[two ? 1 : 0], params[two ? 2 : 1], params[two ? 3 : 2]};
}

Eigen::Vector2d CameraIntrinsics::Distort(const Eigen::Vector2d& normalized) const {
  const Eigen::Vector2d u = normalized + Displacement(DistortionOf(*this), normalized);
  const PinholeCamera pinhole = Pinhole();
  return {pinhole.fx * u.x() + pinhole.cx, pinhole.fy * u.y() + pinhole.cy};
}

Eigen::Vector2d CameraIntrinsics::Undistort(const Eigen::Vector2d& px) const {
  const Distortion d = DistortionOf(*this);
  const Eigen::Vector2d target = Pinhole().RayFromImage(px).head<2>();
  Eigen::Vector2d u = target;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d next = target - Displacement(d, u);
    const double step = (next - u).norm();
    u = next;
    if (step < 1e-10) break;
  }
  return u;
}

namespace {

// Where the pixels of an undistorted picture lie in the distorted one, as cv::remap reads it:
// exact at every eighth pixel of every eighth row, linear between them. Distortion bends by some
// ten thousandths of a pixel per square pixel: between nodes it is off by less than 0.01 px.
cv::Mat DistortedPlaces(const cv::Size& size, const CameraIntrinsics& camera) {
  constexpr int kSpacing = 8;
  const PinholeCamera pinhole = camera.Pinhole();
  const int nodes = (size.width - 1) / kSpacing + 2;
  const auto nodes_of_row = [&](int y) {
    std::vector<cv::Vec2f> row;
    for (int i = 0; i < nodes; ++i) {
      const Eigen::Vector2d ray = pinhole.RayFromImage({i * kSpacing + 0.5, y + 0.5}).head<2>();
      const Eigen::Vector2d px = camera.Distort(ray);
      row.emplace_back(static_cast<float>(px.x() - 0.5), static_cast<float>(px.y() - 0.5));
    }
    return row;
  };
  cv::Mat places(size, CV_32FC2);
  std::vector<cv::Vec2f> below = nodes_of_row(0);
  for (int top = 0; top < size.height; top += kSpacing) {
    const std::vector<cv::Vec2f> above = std::move(below);
    below = nodes_of_row(top + kSpacing);
    for (int y = top; y < std::min(top + kSpacing, size.height); ++y) {
      const float down = static_cast<float>(y - top) / kSpacing;
      std::vector<cv::Vec2f> row(above.size());
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = above[i] + down * (below[i] - above[i]);
      cv::Vec2f* const out = places.ptr<cv::Vec2f>(y);
      for (int x = 0; x < size.width; ++x) {
        const auto i = static_cast<std::size_t>(x / kSpacing);
        const float right = static_cast<float>(x % kSpacing) / kSpacing;
        out[x] = row[i] + right * (row[i + 1] - row[i]);
      }
    }
  }
  return places;
}

}  // namespace

cv::Mat UndistortImage(const cv::Mat& image, const CameraIntrinsics& camera) {
  if (!camera.HasDistortion()) return image;
  cv::Mat undistorted;
  cv::remap(image,
            undistorted,
            DistortedPlaces(image.size(), camera),
            cv::noArray(),
            cv::INTER_LINEAR,
            cv::BORDER_REPLICATE);
  return undistorted;
}

}  // namespace ridgeline
