// SPDX-License-Identifier: Apache-2.0
#include "study/variation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/random.h"
#include "lines/detector_table.h"

namespace ridgeline {
namespace {

// Stages of the random streams.
constexpr std::uint64_t kEdgeStage = 501;
constexpr std::uint64_t kHeightStage = 502;
constexpr std::uint64_t kFootprintStage = 503;
constexpr std::uint64_t kClutterStage = 504;

struct Limits {
  const char* name;
  double lower;
  double upper;
};
constexpr std::array<Limits, 6> kLimits = {{{"edges", 0.0, 100.0},
                                            {"clutter", 0.0, 90.0},
                                            {"heights", 0.0, 50.0},
                                            {"footprints", 0.0, 50.0},
                                            {"focal", -50.0, 100.0},
                                            {"size", 64.0, 10000.0}}};

// The number of a level; NaN: it is none.
double ValueOf(const std::string& level) {
  std::istringstream text(level);
  double value = NAN;
  if (!(text >> value) || !(text >> std::ws).eof()) return NAN;
  return value;
}

void CheckLevel(const std::string& name, const std::string& level) {
  if (name == "detector") {
    const std::vector<std::string> known = DetectorNames();
    if (std::find(known.begin(), known.end(), level) != known.end()) return;
    throw InputError("--vary",
                     name,
                     "\"" + level + "\"",
                     "a detector, e.g. \"" + NearestName(level, known) + "\"");
  }
  const auto limits =
      std::find_if(kLimits.begin(), kLimits.end(), [&](const Limits& l) { return name == l.name; });
  const double value = ValueOf(level);
  if (value >= limits->lower && value <= limits->upper) return;
  std::ostringstream expected;
  expected << "numbers in [" << limits->lower << ", " << limits->upper << "]";
  throw InputError("--vary", name, "\"" + level + "\"", expected.str());
}

std::vector<std::string> Parts(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

// Parts of a building err together.
std::vector<std::size_t> GroupsOf(const CityModel& model) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> groups;
  for (const Building& building : model.buildings) {
    const std::string& id = building.parent_id.empty() ? building.id : building.parent_id;
    groups.push_back(numbers.emplace(id, numbers.size()).first->second);
  }
  return groups;
}

// Moves each building; vertices that buildings share are doubled.
template <typename Move>
CityModel Moved(const CityModel& model, const std::vector<std::size_t>& groups, const Move& move) {
  CityModel moved = model;
  moved.vertices.clear();
  std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> numbers;
  for (Triangle& triangle : moved.triangles) {
    const std::size_t group = groups[model.surfaces[triangle.surface].building];
    for (std::uint32_t& vertex : triangle.vertices) {
      const auto [it, is_new] = numbers.emplace(std::pair{group, vertex},
                                                static_cast<std::uint32_t>(moved.vertices.size()));
      if (is_new) moved.vertices.push_back(move(group, model.vertices[vertex]));
      vertex = it->second;
    }
  }
  for (FeatureEdge& edge : moved.feature_edges) {
    if (edge.surface0 == kNoSurface) continue;
    const std::size_t group = groups[model.surfaces[edge.surface0].building];
    edge.a = move(group, edge.a);
    edge.b = move(group, edge.b);
  }
  return moved;
}

// The lower half of a building stretches, so that its feet stay on the ground; all above moves as
// one.
CityModel WithHeightErrors(const CityModel& model, double sigma_m, std::uint64_t seed) {
  const std::vector<std::size_t> groups = GroupsOf(model);
  std::map<std::size_t, std::pair<double, double>> extent;
  for (const Triangle& triangle : model.triangles) {
    const std::size_t group = groups[model.surfaces[triangle.surface].building];
    for (const std::uint32_t vertex : triangle.vertices) {
      const double z = model.vertices[vertex].z();
      auto& [lowest, highest] = extent.emplace(group, std::pair{z, z}).first->second;
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
  }
  return Moved(model, groups, [&](std::size_t group, const Eigen::Vector3d& p) {
    const auto [lowest, highest] = extent[group];
    const double rise =
        std::clamp((p.z() - lowest) / std::max(0.5 * (highest - lowest), 1e-3), 0.0, 1.0);
    const double error = sigma_m * Random(seed, kHeightStage, group).Normal();
    return Eigen::Vector3d(p.x(), p.y(), p.z() + rise * error);
  });
}

CityModel WithShifts(const CityModel& model, double sigma_m, std::uint64_t seed) {
  return Moved(model, GroupsOf(model), [&](std::size_t group, const Eigen::Vector3d& p) {
    Random random(seed, kFootprintStage, group);
    const double east = sigma_m * random.Normal();
    const double north = sigma_m * random.Normal();
    return Eigen::Vector3d(p.x() + east, p.y() + north, p.z());
  });
}

CityModel WithFewerEdges(const CityModel& model, double share, std::uint64_t seed) {
  CityModel fewer = model;
  fewer.feature_edges.clear();
  for (std::size_t i = 0; i < model.feature_edges.size(); ++i) {
    if (Random(seed, kEdgeStage, i).Uniform() < share) {
      fewer.feature_edges.push_back(model.feature_edges[i]);
    }
  }
  return fewer;
}

cv::Mat Covered(const cv::Mat& picture, double share, Random random) {
  cv::Mat covered = picture.clone();
  cv::Mat mask = cv::Mat::zeros(picture.size(), CV_8U);
  const double top = picture.depth() == CV_16U ? 65535.0 : 255.0;
  const double wanted = share * static_cast<double>(picture.total());
  while (cv::countNonZero(mask) < wanted) {
    const cv::Point2f center(static_cast<float>(random.Uniform(0.0, picture.cols)),
                             static_cast<float>(random.Uniform(0.0, picture.rows)));
    const cv::Size2f size(static_cast<float>(random.Uniform(0.02, 0.15) * picture.cols),
                          static_cast<float>(random.Uniform(0.02, 0.15) * picture.cols));
    const auto angle = static_cast<float>(random.Uniform(0.0, 90.0));
    cv::Scalar color;
    for (int k = 0; k < 3; ++k) color[k] = random.Uniform(0.0, top);
    color[3] = top;
    std::array<cv::Point2f, 4> corners;
    cv::RotatedRect(center, size, angle).points(corners.data());
    std::vector<cv::Point> polygon(corners.begin(), corners.end());
    cv::fillConvexPoly(covered, polygon, color);
    cv::fillConvexPoly(mask, polygon, 255);
  }
  return covered;
}

}  // namespace

const std::vector<Variation>& Variations() {
  static const std::vector<Variation> variations = {
      {"edges", "model edges kept [%]", {"100", "50", "25", "10"}},
      {"clutter", "picture covered by clutter [%]", {"0", "10", "20", "40"}},
      {"heights", "error of the buildings' heights, sigma [m]", {"0", "0.25", "0.5", "1"}},
      {"footprints", "shift of the buildings, sigma [m]", {"0", "0.25", "0.5", "1"}},
      {"focal", "error of the focal length [%]", {"-5", "-2", "0", "2", "5"}},
      {"size", "longer side of the picture compared [px]", {"240", "480", "640", "960"}},
      {"detector", "detector of lines", DetectorNames()}};
  return variations;
}

Variation ParseVariation(const std::string& text) {
  const std::size_t equal = text.find('=');
  const std::string name = text.substr(0, equal);
  std::vector<std::string> known;
  for (const Variation& variation : Variations()) {
    known.push_back(variation.name);
    if (variation.name != name) continue;
    Variation chosen = variation;
    if (equal == std::string::npos) return chosen;
    chosen.levels = Parts(text.substr(equal + 1));
    if (chosen.levels.empty())
      throw InputError(
          "--vary", name, "no levels", "e.g. " + name + "=" + variation.levels.front());
    for (const std::string& level : chosen.levels) CheckLevel(name, level);
    return chosen;
  }
  throw InputError("--vary",
                   "",
                   "\"" + name + "\"",
                   "\"" + NearestName(name, known) +
                       "\", or another of edges, clutter, heights, footprints, focal, size, "
                       "detector, or \"all\"");
}

CityModel VariedModel(const CityModel& model,
                      const Variation& variation,
                      const std::string& level,
                      std::uint64_t seed) {
  if (variation.name == "edges") return WithFewerEdges(model, 0.01 * ValueOf(level), seed);
  if (variation.name == "heights") return WithHeightErrors(model, ValueOf(level), seed);
  if (variation.name == "footprints") return WithShifts(model, ValueOf(level), seed);
  return model;
}

cv::Mat VariedPicture(const cv::Mat& picture,
                      const Variation& variation,
                      const std::string& level,
                      std::uint64_t seed,
                      const std::string& query_id) {
  if (variation.name != "clutter") return picture;
  return Covered(picture, 0.01 * ValueOf(level), Random(seed, kClutterStage, HashText(query_id)));
}

CameraIntrinsics VariedCamera(const CameraIntrinsics& camera,
                              const Variation& variation,
                              const std::string& level) {
  if (variation.name != "focal") return camera;
  CameraIntrinsics varied = camera;
  const bool one_focal = camera.model.starts_with("SIMPLE") || camera.model == "RADIAL";
  for (int k = 0; k < (one_focal ? 1 : 2); ++k) varied.params[k] *= 1.0 + 0.01 * ValueOf(level);
  return varied;
}

LocalizerOptions VariedOptions(const LocalizerOptions& options,
                               const Variation& variation,
                               const std::string& level) {
  LocalizerOptions varied = options;
  if (variation.name == "size") {
    varied.score.evidence.work_size_px = static_cast<int>(ValueOf(level));
  }
  if (variation.name == "detector") varied.lines.detector = level;
  return varied;
}

}  // namespace ridgeline
