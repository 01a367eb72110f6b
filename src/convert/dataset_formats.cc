// SPDX-License-Identifier: Apache-2.0
#include "convert/dataset_formats.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"
#include "convert/angle_table.h"
#include "convert/colmap_model.h"
#include "convert/dataset_json.h"
#include "convert/doubts.h"
#include "convert/egeniouss.h"
#include "convert/globe_files.h"
#include "convert/lod_loc.h"
#include "convert/opensfm.h"
#include "convert/results.h"
#include "convert/text_lines.h"
#include "convert/trajectory.h"
#include "convert/visual_localization.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExpectedFormats =
    "a dataset.json, a COLMAP folder (cameras.txt, images.txt), a LoD-Loc folder (intrinsic.txt), "
    "the folder of egenioussBench, a list of visuallocalization.net, a reconstruction.json of "
    "OpenSfM, a table with omega, phi, kappa, or results of bench or localize (--from FORMAT tells "
    "which)";

std::string FormatOfJson(const fs::path& path) {
  const std::string text = ReadFile(path);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '[') return "opensfm";
  if (text.find("\"queries\"") != std::string::npos) return "dataset";
  if (text.find("\"status\"") != std::string::npos) return "results";
  return "";
}

std::string FormatOfText(const fs::path& path) {
  for (const TextLine& line : ReadLines(path)) {
    std::string lower = line.text();
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) {
      return static_cast<char>(std::tolower(c));
    });
    if (lower.find("omega") != std::string::npos) return "opk";
    if (lower.starts_with("query,") || lower.starts_with("# query seed")) return "results";
    if (!IsData(line)) continue;
    const bool camera =
        line.size() >= 5 && std::isupper(static_cast<unsigned char>(line[1].front())) != 0;
    return camera || line.size() == 8 ? "visloc" : "";
  }
  return "";
}

using DatasetReader = Dataset (*)(const fs::path&, const ConvertOptions&);

Dataset ReadDatasetFile(const fs::path& path, const ConvertOptions& /*options*/) {
  return ReadDataset(path);
}

const std::map<std::string, DatasetReader>& DatasetReaders() {
  static const std::map<std::string, DatasetReader> readers = {
      {"dataset", ReadDatasetFile},
      {"colmap", ReadColmapModel},
      {"visloc", ReadVisualLocalizationList},
      {"egeniouss", ReadEgeniouss},
      {"lodloc", ReadLodLoc},
      {"opensfm", ReadOpenSfm},
      {"opk", ReadAngleTable},
      {"results", ReadResults},
  };
  return readers;
}

// Ids from picture names: short ones where they differ.
void NameQueries(Dataset& dataset, const std::string& file) {
  std::map<std::string, int> stems;
  std::map<std::string, int> names;
  for (const Query& query : dataset.queries) {
    ++stems[query.image.stem().string()];
    if (++names[query.image.generic_string()] > 1) {
      throw InputError(file,
                       "",
                       "the picture " + query.image.generic_string() + " again",
                       "pictures that differ");
    }
  }
  for (Query& query : dataset.queries) {
    if (!query.id.empty()) continue;
    const std::string stem = query.image.stem().string();
    fs::path whole = query.image;
    query.id = stems[stem] == 1 ? stem : whole.replace_extension().generic_string();
  }
}

void CheckFormat(const std::string& option,
                 const std::string& format,
                 const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), format) != known.end()) return;
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
  throw InputError(option, "", "\"" + format + "\"", "one of " + names);
}

}  // namespace

const std::vector<std::string>& InputFormats() {
  static const std::vector<std::string> formats = [] {
    std::vector<std::string> names;
    for (const auto& [name, reader] : DatasetReaders()) names.push_back(name);
    return names;
  }();
  return formats;
}

const std::vector<std::string>& OutputFormats() {
  static const std::vector<std::string> formats = {
      "colmap", "dataset", "egeniouss", "geojson", "kml", "tum"};
  return formats;
}

