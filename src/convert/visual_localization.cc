// SPDX-License-Identifier: Apache-2.0
#include "convert/visual_localization.h"

#include <algorithm>
#include <cctype>

#include "base/error.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// A camera's line has the name of its model where a pose's has a number.
bool IsCamera(const TextLine& line) {
  return line.size() >= 2 && std::isalpha(static_cast<unsigned char>(line[1].front())) != 0;
}

std::vector<TextLine> DataOf(const std::vector<TextLine>& lines, const fs::path& file) {
  std::vector<TextLine> data;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(data), IsData);
  if (data.empty()) {
    throw InputError(file.string(),
                     "",
                     "an empty list",
                     "lines \"name qw qx qy qz tx ty tz\" or \"name MODEL width height params\"");
  }
  return data;
}

}  // namespace

std::vector<std::pair<std::string, Pose>> ReadPoseList(const fs::path& file,
                                                       const ConvertOptions& options) {
  const std::vector<TextLine> lines = ReadLines(file);
  const Eigen::Vector3d origin = options.origin.value_or(OriginIn(lines));
  std::vector<std::pair<std::string, Pose>> poses;
  for (const TextLine& line : DataOf(lines, file)) {
    if (line.size() != 8) {
      line.Fail(std::to_string(line.size()) + " columns", "name qw qx qy qz tx ty tz");
    }
    const Eigen::Quaterniond q = line.Quaternion(1);
    const Eigen::Vector3d t(line.Number(5, "tx"), line.Number(6, "ty"), line.Number(7, "tz"));
    poses.emplace_back(line[0], Pose{q, origin - q.normalized().conjugate() * t});
  }
  return poses;
}

std::vector<std::pair<std::string, CameraIntrinsics>> ReadCameraList(const fs::path& file) {
  std::vector<std::pair<std::string, CameraIntrinsics>> cameras;
  for (const TextLine& line : DataOf(ReadLines(file), file)) {
    if (!IsCamera(line) || line.size() < 5) {
      line.Fail("\"" + line.text() + "\"", "name MODEL width height params");
    }
    CameraIntrinsics camera;
    camera.model = line[1];
    camera.width = line.Integer(2, "width");
    camera.height = line.Integer(3, "height");
    for (std::size_t i = 4; i < line.size(); ++i) camera.params.push_back(line.Number(i, "params"));
    camera.Validate(file.string(), "line " + std::to_string(line.number()));
    cameras.emplace_back(line[0], camera);
  }
  return cameras;
}

Dataset ReadVisualLocalizationList(const fs::path& file, const ConvertOptions& options) {
  Dataset dataset;
  dataset.name = file.stem().string();
  if (IsCamera(DataOf(ReadLines(file), file).front())) {
    for (auto& [name, camera] : ReadCameraList(file)) {
      Query query;
      query.image = name;
      query.camera = std::move(camera);
      dataset.queries.push_back(std::move(query));
    }
    return dataset;
  }
  for (const auto& [name, pose] : ReadPoseList(file, options)) {
    Query query;
    query.image = name;
    query.camera = options.camera;
    query.truth = pose;
    dataset.queries.push_back(std::move(query));
  }
  return dataset;
}

}  // namespace ridgeline
