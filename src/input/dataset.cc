// SPDX-License-Identifier: Apache-2.0
#include "input/dataset.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/json_input.h"
#include "base/limits.h"
#include "camera/check_pose.h"
#include "city/format/web_file.h"

namespace ridgeline {
namespace {

using Json = nlohmann::json;

// A JSON value with its place, for messages.
class Node {
 public:
  Node(const Json& json, std::string file, std::string path)
      : json_(json), file_(std::move(file)), path_(std::move(path)) {}

  const std::string& file() const { return file_; }
  const std::string& path() const { return path_; }

  [[noreturn]] void Fail(const std::string& found, const std::string& expected) const {
    throw InputError(file_, path_, found, expected);
  }

  void AllowOnly(std::initializer_list<const char*> keys) const {
    if (!json_.is_object()) Fail(json_.type_name(), "an object { ... }");
    const std::vector<std::string> known(keys.begin(), keys.end());
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      const std::string in_degrees = key.substr(0, key.rfind("_rad")) + "_deg";
      if (key.ends_with("_rad") &&
          std::find(known.begin(), known.end(), in_degrees) != known.end()) {
        throw InputError(file_, Join(key), "radians", "\"" + in_degrees + "\", in degrees");
      }
      throw InputError(
          file_, Join(key), "an unknown key", "e.g. \"" + NearestName(key, known) + "\"");
    }
  }

  bool Has(const std::string& key) const { return json_.is_object() && json_.contains(key); }

  std::optional<Node> Find(const std::string& key) const {
    const auto it = json_.find(key);
    if (it == json_.end()) return std::nullopt;
    return Node(*it, file_, Join(key));
  }

  Node At(const std::string& key) const {
    std::optional<Node> node = Find(key);
    if (!node) throw InputError(file_, Join(key), "nothing", "this key");
    return *node;
  }

  std::string Text() const {
    if (!json_.is_string()) Fail(JsonText(json_), "a text");
    return json_.get<std::string>();
  }

  double Number(double lower = std::numeric_limits<double>::lowest(),
                double upper = std::numeric_limits<double>::max()) const {
    if (!json_.is_number()) Fail(JsonText(json_), "a number");
    const double value = json_.get<double>();
    if (!(value >= lower && value <= upper)) {
      Fail(JsonText(json_), "a number in [" + Short(lower) + ", " + Short(upper) + "]");
    }
    return value;
  }

  int Integer() const {
    const double value = json_.is_number_integer() ? json_.get<double>() : 0.5;
    constexpr double kMost = std::numeric_limits<int>::max();
    if (value != std::floor(value) || std::abs(value) > kMost) {
      Fail(JsonText(json_), "a whole number");
    }
    return json_.get<int>();
  }

  std::vector<double> Numbers(std::size_t count) const {
    std::vector<double> values = Numbers();
    if (values.size() != count) Fail(JsonText(json_), std::to_string(count) + " numbers");
    return values;
  }

  std::vector<double> Numbers() const {
    std::vector<double> values;
    for (const Node& node : List()) values.push_back(node.Number());
    return values;
  }

  std::vector<Node> List() const {
    if (!json_.is_array()) Fail(JsonText(json_), "a list [ ... ]");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < json_.size(); ++i) {
      nodes.emplace_back(json_[i], file_, path_ + "[" + std::to_string(i) + "]");
    }
    return nodes;
  }

 private:
  static std::string Short(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }

