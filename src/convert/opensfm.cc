// SPDX-License-Identifier: Apache-2.0
#include "convert/opensfm.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/json_input.h"
#include "city/crs.h"
#include "convert/topocentric.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// A JSON object with its place, for messages.
struct Node {
  const Json& json;
  std::string file;
  std::string path;

  [[noreturn]] void Fail(const std::string& key,
                         const std::string& found,
                         const std::string& expected) const {
    throw InputError(file, path.empty() ? key : path + "." + key, found, expected);
  }
  Node Object(const std::string& key) const {
    const auto it = json.is_object() ? json.find(key) : json.end();
    if (!json.is_object() || it == json.end() || !it->is_object())
      Fail(key, "nothing", "an object");
    return {*it, file, path.empty() ? key : path + "." + key};
  }
  bool Has(const std::string& key) const { return json.is_object() && json.contains(key); }
  double Number(const std::string& key) const {
    const auto it = json.find(key);
    if (it == json.end() || !it->is_number()) {
      Fail(key, it == json.end() ? "nothing" : JsonText(*it), "a number");
    }
    return it->get<double>();
  }
  double Number(const std::string& key, double otherwise) const {
    return Has(key) ? Number(key) : otherwise;
  }
  std::string Text(const std::string& key) const {
    const auto it = json.find(key);
    if (it == json.end() || !it->is_string()) {
      Fail(key, it == json.end() ? "nothing" : JsonText(*it), "a text");
    }
    return it->get<std::string>();
  }
  Eigen::Vector3d Vector(const std::string& key) const {
    const auto it = json.find(key);
    const bool valid =
        it != json.end() && it->is_array() && it->size() == 3 &&
        std::all_of(it->begin(), it->end(), [](const Json& v) { return v.is_number(); });
    if (!valid) Fail(key, it == json.end() ? "nothing" : JsonText(*it), "three numbers");
    return {(*it)[0].get<double>(), (*it)[1].get<double>(), (*it)[2].get<double>()};
  }
};

// Normalized coordinates have the picture's middle as origin and its longer side as 1.
CameraIntrinsics CameraOf(const Node& node) {
  const std::string type = node.Text("projection_type");
  CameraIntrinsics camera;
  camera.width = static_cast<int>(node.Number("width"));
  camera.height = static_cast<int>(node.Number("height"));
  const double unit = std::max(camera.width, camera.height);
  const double k1 = node.Number("k1", 0.0);
  const double k2 = node.Number("k2", 0.0);
  if (type == "perspective") {
    camera.model = "RADIAL";
    camera.params = {node.Number("focal") * unit, 0.5 * camera.width, 0.5 * camera.height, k1, k2};
  } else if (type == "simple_radial" || type == "radial" || type == "brown") {
    camera.params = {node.Number("focal_x") * unit,
                     node.Number("focal_y") * unit,
                     node.Number("c_x", 0.0) * unit + 0.5 * camera.width,
                     node.Number("c_y", 0.0) * unit + 0.5 * camera.height,
                     k1,
                     type == "simple_radial" ? 0.0 : k2,
                     node.Number("p1", 0.0),
                     node.Number("p2", 0.0)};
    const double k3 = node.Number("k3", 0.0);
    camera.model = k3 == 0.0 ? "OPENCV" : "FULL_OPENCV";
    if (k3 != 0.0) camera.params.insert(camera.params.end(), {k3, 0.0, 0.0, 0.0});
  } else {
    node.Fail("projection_type",
              "\"" + type + "\"",
              "perspective, simple_radial, radial or brown (undistort the others first)");
  }
  camera.Validate(node.file, node.path);
  return camera;
}

// World to camera: a rotation vector (axis times angle [rad]) and the translation.
Pose PoseOf(const Node& shot) {
  const Eigen::Vector3d vector = shot.Vector("rotation");
  const double angle = vector.norm();
  Pose pose;
  if (angle > 0.0) pose.cam_from_world = Eigen::AngleAxisd(angle, vector / angle);
  pose.center_in_world = -(pose.cam_from_world.conjugate() * shot.Vector("translation"));
  return pose;
}

void ReadReconstruction(const Node& node, const Crs& crs, Dataset& dataset) {
  const Node place = node.Object("reference_lla");
  const Topocentric frame(
      place.Number("latitude"), place.Number("longitude"), place.Number("altitude"));
  std::map<std::string, CameraIntrinsics> cameras;
  const Node camera_nodes = node.Object("cameras");
  for (const auto& [name, camera] : camera_nodes.json.items()) {
    cameras[name] = CameraOf(camera_nodes.Object(name));
  }
  const Node shots = node.Object("shots");
  for (const auto& [name, json] : shots.json.items()) {
    const Node shot = shots.Object(name);
    const auto camera = cameras.find(shot.Text("camera"));
    if (camera == cameras.end()) {
      shot.Fail("camera", "\"" + shot.Text("camera") + "\"", "a camera of \"cameras\"");
    }
    Query query;
    query.image = name;
    query.camera = camera->second;
    query.truth = frame.ToProjected(PoseOf(shot), crs, node.file);
    dataset.queries.push_back(std::move(query));
  }
}

}  // namespace

Dataset ReadOpenSfm(const fs::path& file, const ConvertOptions& options) {
  const std::string name = file.string();
  const Json json = ParseJson(ReadFile(file), name);
  if (!json.is_array() || json.empty()) {
    throw InputError(name, "", json.type_name(), "a list of reconstructions [ ... ]");
  }
  const std::optional<Crs> crs = ParseCrs(options.crs);
  if (!crs) {
    throw InputError(
        "--crs",
        "",
        options.crs.empty() ? "nothing" : "\"" + options.crs + "\"",
        "a projected system such as EPSG:25832, since " + name + " has latitudes and longitudes");
  }
  Dataset dataset;
  dataset.name = fs::absolute(file).parent_path().filename().string();
  dataset.crs = options.crs;
  for (std::size_t r = 0; r < json.size(); ++r) {
    ReadReconstruction({json[r], name, "[" + std::to_string(r) + "]"}, *crs, dataset);
  }
  if (dataset.queries.empty()) throw InputError(name, "shots", "none", "at least one shot");
  return dataset;
}

}  // namespace ridgeline
