// SPDX-License-Identifier: Apache-2.0
#include "convert/results.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/json_input.h"
#include "camera/check_pose.h"
#include "convert/text_lines.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

void Add(const std::string& id, const std::string& image, const Pose& pose, Dataset& dataset) {
  Query query;
  query.id = id;
  query.image = image;
  query.truth = pose;
  dataset.queries.push_back(std::move(query));
}

void ReadCsv(const fs::path& file, Dataset& dataset) {
  const std::vector<TextLine> lines = ReadLines(file, ',');
  constexpr std::array kWanted = {"query", "e", "n", "h", "qw", "qx", "qy", "qz"};
  std::array<std::size_t, kWanted.size()> places{};
  for (std::size_t c = 0; c < kWanted.size(); ++c) {
    std::size_t place = 0;
    while (!lines.empty() && place < lines[0].size() && lines[0][place] != kWanted[c]) ++place;
    if (lines.empty() || place == lines[0].size()) {
      throw InputError(file.string(),
                       "line 1",
                       std::string("no column \"") + kWanted[c] + "\"",
                       "columns query,e,n,h,qw,qx,qy,qz");
    }
    places[c] = place;
  }
  std::set<std::string> seen;
  for (std::size_t l = 1; l < lines.size(); ++l) {
    const TextLine& line = lines[l];
    if (!IsData(line)) continue;
    const std::string id = line[places[0]];
    const bool abstained = places[1] < line.size() && line[places[1]].empty();
    if (abstained || !seen.insert(id).second) continue;
    const Eigen::Vector3d center(
        line.Number(places[1], "e"), line.Number(places[2], "n"), line.Number(places[3], "h"));
    Eigen::Quaterniond q(line.Number(places[4], "qw"),
                         line.Number(places[5], "qx"),
                         line.Number(places[6], "qy"),
                         line.Number(places[7], "qz"));
    Add(id, id, Pose{q.normalized(), center}, dataset);
  }
}

void ReadPosesText(const fs::path& file, const ConvertOptions& options, Dataset& dataset) {
  const std::vector<TextLine> lines = ReadLines(file);
  const Eigen::Vector3d origin = options.origin.value_or(OriginIn(lines));
  std::set<std::string> seen;
  for (const TextLine& line : lines) {
    if (!IsData(line)) continue;
    if (line.size() != 9) {
      line.Fail(std::to_string(line.size()) + " columns", "query seed qw qx qy qz tx ty tz");
    }
    line.Integer(1, "seed");
    const Eigen::Quaterniond q = line.Quaternion(2);
    const Eigen::Vector3d t(line.Number(6, "tx"), line.Number(7, "ty"), line.Number(8, "tz"));
    if (!seen.insert(line[0]).second) continue;
    Add(line[0], line[0], Pose{q, origin - q.normalized().conjugate() * t}, dataset);
  }
}

void ReadPoseJson(const fs::path& file, Dataset& dataset) {
  const Json json = ParseJson(ReadFile(file), file.string());
  const auto fail = [&](const char* field, const char* expected) {
    throw InputError(file.string(), field, "nothing usable", expected);
  };
  if (!json.is_object() || !json.contains("status")) fail("status", "a pose.json of localize");
  if (!json.contains("pose")) {
    fail("pose", "a pose; this run abstained");
  }
  const Json& pose = json["pose"];
  const auto numbers = [&](const char* key, std::size_t count) {
    const auto it = pose.find(key);
    const bool valid =
        it != pose.end() && it->is_array() && it->size() == count &&
        std::all_of(it->begin(), it->end(), [](const Json& v) { return v.is_number(); });
    if (!valid) fail(key, count == 3 ? "three numbers" : "four numbers");
    return it->get<std::vector<double>>();
  };
  const std::vector<double> p = numbers("position", 3);
  const std::vector<double> q = numbers("cam_from_world_wxyz", 4);
  if (json.contains("crs") && json["crs"].is_string() && json["crs"] != "no CRS") {
    dataset.crs = json["crs"].get<std::string>();
  }
  const auto named = json.find("picture");
  const std::string picture =
      named != json.end() && named->is_string() ? named->get<std::string>() : "";
  const Pose found{UnitQuaternion(q, file.string(), "cam_from_world_wxyz"), {p[0], p[1], p[2]}};
  Add(fs::path(picture).stem().string(), picture, found, dataset);
}

}  // namespace

Dataset ReadResults(const fs::path& file, const ConvertOptions& options) {
  Dataset dataset;
  dataset.file = file;
  dataset.name = file.stem().string();
  dataset.crs = options.crs;
  if (file.extension() == ".json") {
    ReadPoseJson(file, dataset);
  } else if (file.extension() == ".csv") {
    ReadCsv(file, dataset);
  } else {
    ReadPosesText(file, options, dataset);
  }
  if (dataset.queries.empty()) throw InputError(file.string(), "", "no pose", "at least one pose");
  return dataset;
}

}  // namespace ridgeline
