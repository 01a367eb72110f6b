// SPDX-License-Identifier: Apache-2.0
#include "convert/egeniouss.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>
#include <system_error>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/random.h"
#include "convert/camera_file.h"
#include "convert/text_lines.h"
#include "input/read_picture.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// Half a turn about the right axis: photogrammetric camera axes to ours and back.
const Eigen::Quaterniond kCamFromPhoto(0.0, 1.0, 0.0, 0.0);

struct NamedPose {
  std::string name;
  Pose pose;
};

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool IsPicture(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  for (const char* known : {".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp"}) {
    if (extension == known) return true;
  }
  return false;
}

// The list QUERY_IMAGES/NAME with whichever of the two endings it has; empty if there is none.
std::optional<fs::path> ListIn(const fs::path& query_images, const std::string& name) {
  for (const char* ending : {".txt", ".csv"}) {
    const fs::path file = query_images / (name + ending);
    if (IsFile(file)) return file;
  }
  return std::nullopt;
}

// Blanks, or commas where the first line of data has one.
std::vector<TextLine> ReadPoseLines(const fs::path& file) {
  std::vector<TextLine> lines = ReadLines(file);
  const auto first = std::find_if(lines.begin(), lines.end(), IsData);
  if (first == lines.end() || first->text().find(',') == std::string::npos) return lines;
  return ReadLines(file, ',');
}

std::vector<NamedPose> ReadPoses(const fs::path& file, const ConvertOptions& options) {
  const Eigen::Vector3d origin = options.origin.value_or(Eigen::Vector3d::Zero());
  std::vector<NamedPose> poses;
  bool at_start = true;
  for (const TextLine& line : ReadPoseLines(file)) {
    if (!IsData(line)) continue;
    const bool header = at_start && line.size() >= 2 && line[1] == "qw";
    at_start = false;
    if (header) continue;
    if (line.size() < 8) {
      line.Fail(std::to_string(line.size()) + " columns",
                "image_name qw qx qy qz UTM_east UTM_north altitude");
    }
    const Eigen::Quaterniond world_from_photo = line.Quaternion(1);
    const Eigen::Vector3d center(
        line.Number(5, "UTM_east"), line.Number(6, "UTM_north"), line.Number(7, "altitude"));
    poses.push_back({line[0], Pose{kCamFromPhoto * world_from_photo.conjugate(), origin + center}});
  }
  if (poses.empty()) {
    throw InputError(file.string(),
                     "",
                     "no pose",
                     "lines \"image_name qw qx qy qz UTM_east UTM_north altitude\"");
  }
  return poses;
}

std::map<std::string, Pose> PosesByName(const std::optional<fs::path>& file,
                                        const ConvertOptions& options) {
  std::map<std::string, Pose> poses;
  if (!file) return poses;
  for (const NamedPose& named : ReadPoses(*file, options)) {
    poses[fs::path(named.name).filename().string()] = named.pose;
  }
  return poses;
}

const Pose* Find(const std::map<std::string, Pose>& poses, const fs::path& picture) {
  auto it = poses.find(picture.filename().string());
  if (it == poses.end()) it = poses.find(picture.stem().string());
  return it == poses.end() ? nullptr : &it->second;
}

std::vector<fs::path> PicturesIn(const fs::path& folder) {
  std::vector<fs::path> pictures;
  if (!IsFolder(folder)) return pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && IsPicture(entry.path())) pictures.push_back(entry.path());
  }
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

// What a folder named on the command line stands for.
struct Layout {
  fs::path named;
  fs::path root;
  std::vector<std::string> sets;
};

std::optional<Layout> LayoutOf(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder / "").lexically_normal().parent_path();
  if (IsFolder(whole / "query_images")) return Layout{whole, whole, {"val", "test"}};
  const std::string name = whole.filename().string();
  const bool is_set =
      (name == "val" || name == "test") && whole.parent_path().filename() == "query_images";
  if (!is_set) return std::nullopt;
  return Layout{whole, whole.parent_path().parent_path(), {name}};
}

std::string Text(double value) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::string PoseLine(const std::string& name, const Pose& pose) {
  const Eigen::Quaterniond q = pose.cam_from_world.conjugate() * kCamFromPhoto;
  const Eigen::Vector3d& c = pose.center_in_world;
  std::string line = name;
  for (const double value : {q.w(), q.x(), q.y(), q.z(), c.x(), c.y(), c.z()}) {
    line += ' ' + Text(value);
  }
  return line + '\n';
}

constexpr const char* kHead = "# IMAGE_NAME qw qx qy qz UTMx UTMy alt\n";

// What a phone makes of a pose: metres off, the height more so, the heading worth nothing.
Pose PhonePose(const Pose& truth, std::uint64_t seed, const std::string& id) {
  constexpr double kPositionSigmaM = 5.0;
  constexpr double kAltitudeSigmaM = 15.0;
  constexpr double kTiltSigmaDeg = 2.0;
  Random random(seed, HashText("android"), HashText(id));
  ViewAngles angles = ViewAnglesOf(truth.cam_from_world);
  angles.heading_deg = random.Uniform(0.0, 360.0);
  angles.pitch_deg += kTiltSigmaDeg * random.Normal();
  angles.roll_deg += kTiltSigmaDeg * random.Normal();
  const Eigen::Vector3d error(kPositionSigmaM * random.Normal(),
                              kPositionSigmaM * random.Normal(),
                              kAltitudeSigmaM * random.Normal());
  return {CamFromWorld(angles), truth.center_in_world + error};
}

