// SPDX-License-Identifier: Apache-2.0
#include "convert/dataset_json.h"

#include <nlohmann/json.hpp>

#include "base/decimals.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr int kPositionDecimals = 7;
constexpr int kAngleDecimals = 9;

std::string PathFrom(const fs::path& path, const fs::path& folder) {
  const fs::path absolute = fs::absolute(path).lexically_normal();
  return absolute.lexically_relative(fs::absolute(folder).lexically_normal()).generic_string();
}

double Metres(double value) { return RoundedTo(value, kPositionDecimals); }

OrderedJson CameraJson(const CameraIntrinsics& camera) {
  return {{"model", camera.model},
          {"width", camera.width},
          {"height", camera.height},
          {"params", camera.params}};
}

OrderedJson PriorJson(const PosePrior& prior) {
  OrderedJson json;
  json["position"] = {Metres(prior.position_in_world.x()), Metres(prior.position_in_world.y())};
  if (prior.height_in_world) json["position"].push_back(Metres(*prior.height_in_world));
  const auto angle = [&](const char* key, const std::optional<double>& value) {
    if (value) json[key] = RoundedTo(*value, kAngleDecimals);
  };
  angle("heading_deg", prior.heading_deg);
  angle("pitch_deg", prior.pitch_deg);
  angle("roll_deg", prior.roll_deg);
  return json;
}

OrderedJson TruthJson(const Pose& pose) {
  const Eigen::Vector3d& p = pose.center_in_world;
  const Eigen::Quaterniond& q = pose.cam_from_world;
  return {{"position", {Metres(p.x()), Metres(p.y()), Metres(p.z())}},
          {"cam_from_world_wxyz", {q.w(), q.x(), q.y(), q.z()}}};
}

}  // namespace

std::string DatasetJson(const Dataset& dataset, const fs::path& folder) {
  OrderedJson json;
  json["name"] = dataset.name;
  if (!dataset.crs.empty()) json["crs"] = dataset.crs;
  json["model"] = OrderedJson::array();
  for (const fs::path& model : dataset.model) json["model"].push_back(PathFrom(model, folder));
  if (dataset.dtm) json["dtm"] = PathFrom(*dataset.dtm, folder);
  json["queries"] = OrderedJson::array();
  for (const Query& query : dataset.queries) {
    OrderedJson entry;
    entry["id"] = query.id;
    if (!query.set.empty()) entry["set"] = query.set;
    entry["image"] = PathFrom(query.image, folder);
    if (query.lines) entry["lines"] = PathFrom(*query.lines, folder);
    if (query.camera) entry["camera"] = CameraJson(*query.camera);
    if (query.prior) entry["prior"] = PriorJson(*query.prior);
    if (query.truth) entry["truth"] = TruthJson(*query.truth);
    json["queries"].push_back(std::move(entry));
  }
  return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace ridgeline
