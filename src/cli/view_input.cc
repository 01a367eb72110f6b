// SPDX-License-Identifier: Apache-2.0
#include "cli/view_input.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/read_city.h"
#include "input/dataset.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// What the arguments name, before anything large is read.
struct Named {
  std::vector<fs::path> model;
  std::string model_crs;
  std::optional<fs::path> dtm;
  std::optional<fs::path> image;
  std::optional<CameraIntrinsics> camera;
  std::optional<Pose> pose;        // world
  std::optional<PosePrior> prior;  // where the pose is to be made from it
};

std::vector<double> CommaNumbers(const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(text);
  std::string part;
  while (std::getline(stream, part, ',')) {
    std::istringstream number(part);
    double value = 0.0;
    if (!(number >> value) || !std::isfinite(value) || !(number >> std::ws).eof()) return {};
    values.push_back(value);
  }
  return values;
}

// A pose file: "position" and "cam_from_world_wxyz", at the top or in "pose".
Pose ReadPoseFile(const fs::path& path) {
  const nlohmann::json json = nlohmann::json::parse(ReadFile(path), nullptr, false);
  const nlohmann::json& pose = json.is_object() && json.contains("pose") ? json["pose"] : json;
  const auto numbers = [&](const char* key, std::size_t count) {
    const auto it = pose.is_object() ? pose.find(key) : pose.end();
    const bool valid =
        pose.is_object() && it != pose.end() && it->is_array() && it->size() == count &&
        std::all_of(it->begin(), it->end(), [](const auto& v) { return v.is_number(); });
    if (!valid) {
      throw InputError(path.string(), key, "nothing usable", std::to_string(count) + " numbers");
    }
    return it->template get<std::vector<double>>();
  };
  const auto position = numbers("position", 3);
  const auto q = numbers("cam_from_world_wxyz", 4);
  Pose result;
  result.center_in_world = {position[0], position[1], position[2]};
  result.cam_from_world = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  return result;
}

Pose ParsePose(const std::string& text) {
  const std::vector<double> values = CommaNumbers(text);
  if (values.empty()) return ReadPoseFile(text);
  if (values.size() != 6) {
    throw InputError(
        "--pose", "", "\"" + text + "\"", "east,north,height,heading,pitch,roll or a pose file");
  }
  Pose pose;
  pose.center_in_world = {values[0], values[1], values[2]};
  pose.cam_from_world = CamFromWorld(ViewAngles{values[3], values[4], values[5]});
  return pose;
}

void TakeQuery(const ViewArguments& arguments, Named& named) {
  const Dataset dataset = ReadDataset(arguments.dataset);
  std::vector<std::string> ids;
  for (const Query& query : dataset.queries) ids.push_back(query.id);
  const auto it = std::find(ids.begin(), ids.end(), arguments.query);
  if (it == ids.end()) {
    throw InputError(
        "--query",
        "",
        "\"" + arguments.query + "\"",
        "a query of " + arguments.dataset + ", e.g. \"" + NearestName(arguments.query, ids) + "\"");
  }
  const Query& query = dataset.queries[static_cast<std::size_t>(it - ids.begin())];
  named.model = dataset.model;
  named.model_crs = dataset.crs;
  named.dtm = dataset.dtm;
  named.image = query.image;
  named.camera = query.camera;
  if (arguments.at == "truth") named.pose = query.truth;
  if (arguments.at == "prior") named.prior = query.prior;
}

Named Resolve(const ViewArguments& arguments) {
  Named named;
  if (!arguments.dataset.empty()) TakeQuery(arguments, named);
  if (!arguments.model.empty()) named.model.assign(arguments.model.begin(), arguments.model.end());
  if (!arguments.dtm.empty()) named.dtm = arguments.dtm;
  if (!arguments.image.empty()) named.image = arguments.image;
  if (!arguments.camera.empty()) named.camera = ReadCamera(arguments.camera);
  if (!arguments.pose.empty()) {
    named.pose = ParsePose(arguments.pose);
    named.prior.reset();
  }
  if (named.model.empty()) throw InputError("--model", "", "nothing", "model files, or --dataset");
  if (!named.camera) throw InputError("--camera", "", "nothing", "a camera file, or --dataset");
  if (!named.pose && !named.prior) {
    throw InputError("--pose",
                     "",
                     arguments.dataset.empty() ? "nothing" : "a query without " + arguments.at,
                     "east,north,height,heading,pitch,roll or a pose file");
  }
  return named;
}