std::string CameraText(const CameraIntrinsics& camera) {
  const PinholeCamera pinhole = camera.Pinhole();
  std::string text = "# pixels; (0, 0) is the upper left corner of the picture\n";
  text += "image size " + std::to_string(camera.width) + " x " + std::to_string(camera.height);
  text += "\nfx " + Text(pinhole.fx) + "\nfy " + Text(pinhole.fy);
  return text + "\ncx " + Text(pinhole.cx) + "\ncy " + Text(pinhole.cy) + "\n";
}

}  // namespace

bool IsEgenioussFolder(const fs::path& folder) {
  const auto layout = LayoutOf(folder);
  return layout && IsFile(layout->root / "metadata" / "camera_parameters.txt");
}

Dataset ReadEgeniouss(const fs::path& folder, const ConvertOptions& options) {
  const auto layout = LayoutOf(folder);
  if (!layout) {
    throw InputError(folder.string(),
                     "",
                     "no query_images folder",
                     "the folder of egenioussBench, or its query_images/val or /test");
  }
  const fs::path query_images = layout->root / "query_images";
  Dataset dataset;
  dataset.name = "egenioussbench";
  dataset.crs = options.crs;
  if (IsFolder(layout->root / "lod2")) dataset.model = {layout->root / "lod2"};
  if (IsFile(layout->root / "dtm.tif")) dataset.dtm = layout->root / "dtm.tif";
  std::optional<CameraFile> cameras;
  for (const std::string& set : layout->sets) {
    const auto truths = PosesByName(ListIn(query_images, set + "_gt_poses"), options);
    const auto priors = PosesByName(ListIn(query_images, set + "_android_poses"), options);
    for (const fs::path& picture : PicturesIn(query_images / set)) {
      if (!options.camera && !cameras) {
        const cv::Mat first = ReadPicture(picture);
        cameras = ReadCameraFile(
            layout->root / "metadata" / "camera_parameters.txt", first.cols, first.rows);
      }
      Query query;
      query.set = set;
      query.image = picture.lexically_relative(layout->named);
      query.camera = options.camera;
      if (!query.camera) query.camera = cameras->Of(picture.filename().string());
      if (const Pose* truth = Find(truths, picture)) query.truth = *truth;
      if (const Pose* prior = Find(priors, picture)) {
        query.prior.emplace();
        query.prior->position_in_world = prior->center_in_world.head<2>();
      }
      dataset.queries.push_back(std::move(query));
    }
  }
  if (dataset.queries.empty()) {
    throw InputError(query_images.string(), "", "no picture", "pictures in val and test");
  }
  return dataset;
}

std::string EgenioussPoses(const Dataset& dataset) {
  std::string text = kHead;
  for (const Query& query : dataset.queries) {
    if (query.truth) text += PoseLine(query.image.filename().string(), *query.truth);
  }
  return text;
}

void WriteEgenioussFolder(const Dataset& dataset, std::uint64_t seed, const fs::path& folder) {
  const fs::path query_images = folder / "query_images";
  for (const fs::path& made : {folder / "lod2",
                               folder / "mesh",
                               folder / "metadata",
                               query_images / "val",
                               query_images / "test"}) {
    fs::create_directories(made);
  }
  for (const fs::path& model : dataset.model) {
    fs::copy(model, folder / "lod2" / model.filename(), fs::copy_options::recursive);
  }
  if (dataset.dtm) fs::copy(*dataset.dtm, folder / "dtm.tif");
  const CameraIntrinsics& camera = dataset.queries.front().camera.value();
  const std::size_t tests = std::max<std::size_t>(1, dataset.queries.size() / 4);
  std::string truths = kHead;
  std::array<std::string, 2> phones = {kHead, kHead};
  for (std::size_t i = 0; i < dataset.queries.size(); ++i) {
    const Query& query = dataset.queries[i];
    if (query.camera->params != camera.params || query.camera->width != camera.width) {
      throw InputError(dataset.file.string(), query.id, "another camera", "one for all pictures");
    }
    const bool is_test = i + tests >= dataset.queries.size();
    const std::string name = query.image.filename().string();
    fs::copy(query.image, query_images / (is_test ? "test" : "val") / name);
    if (!is_test) truths += PoseLine(name, *query.truth);
    phones[is_test ? 1 : 0] += PoseLine(name, PhonePose(*query.truth, seed, query.id));
  }
  WriteFileAtomically(folder / "metadata" / "camera_parameters.txt", CameraText(camera));
  WriteFileAtomically(query_images / "val_gt_poses.txt", truths);
  WriteFileAtomically(query_images / "val_android_poses.txt", phones[0]);
  WriteFileAtomically(query_images / "test_android_poses.csv", phones[1]);
}

}  // namespace ridgeline