std::string FormatOfInput(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw InputError(path.string(), "", "no such file", kExpectedFormats);
  }
  std::string format;
  if (fs::is_directory(path, error)) {
    if (fs::is_regular_file(path / "dataset.json", error)) format = "dataset";
    if (fs::is_regular_file(path / "images.txt", error)) format = "colmap";
    if (fs::is_regular_file(path / "intrinsic.txt", error)) format = "lodloc";
    if (IsEgenioussFolder(path)) format = "egeniouss";
  } else if (path.extension() == ".json") {
    format = FormatOfJson(path);
  } else {
    format = FormatOfText(path);
  }
  if (format.empty()) {
    throw InputError(path.string(), "", "no format that is known", kExpectedFormats);
  }
  return format;
}

std::string FormatOfOutput(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".json") return "dataset";
  if (extension == ".geojson") return "geojson";
  if (extension == ".kml") return "kml";
  if (extension == ".tum" || extension == ".txt") return "tum";
  if (extension.empty()) return "colmap";
  throw InputError(
      "--out",
      "",
      path.string(),
      "a name ending in .json, .geojson, .kml or .tum, a folder for COLMAP, or --to FORMAT");
}

Dataset ReadInput(const fs::path& path, const std::string& format, const ConvertOptions& options) {
  const std::string known = format.empty() ? FormatOfInput(path) : format;
  CheckFormat("--from", known, InputFormats());
  Dataset dataset = DatasetReaders().at(known)(path, options);
  if (known != "dataset") dataset.file = path;
  NameQueries(dataset, path.string());
  CheckPoses(dataset);
  for (Query& query : dataset.queries) {
    if (!query.camera) query.camera = options.camera;
  }
  if (!options.crs.empty()) dataset.crs = options.crs;
  return dataset;
}

void Merge(const Dataset& more, bool is_results, Dataset& dataset) {
  if (is_results) {
    for (Query& query : dataset.queries) query.truth.reset();
  }
  std::map<std::string, Query*> known;
  const auto name = [&](const std::string& text, Query& query) { known.emplace(text, &query); };
  for (Query& query : dataset.queries) name(query.id, query);
  for (Query& query : dataset.queries) name(query.image.generic_string(), query);
  for (Query& query : dataset.queries) name(query.image.filename().string(), query);
  for (const Query& query : more.queries) {
    auto it = known.find(query.image.generic_string());
    if (it == known.end()) it = known.find(query.id);
    if (it == known.end()) it = known.find(query.image.filename().string());
    if (it == known.end()) {
      throw InputError(more.file.string(),
                       "",
                       "the picture \"" + query.image.generic_string() + "\"",
                       "a picture of " + dataset.file.string());
    }
    Query& into = *it->second;
    if (!into.camera) into.camera = query.camera;
    if (!into.prior) into.prior = query.prior;
    if (query.truth) into.truth = query.truth;
  }
  if (dataset.crs.empty()) dataset.crs = more.crs;
}

std::size_t WriteOutput(const Dataset& dataset,
                        const std::string& format,
                        const ConvertOptions& options,
                        const fs::path& path) {
  CheckFormat("--to", format, OutputFormats());
  const auto posed = static_cast<std::size_t>(
      std::count_if(dataset.queries.begin(), dataset.queries.end(), [](const Query& query) {
        return query.truth.has_value();
      }));
  if (format == "dataset") {
    WriteFileAtomically(path, DatasetJson(dataset, fs::absolute(path).parent_path()));
    return dataset.queries.size();
  }
  if (posed == 0) {
    throw InputError(
        dataset.file.string(), "", "no picture with a pose", "poses to write as " + format);
  }
  if (format == "colmap") return WriteColmapModel(dataset, options, path);
  if (format == "egeniouss") WriteFileAtomically(path, EgenioussPoses(dataset));
  if (format == "geojson") WriteFileAtomically(path, PosesGeoJson(dataset));
  if (format == "kml") WriteFileAtomically(path, PosesKml(dataset));
  if (format == "tum") WriteFileAtomically(path, TumTrajectory(dataset));
  return posed;
}

}  // namespace ridgeline