// Level ground 1.7 m below the camera stands in for what a prior leaves open.
Pose PoseOfPrior(const PosePrior& prior, const ViewInput& view) {
  const Eigen::Vector2d xy = prior.position_in_world - view.model.origin_in_world.head<2>();
  double height = 0.0;
  if (prior.height_in_world) {
    height = *prior.height_in_world - view.model.origin_in_world.z();
  } else {
    const auto terrain = view.dtm ? view.dtm->HeightAt(xy) : std::nullopt;
    if (!terrain)
      throw InputError("prior", "position", "no height", "a height, or a DTM that covers it");
    height = *terrain + 1.7;
  }
  Pose pose;
  pose.center_in_world = {xy.x(), xy.y(), height};
  pose.cam_from_world = CamFromWorld(ViewAngles{prior.heading_deg.value_or(0.0),
                                                prior.pitch_deg.value_or(0.0),
                                                prior.roll_deg.value_or(0.0)});
  return pose;
}

cv::Mat ReadPhoto(const fs::path& path, const CameraIntrinsics& camera) {
  ReadFile(path);  // says what is wrong with the file itself
  const cv::Mat photo = cv::imread(path.string(), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (photo.empty()) throw InputError(path.string(), "", "no picture", "a JPEG, PNG or TIFF file");
  if (photo.cols != camera.width || photo.rows != camera.height) {
    throw InputError(path.string(),
                     "",
                     std::to_string(photo.cols) + " x " + std::to_string(photo.rows) + " px",
                     "the camera's " + std::to_string(camera.width) + " x " +
                         std::to_string(camera.height) + " px");
  }
  return UndistortImage(photo, camera);
}

}  // namespace

void AddViewOptions(CLI::App& command, ViewArguments& arguments) {
  command.add_option("--dataset", arguments.dataset, "dataset.json to take a query from");
  command.add_option("--query", arguments.query, "Its id");
  command.add_option("--at", arguments.at, "The query's pose")
      ->check(CLI::IsMember({"truth", "prior"}))
      ->capture_default_str();
  command.add_option("--model", arguments.model, "City model files or folders")->type_name("PATH");
  command.add_option("--dtm", arguments.dtm, "Terrain raster");
  command.add_option("--image", arguments.image, "Photo to draw on");
  command.add_option("--camera", arguments.camera, "Camera file (JSON)");
  command.add_option("--pose", arguments.pose, "Pose file, or E,N,H,HEADING,PITCH,ROLL");
}

std::unique_ptr<ViewInput> ReadView(const ViewArguments& arguments, int threads) {
  const Named named = Resolve(arguments);
  auto view = std::make_unique<ViewInput>();
  if (named.image) view->photo = ReadPhoto(*named.image, *named.camera);
  view->camera = named.camera->Pinhole();
  CityOptions city;
  city.model_crs = named.model_crs;
  city.threads = threads;
  view->model = ReadCity(named.model, city);
  view->warnings = view->model.warnings;
  if (named.dtm) {
    Eigen::Vector2d lower = view->model.vertices.front().head<2>();
    Eigen::Vector2d upper = lower;
    for (const Eigen::Vector3d& vertex : view->model.vertices) {
      lower = lower.cwiseMin(vertex.head<2>());
      upper = upper.cwiseMax(vertex.head<2>());
    }
    view->dtm = ReadDtm(*named.dtm, view->model, lower, upper, 100.0, view->warnings);
  }
  view->scene =
      std::make_unique<Scene>(view->model, view->dtm ? &*view->dtm : nullptr, ProjectionOptions{});
  if (named.pose) {
    view->cam_from_local = *named.pose;
    view->cam_from_local.center_in_world -= view->model.origin_in_world;
  } else {
    view->cam_from_local = PoseOfPrior(*named.prior, *view);
  }
  return view;
}

}  // namespace ridgeline