  std::string Join(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  const Json& json_;
  std::string file_;
  std::string path_;
};

Json ParseFile(const std::filesystem::path& path) {
  return ParseJson(ReadFile(path), path.string());
}

CameraIntrinsics CameraOf(const Node& node) {
  if (node.Has("position") && !node.Has("params")) {
    node.Fail("a prior", "a camera: model, width, height, params (were the two files exchanged?)");
  }
  node.AllowOnly({"model", "width", "height", "params"});
  CameraIntrinsics camera;
  camera.model = node.At("model").Text();
  camera.width = node.At("width").Integer();
  camera.height = node.At("height").Integer();
  camera.params = node.At("params").Numbers();
  camera.Validate(node.file(), node.path());
  if (std::min(camera.width, camera.height) < limits::kLeastPictureSide) {
    node.Fail(std::to_string(camera.width) + " x " + std::to_string(camera.height) + " px",
              "a camera of pictures of " + std::to_string(limits::kLeastPictureSide) +
                  " px and more on each side");
  }
  return camera;
}

PosePrior PriorOf(const Node& node) {
  if (node.Has("params") && !node.Has("position")) {
    node.Fail("a camera", "a prior: position, heading_deg, ... (were the two files exchanged?)");
  }
  node.AllowOnly({"position", "heading_deg", "pitch_deg", "roll_deg"});
  PosePrior prior;
  const Node position = node.At("position");
  const std::vector<double> values = position.Numbers();
  if (values.size() != 2 && values.size() != 3) {
    position.Fail(std::to_string(values.size()) + " numbers",
                  "[east, north] or [east, north, height]");
  }
  prior.position_in_world = {values[0], values[1]};
  if (values.size() == 3) prior.height_in_world = values[2];
  CheckPlace({values[0], values[1], prior.height_in_world.value_or(0.0)},
             position.file(),
             position.path());
  if (const auto heading = node.Find("heading_deg")) {
    prior.heading_deg = WrapHeadingDeg(heading->Number(-360.0, 360.0));
  }
  if (const auto pitch = node.Find("pitch_deg")) prior.pitch_deg = pitch->Number(-90.0, 90.0);
  if (const auto roll = node.Find("roll_deg")) prior.roll_deg = roll->Number(-180.0, 180.0);
  return prior;
}

Pose TruthOf(const Node& node) {
  node.AllowOnly({"position", "cam_from_world_wxyz"});
  const std::vector<double> center = node.At("position").Numbers(3);
  const Node rotation = node.At("cam_from_world_wxyz");
  Pose pose;
  pose.center_in_world = {center[0], center[1], center[2]};
  CheckPlace(pose.center_in_world, node.file(), node.path() + ".position");
  pose.cam_from_world = UnitQuaternion(rotation.Numbers(4), node.file(), rotation.path());
  return pose;
}

Query QueryOf(const Node& node, const std::filesystem::path& folder) {
  node.AllowOnly({"id", "set", "image", "lines", "camera", "prior", "truth"});
  Query query;
  query.id = node.At("id").Text();
  if (const auto set = node.Find("set")) query.set = set->Text();
  query.image = folder / node.At("image").Text();
  if (const auto lines = node.Find("lines")) query.lines = folder / lines->Text();
  if (const auto camera = node.Find("camera")) query.camera = CameraOf(*camera);
  if (const auto prior = node.Find("prior")) query.prior = PriorOf(*prior);
  if (const auto truth = node.Find("truth")) query.truth = TruthOf(*truth);
  return query;
}

}  // namespace

Dataset ReadDataset(const std::filesystem::path& given) {
  const std::filesystem::path path =
      std::filesystem::is_directory(given) ? given / "dataset.json" : given;
  const Json json = ParseFile(path);
  const Node root(json, path.string(), "");
  root.AllowOnly({"name", "crs", "model", "dtm", "queries"});
  const std::filesystem::path folder = path.parent_path();

  Dataset dataset;
  dataset.file = path;
  dataset.name = root.At("name").Text();
  if (const auto crs = root.Find("crs")) dataset.crs = crs->Text();
  const auto place = [&](const std::string& text) {
    return IsWebAddress(text) ? std::filesystem::path(text) : folder / text;
  };
  for (const Node& model : root.At("model").List()) dataset.model.push_back(place(model.Text()));
  if (dataset.model.empty()) root.At("model").Fail("an empty list", "at least one model file");
  if (const auto dtm = root.Find("dtm")) dataset.dtm = place(dtm->Text());
  std::set<std::string> ids;
  for (const Node& node : root.At("queries").List()) {
    dataset.queries.push_back(QueryOf(node, folder));
    if (!ids.insert(dataset.queries.back().id).second) {
      node.Fail("the id \"" + dataset.queries.back().id + "\" again", "ids that differ");
    }
  }
  if (dataset.queries.empty()) root.At("queries").Fail("an empty list", "at least one query");
  return dataset;
}

std::size_t FindQuery(const Dataset& dataset, const std::string& id, const std::string& option) {
  std::vector<std::string> ids;
  for (const Query& query : dataset.queries) {
    if (query.id == id) return ids.size();
    ids.push_back(query.id);
  }
  throw InputError(
      option,
      "",
      id.empty() ? "nothing" : "\"" + id + "\"",
      "a query of " + dataset.file.string() + ", e.g. \"" + NearestName(id, ids) + "\"");
}

PosePrior ReadPrior(const std::filesystem::path& path) {
  const Json json = ParseFile(path);
  return PriorOf(Node(json, path.string(), ""));
}

CameraIntrinsics ReadCamera(const std::filesystem::path& path) {
  const Json json = ParseFile(path);
  return CameraOf(Node(json, path.string(), ""));
}

}  // namespace ridgeline
