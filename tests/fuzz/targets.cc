// SPDX-License-Identifier: Apache-2.0
#include "fuzz/targets.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/json_input.h"
#include "base/options.h"
#include "camera/picture_blocks.h"
#include "camera/picture_facts.h"
#include "city/city_info.h"
#include "city/city_model.h"
#include "city/read_city.h"
#include "city/store/building_blob.h"
#include "city/terrain.h"
#include "convert/camera_file.h"
#include "convert/dataset_formats.h"
#include "eval/bench_files.h"
#include "input/dataset.h"
#include "input/read_picture.h"
#include "lines/segments_file.h"
#include "localize/localizer_options.h"
#include "optim/trace.h"
#include "track/sensors.h"

namespace ridgeline::fuzz {
namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::uint8_t>;

std::string_view TextOf(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Of this process, in memory where the machine has a file system there.
const fs::path& Folder() {
  static const fs::path folder = [] {
    std::error_code error;
    const fs::path memory = "/dev/shm";
    fs::path made = (fs::is_directory(memory, error) ? memory : fs::temp_directory_path()) /
                    ("ridgeline_fuzz_" + std::to_string(::getpid()));
    fs::create_directories(made);
    return made;
  }();
  return folder;
}

fs::path Write(const std::string& name, std::string_view text) {
  const fs::path path = Folder() / name;
  fs::create_directories(path.parent_path());
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  return path;
}

// Inputs of several files are their contents with a line "=====" between.
std::array<std::string_view, 2> Halves(std::string_view text) {
  constexpr std::string_view kBorder = "\n=====\n";
  const std::size_t border = text.find(kBorder);
  if (border == std::string_view::npos) return {text, {}};
  return {text.substr(0, border + 1), text.substr(border + kBorder.size())};
}

CameraIntrinsics Camera() { return {"PINHOLE", 640, 480, {500.0, 500.0, 320.0, 240.0}}; }

void ReadModel(const std::string& name, Bytes bytes) {
  CityOptions options;
  options.threads = 1;
  ReadCity({Write(name, TextOf(bytes))}, options);
}

void Convert(const std::string& name, const std::string& format, Bytes bytes) {
  ConvertOptions options;
  options.crs = "EPSG:25832";
  options.camera = Camera();
  ReadInput(Write(name, TextOf(bytes)), format, options);
}

void ConvertFolder(const std::string& folder,
                   const std::string& first,
                   const std::string& second,
                   const std::string& format,
                   Bytes bytes) {
  const auto [text1, text2] = Halves(TextOf(bytes));
  Write(folder + "/" + first, text1);
  Write(folder + "/" + second, text2);
  ConvertOptions options;
  options.crs = "EPSG:25832";
  options.camera = Camera();
  ReadInput(Folder() / folder, format, options);
}

void FuzzRaster(const std::string& name, Bytes bytes) {
  CityModel model;
  model.crs = {25832, 0};
  model.origin_in_world = {654000.0, 5412000.0, 400.0};
  std::vector<std::string> warnings;
  ReadDtm(Write(name, TextOf(bytes)), model, {-50.0, -50.0}, {50.0, 50.0}, 20.0, warnings);
}

void FuzzStore(Bytes bytes) {
  SourceModel model;
  SourceBuilding building;
  DecodeBuilding(bytes, "store", model, building);
}

void FuzzTrace(Bytes bytes) {
  SearchBox box;
  box.parameters.push_back({"heading_deg", 0.0, 360.0, true});
  ReadTrace(Write("trace.jsonl", TextOf(bytes)), box);
}

void FuzzConfig(Bytes bytes) {
  LocalizerOptions options;
  OptionsFromJson(std::string(TextOf(bytes)), "config.json", [&](OptionVisitor& v) {
    options.Visit(v);
  });
  options.Validate();
}

void FuzzPicture(const std::string& name, Bytes bytes) {
  const fs::path path = Write(name, TextOf(bytes));
  try {
    ReadPicture(path);
  } catch (const InputError&) {
    // What its words say is read all the same.
  }
  ReadPictureFacts(path);
}

constexpr FuzzTarget kTargets[] = {
    {"camera_file",
     [](Bytes b) { ReadCameraFile(Write("camera.txt", TextOf(b)), 640, 480); }},
    {"cityjson", [](Bytes b) { ReadModel("a.city.json", b); }},
    {"cityjsonseq", [](Bytes b) { ReadModel("a.city.jsonl", b); }},
    {"citygml", [](Bytes b) { ReadModel("a.gml", b); }},
    {"colmap",
     [](Bytes b) { ConvertFolder("colmap", "cameras.txt", "images.txt", "colmap", b); }},
    {"config", FuzzConfig},
    {"dataset", [](Bytes b) { ReadDataset(Write("dataset.json", TextOf(b))); }},
    {"egeniouss",
     [](Bytes b) {
       ConvertFolder("egeniouss",
                     "metadata/camera_parameters.txt",
                     "query_images/val_gt_poses.txt",
                     "egeniouss",
                     b);
     }},
    {"exif", [](Bytes b) { FactsOf(ParseExif(TextOf(b)), {}); }},
    {"json", [](Bytes b) { JsonText(ParseJson(TextOf(b), "a.json")); }},
    {"obj", [](Bytes b) { ReadModel("a.obj", b); }},
    {"opensfm", [](Bytes b) { Convert("reconstruction.json", "opensfm", b); }},
    {"opk", [](Bytes b) { Convert("opk.csv", "opk", b); }},
    {"picture", [](Bytes b) { FuzzPicture("picture", b); }},
    {"ply", [](Bytes b) { ReadModel("a.ply", b); }},
    {"poses_csv", [](Bytes b) { ReadPosesCsv(Write("poses.csv", TextOf(b))); }},
    {"prior", [](Bytes b) { ReadPrior(Write("prior.json", TextOf(b))); }},
    {"raster", [](Bytes b) { FuzzRaster("dtm.tif", b); }},
    {"results", [](Bytes b) { Convert("pose.json", "results", b); }},
    {"segments", [](Bytes b) { ReadSegments(Write("lines.txt", TextOf(b)), Camera()); }},
    {"sensors", [](Bytes b) { ReadSensors(Write("sensors.csv", TextOf(b))); }},
    {"store", FuzzStore},
    {"trace", FuzzTrace},
    {"visloc", [](Bytes b) { Convert("list.txt", "visloc", b); }},
    {"xmp", [](Bytes b) { FactsOf({}, ParseXmp(TextOf(b))); }},
};

// Run without what a target says of bad input.
template <std::size_t kIndex>
void RunQuietly(Bytes bytes) {
  try {
    kTargets[kIndex].run(bytes);
  } catch (const InputError&) {
    // The right answer to most bytes.
  }
}

template <std::size_t... kIndices>
constexpr std::array<FuzzTarget, sizeof...(kIndices)> Quiet(std::index_sequence<kIndices...>) {
  return {FuzzTarget{kTargets[kIndices].name, RunQuietly<kIndices>}...};
}

constexpr auto kQuietTargets = Quiet(std::make_index_sequence<std::size(kTargets)>());

}  // namespace

std::span<const FuzzTarget> FuzzTargets() { return kQuietTargets; }

const FuzzTarget* FindFuzzTarget(std::string_view name) {
  const auto it = std::find_if(kQuietTargets.begin(), kQuietTargets.end(), [&](const FuzzTarget& t) {
    return t.name == name;
  });
  return it == kQuietTargets.end() ? nullptr : &*it;
}

}  // namespace ridgeline::fuzz
