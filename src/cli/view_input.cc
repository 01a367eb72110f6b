// SPDX-License-Identifier: Apache-2.0
#include "cli/view_input.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/json_input.h"
#include "camera/check_pose.h"
#include "camera/local_frame.h"
#include "city/crs.h"
#include "input/picture_input.h"
#include "input/prior_pose.h"
#include "input/read_picture.h"
#include "input/world.h"
#include "localize/localizer.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

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

// A pose file: "position" and "cam_from_world_wxyz", at the top or in "pose"; its "crs" becomes the
// dataset's.
Pose ReadPoseFile(const fs::path& path, Dataset& dataset) {
  const nlohmann::json json = ParseJson(ReadFile(path), path.string());
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
  if (json.contains("crs") && json["crs"].is_string()) {
    const std::string name = json["crs"];
    const std::optional<Crs> crs = ParseCrs(name);
    const std::optional<Crs> wanted = ParseCrs(dataset.crs);
    if (crs && wanted && crs->horizontal_epsg != wanted->horizontal_epsg) {
      throw InputError(path.string(), "crs", name, dataset.crs + ", as the rest");
    }
    if (crs && !wanted) dataset.crs = name;
  }
  Pose result;
  result.center_in_world = {position[0], position[1], position[2]};
  CheckPlace(result.center_in_world, path.string(), "position");
  result.cam_from_world = UnitQuaternion(q, path.string(), "cam_from_world_wxyz");
  return result;
}

Pose ParsePose(const std::string& text, Dataset& dataset) {
  const std::vector<double> values = CommaNumbers(text);
  if (values.empty()) return ReadPoseFile(text, dataset);
  if (values.size() != 6) {
    throw InputError(
        "--pose", "", "\"" + text + "\"", "east,north,height,heading,pitch,roll or a pose file");
  }
  for (std::size_t i = 3; i < values.size(); ++i) {
    if (std::abs(values[i]) <= 360.0) continue;
    throw InputError("--pose", "", "\"" + text + "\"", "angles in degrees, -360 to 360");
  }
  Pose pose;
  pose.center_in_world = {values[0], values[1], values[2]};
  CheckPlace(pose.center_in_world, "--pose", "");
  pose.cam_from_world = CamFromWorld(ViewAngles{values[3], values[4], values[5]});
  return pose;
}

// Where the camera is to be: a pose, or a prior that the terrain completes.
struct Place {
  std::optional<Pose> pose;  // world
  std::optional<PosePrior> prior;
};

Place PlaceOf(const ViewArguments& arguments, Dataset& dataset) {
  const Query& query = dataset.queries.front();
  Place place;
  if (!arguments.pose.empty()) {
    if (!arguments.at.empty()) {
      throw InputError("--at", "", "\"" + arguments.at + "\" beside --pose", "one of the two");
    }
    place.pose = ParsePose(arguments.pose, dataset);
    return place;
  }
  if (arguments.query.dataset.empty() && !arguments.at.empty()) {
    throw InputError("--at", "", "\"" + arguments.at + "\" without a query", "--dataset FILE");
  }
  if (arguments.at == "prior") {
    place.prior = query.prior;
  } else {
    place.pose = query.truth;
  }
  return place;
}

// Camera, and the prior that is to be looked from, as the picture tells them where nothing else
// does.
void TakeFromPicture(const ViewArguments& arguments,
                     PictureReader& pictures,
                     Dataset& dataset,
                     Place& place) {
  Query& query = dataset.queries.front();
  const bool at_prior = arguments.at == "prior";
  if (query.image.empty()) {
    if (!query.camera) {
      throw InputError("--camera", "", "nothing", "a camera file, or a picture that tells its own");
    }
    return;
  }
  std::optional<Crs> crs;
  CompleteFromPicture(dataset, at_prior, PictureInputOptions{}, pictures, crs, query);
  if (at_prior) place.prior = query.prior;
}

// The request for a model as a whole and the terrain about the place.
WorldRequest RequestOf(const Dataset& dataset, const Place& place, int threads) {
  WorldRequest request;
  request.model = dataset.model;
  request.dtm = dataset.dtm;
  request.crs = dataset.crs;
  request.whole_model = true;
  request.needs_terrain = place.prior && !place.prior->height_in_world;
  request.threads = threads;
  if (place.prior) request.places.extend(place.prior->position_in_world);
  if (place.pose) request.places.extend(Eigen::Vector2d(place.pose->center_in_world.head<2>()));
  return request;
}

}  // namespace

void AddViewOptions(CLI::App& command, ViewArguments& arguments) {
  AddQueryOptions(command, arguments.query);
  command.add_option("--at", arguments.at, "The query's pose [truth]")
      ->check(CLI::IsMember({"truth", "prior"}));
  command.add_option("--image", arguments.query.image, "Photo to draw on");
  command.add_option("--pose", arguments.pose, "Pose file, or E,N,H,HEADING,PITCH,ROLL");
}

std::unique_ptr<ViewInput> ReadView(const ViewArguments& arguments, int threads) {
  Dataset dataset = ReadQuery(arguments.query);
  Place place = PlaceOf(arguments, dataset);
  PictureReader pictures;
  TakeFromPicture(arguments, pictures, dataset, place);
  if (!place.pose && !place.prior) {
    throw InputError("--pose",
                     "",
                     arguments.query.dataset.empty()
                         ? "nothing"
                         : "a query without " + (arguments.at.empty() ? "truth" : arguments.at),
                     "east,north,height,heading,pitch,roll or a pose file");
  }
  const Query& query = dataset.queries.front();
  auto view = std::make_unique<ViewInput>();
  view->assumptions = query.assumptions;
  view->camera = query.camera->Pinhole();
  if (!query.image.empty()) {
    view->photo = UndistortImage(BgrOf(pictures.Read(query)), *query.camera);
  }
  World world = ReadWorld(RequestOf(dataset, place, threads));
  view->model = std::move(world.model);
  view->dtm = std::move(world.dtm);
  view->warnings = std::move(world.warnings);
  view->scene =
      std::make_unique<Scene>(view->model, view->dtm ? &*view->dtm : nullptr, ProjectionOptions{});
  if (place.prior) {
    place.pose = PoseOfPrior(*place.prior,
                             view->dtm ? &*view->dtm : nullptr,
                             view->model.origin_in_world,
                             kCameraHeightM);
    if (!place.pose) {
      throw InputError("prior", "position", "no height", "a height, or a DTM that covers it");
    }
  }
  view->cam_from_local = LocalFrame{view->model.origin_in_world}.FromWorld(*place.pose);
  return view;
}

}  // namespace ridgeline
