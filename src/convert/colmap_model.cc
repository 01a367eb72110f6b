// SPDX-License-Identifier: Apache-2.0
#include "convert/colmap_model.h"

#include <algorithm>
#include <map>
#include <system_error>

#include "base/atomic_file.h"
#include "base/decimals.h"
#include "base/error.h"
#include "convert/text_lines.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

std::string Words(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + ShortestText(number);
  return text;
}

std::map<int, CameraIntrinsics> ReadCameras(const fs::path& file) {
  std::map<int, CameraIntrinsics> cameras;
  for (const TextLine& line : ReadLines(file)) {
    if (!IsData(line)) continue;
    if (line.size() < 5) {
      line.Fail(std::to_string(line.size()) + " columns", "CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]");
    }
    CameraIntrinsics camera;
    camera.model = line[1];
    camera.width = line.Integer(2, "WIDTH");
    camera.height = line.Integer(3, "HEIGHT");
    for (std::size_t i = 4; i < line.size(); ++i) camera.params.push_back(line.Number(i, "PARAMS"));
    camera.Validate(file.string(), "line " + std::to_string(line.number()));
    if (!cameras.emplace(line.Integer(0, "CAMERA_ID"), camera).second) {
      line.Fail("camera " + line[0] + " again", "ids that differ");
    }
  }
  if (cameras.empty()) throw InputError(file.string(), "", "no camera", "one line per camera");
  return cameras;
}

// Grid of the origins that are chosen here [m].
constexpr double kOriginGrid = 100.0;

Eigen::Vector3d OriginFor(const Dataset& dataset, const ConvertOptions& options) {
  if (options.origin) return *options.origin;
  for (const Query& query : dataset.queries) {
    if (!query.truth) continue;
    return (query.truth->center_in_world / kOriginGrid).array().round().matrix() * kOriginGrid;
  }
  return Eigen::Vector3d::Zero();
}

// The system that WriteColmapModel noted behind the origin.
std::string CrsIn(const std::vector<TextLine>& lines) {
  for (const TextLine& line : lines) {
    if (line.size() == 9 && line[0] == "#" && line[1] == "origin") return line[8];
  }
  return {};
}

bool AreEqual(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  return a.model == b.model && a.width == b.width && a.height == b.height && a.params == b.params;
}

}  // namespace

Dataset ReadColmapModel(const fs::path& folder, const ConvertOptions& options) {
  const std::map<int, CameraIntrinsics> cameras = ReadCameras(folder / "cameras.txt");
  const fs::path file = folder / "images.txt";
  const std::vector<TextLine> lines = ReadLines(file);
  const Eigen::Vector3d origin = options.origin.value_or(OriginIn(lines));
  Dataset dataset;
  dataset.name = fs::absolute(folder).lexically_normal().filename().string();
  dataset.crs = CrsIn(lines);
  // Every picture has two lines; the second one, its points, may be empty.
  bool is_points = false;
  for (const TextLine& line : lines) {
    if (is_points) {
      if (line.size() % 3 != 0) {
        line.Fail(std::to_string(line.size()) + " columns",
                  "the points of the picture above: X Y POINT3D_ID, again and again, or nothing");
      }
      is_points = false;
      continue;
    }
    if (!IsData(line)) continue;
    if (line.size() < 10) {
      line.Fail(std::to_string(line.size()) + " columns",
                "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    }
    line.Integer(0, "IMAGE_ID");
    const auto camera = cameras.find(line.Integer(8, "CAMERA_ID"));
    if (camera == cameras.end()) line.Fail("camera " + line[8], "a camera of cameras.txt");
    Query query;
    query.image = line.Rest(9);
    query.camera = camera->second;
    const Eigen::Quaterniond q = line.Quaternion(1);
    const Eigen::Vector3d t(line.Number(5, "TX"), line.Number(6, "TY"), line.Number(7, "TZ"));
    query.truth = Pose{q, origin - q.normalized().conjugate() * t};
    dataset.queries.push_back(std::move(query));
    is_points = true;
  }
  if (dataset.queries.empty()) {
    throw InputError(file.string(), "", "no picture", "two lines per picture");
  }
  return dataset;
}

std::size_t WriteColmapModel(const Dataset& dataset,
                             const ConvertOptions& options,
                             const fs::path& folder) {
  const Eigen::Vector3d origin = OriginFor(dataset, options);
  std::vector<CameraIntrinsics> cameras;
  std::string images;
  std::size_t count = 0;
  for (const Query& query : dataset.queries) {
    if (!query.truth) continue;
    if (!query.camera) {
      throw InputError(dataset.file.string(),
                       "query " + query.id,
                       "no camera",
                       "a camera, which COLMAP's models need (--camera FILE)");
    }
    auto camera = std::find_if(cameras.begin(), cameras.end(), [&](const CameraIntrinsics& c) {
      return AreEqual(c, *query.camera);
    });
    if (camera == cameras.end()) camera = cameras.insert(cameras.end(), *query.camera);
    const Eigen::Quaterniond& q = query.truth->cam_from_world;
    const Eigen::Vector3d t = -(q.normalized() * (query.truth->center_in_world - origin));
    images += std::to_string(++count) + ' ' + Words({q.w(), q.x(), q.y(), q.z()}) + ' ' +
              Words({t.x(), t.y(), t.z()}) + ' ' + std::to_string(camera - cameras.begin() + 1) +
              ' ' + query.image.generic_string() + "\n\n";
  }
  std::string camera_lines;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    camera_lines += std::to_string(c + 1) + ' ' + cameras[c].model + ' ' +
                    std::to_string(cameras[c].width) + ' ' + std::to_string(cameras[c].height);
    for (const double param : cameras[c].params) camera_lines += ' ' + ShortestText(param);
    camera_lines += '\n';
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "", error.message(), "a folder");
  const std::string cameras_text =
      "# Camera list with one line of data per camera:\n"
      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
      "# Number of cameras: " +
      std::to_string(cameras.size()) + "\n" + camera_lines;
  const std::string points_text =
      "# 3D point list with one line of data per point:\n"
      "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
      "# Number of points: 0\n";
  const std::string images_text =
      "# Image list with two lines of data per image:\n"
      "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
      "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
      "# Number of images: " +
      std::to_string(count) + "\n# origin " + Words({origin.x(), origin.y(), origin.z()}) +
      " east north height" + (dataset.crs.empty() ? "" : " " + dataset.crs) + "\n" + images;
  WriteFilesAtomically({{folder / "cameras.txt", cameras_text},
                        {folder / "points3D.txt", points_text},
                        {folder / "images.txt", images_text}});
  return count;
}

}  // namespace ridgeline
