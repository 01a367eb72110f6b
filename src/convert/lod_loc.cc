// SPDX-License-Identifier: Apache-2.0
#include "convert/lod_loc.h"

#include <map>
#include <system_error>

#include "convert/visual_localization.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

std::map<std::string, Pose> PosesIn(const fs::path& file, const ConvertOptions& options) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  const auto list = ReadPoseList(file, options);
  return {list.begin(), list.end()};
}

PosePrior PriorOf(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  PosePrior prior;
  prior.position_in_world = pose.center_in_world.head<2>();
  prior.height_in_world = pose.center_in_world.z();
  prior.heading_deg = angles.heading_deg;
  prior.pitch_deg = angles.pitch_deg;
  prior.roll_deg = angles.roll_deg;
  return prior;
}

}  // namespace

Dataset ReadLodLoc(const fs::path& folder, const ConvertOptions& options) {
  const fs::path absolute = fs::absolute(folder / "intrinsic.txt").lexically_normal();
  Dataset dataset;
  dataset.name = absolute.parent_path().parent_path().filename().string() + "-" +
                 absolute.parent_path().filename().string();
  const auto truths = PosesIn(folder / "GT_pose.txt", options);
  const auto priors = PosesIn(folder / "GPS_pose.txt", options);
  for (auto& [name, camera] : ReadCameraList(folder / "intrinsic.txt")) {
    Query query;
    query.image = fs::path("Query_image") / name;
    query.camera = std::move(camera);
    if (const auto it = truths.find(name); it != truths.end()) query.truth = it->second;
    if (const auto it = priors.find(name); it != priors.end()) query.prior = PriorOf(it->second);
    dataset.queries.push_back(std::move(query));
  }
  return dataset;
}

}  // namespace ridgeline
