// SPDX-License-Identifier: Apache-2.0
#include "cli/augment_parts.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "augment/impact.h"
#include "augment/sun.h"
#include "base/angle.h"
#include "base/error.h"
#include "camera/decode_file.h"
#include "city/crs.h"
#include "city/read_city.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// East, north and perhaps height of --place.
std::vector<double> ParsePlace(const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(text);
  std::string part;
  while (std::getline(stream, part, ',')) {
    char* end = nullptr;
    values.push_back(std::strtod(part.c_str(), &end));
    if (part.empty() || *end != '\0' || !std::isfinite(values.back())) {
      values.clear();
      break;
    }
  }
  if (values.size() != 2 && values.size() != 3) {
    throw InputError("--place", "", '"' + text + '"', "east,north or east,north,height");
  }
  return values;
}

Eigen::Vector3d BaseOf(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : vertices) box.extend(v);
  return {box.center().x(), box.center().y(), box.min().z()};
}

Eigen::Vector3d PlaceOf(const std::string& text, const CityModel& model, const HeightGrid* dtm) {
  const std::vector<double> place = ParsePlace(text);
  const Eigen::Vector3d& origin = model.origin_in_world;
  const Eigen::Vector2d xy = Eigen::Vector2d(place[0], place[1]) - origin.head<2>();
  if (place.size() == 3) return {xy.x(), xy.y(), place[2] - origin.z()};
  const auto terrain = dtm != nullptr ? dtm->HeightAt(xy) : std::nullopt;
  if (!terrain) {
    throw InputError(
        "--place", "", "no terrain there", "east,north,height, or a DTM that covers it");
  }
  return {xy.x(), xy.y(), *terrain};
}

// With world coordinates of its own, in doubles and without materials.
TexturedMesh InWorldCoordinates(const AugmentArguments& arguments,
                                const CityModel& model,
                                const Context& context) {
  CityOptions options;
  if (model.crs.horizontal_epsg != 0) {
    options.project_to = "EPSG:" + std::to_string(model.crs.horizontal_epsg);
  }
  CityModel building =
      ReadCity({arguments.building.begin(), arguments.building.end()}, options);
  for (const std::string& warning : building.warnings) context.Warn(warning);
  TexturedMesh mesh = TexturedFrom(building);
  for (Eigen::Vector3d& v : mesh.vertices) v += building.origin_in_world - model.origin_in_world;
  return mesh;
}

// Grid azimuth of a direction from true north, at a place of the system [world].
double GridAzimuth(double true_deg, const Crs& crs, const Eigen::Vector2d& place) {
  constexpr double kStepM = 100.0;
  const auto here = LatitudeLongitude(crs, place);
  const auto north = LatitudeLongitude(crs, place + Eigen::Vector2d(0.0, kStepM));
  if (!here || !north) return true_deg;
  const double east = (north->y() - here->y()) * std::cos(here->x() * kRadPerDeg);
  return true_deg - std::atan2(east, north->x() - here->x()) / kRadPerDeg;
}

}  // namespace

TexturedMesh ReadInsertedBuilding(const AugmentArguments& arguments,
                                  const CityModel& model,
                                  const HeightGrid* dtm,
                                  const Context& context) {
  constexpr double kMostScale = 1e6;
  constexpr double kMostDeg = 720.0;
  if (!(arguments.scale > 0.0 && arguments.scale <= kMostScale)) {
    throw InputError("--scale", "", std::to_string(arguments.scale), "more than 0, at most 1e6");
  }
  const std::pair<const char*, double> angles[] = {
      {"--heading", arguments.heading_deg},
      {"--light-azimuth", arguments.light_azimuth_deg},
      {"--light-elevation", arguments.light_elevation_deg}};
  for (const auto& [option, deg] : angles) {
    if (std::abs(deg) <= kMostDeg) continue;  // false for NaN
    throw InputError(option, "", std::to_string(deg), "degrees, -720 to 720");
  }
  const bool textured =
      arguments.building.size() == 1 && IsTexturedFormat(arguments.building.front());
  if (arguments.place.empty()) {
    const std::string extension = fs::path(arguments.building.front()).extension().string();
    if (textured && extension != ".obj" && extension != ".ply") {
      throw InputError("--place", "", "nothing", "east,north: this format has no world coordinates");
    }
    TexturedMesh mesh = InWorldCoordinates(arguments, model, context);
    const Eigen::Vector3d base = BaseOf(mesh.vertices);
    return PlacedMesh(std::move(mesh), base, arguments.heading_deg, arguments.scale);
  }
  const Eigen::Vector3d base = PlaceOf(arguments.place, model, dtm);
  TexturedMesh mesh = textured ? ReadTexturedMesh(arguments.building.front(), arguments.y_up)
                               : InWorldCoordinates(arguments, model, context);
  if (!textured && arguments.y_up) {
    throw InputError("--y-up", "", arguments.building.front(), "an OBJ, glTF or other mesh");
  }
  for (const std::string& warning : mesh.warnings) context.Warn(warning);
  return PlacedMesh(std::move(mesh), base, arguments.heading_deg, arguments.scale);
}

Eigen::Vector3d LightOf(const AugmentArguments& arguments,
                        const CityModel& model,
                        const TexturedMesh& mesh,
                        const Context& context) {
  if (arguments.sun.empty()) {
    return Towards(arguments.light_azimuth_deg, arguments.light_elevation_deg);
  }
  const Eigen::Vector2d place =
      (BaseOf(mesh.vertices) + model.origin_in_world).head<2>();
  const auto degrees = LatitudeLongitude(model.crs, place);
  if (!degrees) {
    throw InputError("--sun", "", "a model without a system", "--crs EPSG:... for the sun's place");
  }
  const SunDirection sun = SunAt(ParseTime(arguments.sun, "--sun"), degrees->x(), degrees->y());
  char line[120];
  std::snprintf(line,
                sizeof line,
                "sun         azimuth %.1f deg, %.1f deg above the horizon",
                sun.azimuth_deg,
                sun.elevation_deg);
  context.Note(line);
  if (sun.elevation_deg <= 0.0) context.Warn("the sun is below the horizon then: no light of it");
  return Towards(GridAzimuth(sun.azimuth_deg, model.crs, place), sun.elevation_deg);
}

cv::Mat ForegroundOf(const AugmentArguments& arguments,
                     const std::string& id,
                     const cv::Mat& photo,
                     const Scene& city,
                     const PinholeCamera& camera,
                     const Pose& cam_from_local) {
  if (arguments.foreground.empty()) return {};
  if (arguments.foreground == "auto") {
    return AutomaticForeground(photo, city, camera, cam_from_local);
  }
  fs::path file = arguments.foreground;
  std::error_code error;
  if (fs::is_directory(file, error)) file /= id + ".png";
  const cv::Mat mask = DecodeFile(file, cv::IMREAD_GRAYSCALE, "a mask");
  if (mask.empty()) throw InputError(file.string(), "", "nothing that can be read", "a mask (PNG)");
  if (mask.size() != photo.size()) {
    throw InputError(file.string(),
                     "",
                     std::to_string(mask.cols) + " x " + std::to_string(mask.rows) + " px",
                     "the photo's " + std::to_string(photo.cols) + " x " +
                         std::to_string(photo.rows) + " px (without distortion)");
  }
  return mask;
}

}  // namespace ridgeline
