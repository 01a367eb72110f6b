// SPDX-License-Identifier: Apache-2.0
#include "cli/one_line.h"
#include "cli/info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/decimals.h"
#include "base/error.h"
#include "city/city_info.h"
#include "city/crs.h"
#include "city/format/formats.h"
#include "city/store/city_store.h"
#include "cli/command.h"
#include "cli/one_line.h"

namespace ridgeline {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct InfoArguments {
  std::vector<std::string> files;
  CityOptions city;
};

Json Point(const Eigen::VectorXd& p) {
  Json list = Json::array();
  for (const double value : p) list.push_back(RoundedTo(value, 3));
  return list;
}

Json CityJsonOf(const CityInfo& info) {
  Json json;
  json["kind"] = "model";
  for (const ModelFileInfo& file : info.files) {
    Json entry = {{"file", file.file},
                  {"format", file.format},
                  {"bytes", file.bytes},
                  {"crs_as_written", file.srs_names},
                  {"buildings_and_parts", file.buildings}};
    for (const auto& [lod, count] : file.polygons) {
      entry["polygons_in_file"].push_back({{"lod", lod},
                                           {"in_file", count.met},
                                           {"read", count.read},
                                           {"passed_over", count.named}});
    }
    for (const auto& [lod, count] : file.buildings_of_lod) {
      entry["lods"].push_back({{"lod", lod},
                               {"buildings_and_parts", count},
                               {"polygons", file.polygons_of_lod.at(lod)}});
    }
    json["files"].push_back(std::move(entry));
  }
  json["crs"] = CrsName(info.crs);
  json["extent"] = {{"lowest", Point(info.lowest)}, {"highest", Point(info.highest)}};
  if (info.center_lat_lon) {
    json["center_wgs84"] = {{"latitude", RoundedTo(info.center_lat_lon->x(), 7)},
                            {"longitude", RoundedTo(info.center_lat_lon->y(), 7)}};
  }
  json["buildings"] = info.buildings;
  json["building_parts"] = info.parts;
  for (std::size_t c = 0; c < info.surfaces_of_class.size(); ++c) {
    if (info.surfaces_of_class[c] == 0) continue;
    json["surfaces"][SurfaceClassName(static_cast<SurfaceClass>(c))] = {
        {"count", info.surfaces_of_class[c]}, {"area_m2", RoundedTo(info.area_of_class[c], 2)}};
  }
  json["surfaces_classified_by_normal"] = info.classified_by_normal;
  json["vertices"] = info.vertices;
  json["triangles"] = info.triangles;
  json["feature_edges"] = {{"folds_and_borders", info.edges},
                           {"length_m", RoundedTo(info.edge_length, 1)},
                           {"seams", info.seams}};
  json["open_shells"] = info.open_shells;
  json["self_intersecting_shells"] = info.crossing_shells;
  json["dropped_or_repaired"] = Json::array();
  for (const auto& [kind, entry] : info.dropped.entries()) {
    json["dropped_or_repaired"].push_back(
        {{"kind", kind}, {"count", entry.count}, {"ids", entry.ids}});
  }
  return json;
}

Json RasterJsonOf(const RasterInfo& info) {
  Json json;
  json["kind"] = info.georeferenced ? "raster" : "picture";
  json["file"] = info.file;
  json["format"] = info.driver;
  json["columns"] = info.columns;
  json["rows"] = info.rows;
  json["bands"] = info.bands;
  if (info.georeferenced) {
    json["crs"] = info.crs.empty() ? Json(nullptr) : Json(info.crs);
    json["cell_m"] = Point(info.spacing);
    json["extent"] = {{"lowest", Point(info.lowest)}, {"highest", Point(info.highest)}};
    if (info.min_value)
      json["heights"] = {{"lowest", *info.min_value}, {"highest", *info.max_value}};
    json["known_share"] = RoundedTo(info.known_share, 6);
    json["unit"] = info.unit.empty() ? Json(nullptr) : Json(info.unit);
    if (info.row_step > 1) json["values_of_every_nth_row"] = info.row_step;
    json["warnings"] = info.warnings;
  }
  if (!info.exif.empty()) json["exif"] = info.exif;
  if (!info.georeferenced) json["xmp"] = info.has_xmp;
  return json;
}

std::string Fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string Range(double low, double high, const std::string& unit) {
  return Fixed(low, 1) + " .. " + Fixed(high, 1) + unit;
}

std::string Shortened(const std::vector<std::string>& ids) {
  constexpr std::size_t kShown = 3;
  std::string text = std::to_string(ids.size());
  for (std::size_t i = 0; i < std::min(kShown, ids.size()); ++i) {
    text += (i == 0 ? " (" : ", ") + ids[i];
  }
  if (ids.size() > kShown) text += ", ...";
  return ids.empty() ? text : text + ")";
}

void PrintCity(const CityInfo& info, const Context& context) {
  const auto line = [&](const std::string& key, const std::string& value) {
    context.Print("  " + key + std::string(key.size() < 18 ? 18 - key.size() : 1, ' ') + value);
  };
  for (const ModelFileInfo& file : info.files) {
    context.Print(file.file + ": " + file.format + ", " +
                  Fixed(static_cast<double>(file.bytes) / 1e6, 2) + " MB");
    for (const std::string& name : file.srs_names) line("CRS as written", OneLine(name, 400));
    if (file.srs_names.empty()) line("CRS as written", "none");
    for (const auto& [lod, count] : file.buildings_of_lod) {
      line("LoD" + std::to_string(lod),
           std::to_string(count) + " buildings and parts, " +
               std::to_string(file.polygons_of_lod.at(lod)) + " polygons");
    }
    for (const auto& [lod, count] : file.polygons) {
      if (count.named == 0) continue;
      line("LoD" + std::to_string(lod) + " in file",
           std::to_string(count.met) + " polygons, " + std::to_string(count.read) + " read, " +
               std::to_string(count.named) + " passed over (named below)");
    }
  }
  context.Print("read as");
  line("CRS", CrsName(info.crs));
  line("east", Range(info.lowest.x(), info.highest.x(), " m"));
  line("north", Range(info.lowest.y(), info.highest.y(), " m"));
  line("height", Range(info.lowest.z(), info.highest.z(), " m"));
  if (info.center_lat_lon) {
    line("centre",
         Fixed(info.center_lat_lon->x(), 6) + ", " + Fixed(info.center_lat_lon->y(), 6) +
             " (WGS 84 latitude, longitude)");
  }
  line("buildings",
       std::to_string(info.buildings) + ", building parts " + std::to_string(info.parts));
  for (std::size_t c = 0; c < info.surfaces_of_class.size(); ++c) {
    if (info.surfaces_of_class[c] == 0) continue;
    line(
        std::string(SurfaceClassName(static_cast<SurfaceClass>(c))) + " surfaces",
        std::to_string(info.surfaces_of_class[c]) + ", " + Fixed(info.area_of_class[c], 0) + " m2");
  }
  if (info.classified_by_normal > 0) {
    line("without class", std::to_string(info.classified_by_normal) + ", classified by normal");
  }
  line("mesh",
       std::to_string(info.vertices) + " vertices, " + std::to_string(info.triangles) +
           " triangles");
  line("edges",
       std::to_string(info.edges) + " (" + Fixed(info.edge_length / 1000.0, 1) + " km), seams " +
           std::to_string(info.seams));
  line("open shells", Shortened(info.open_shells));
  line("crossing shells", Shortened(info.crossing_shells));
  if (info.warnings.empty()) return;
  context.Print("dropped or repaired (--json lists the ids)");
  for (const std::string& warning : info.warnings) context.Print("  " + OneLine(warning));
}

void PrintRaster(const RasterInfo& info, const Context& context) {
  context.Print(info.file + ": " + info.driver + ", " + std::to_string(info.columns) + " x " +
                std::to_string(info.rows) + (info.georeferenced ? " cells, " : " pixels, ") +
                std::to_string(info.bands) + (info.bands == 1 ? " band" : " bands"));
  if (info.georeferenced) {
    context.Print("  CRS      " + (info.crs.empty() ? "none" : info.crs));
    context.Print("  cells    " + Fixed(info.spacing.x(), 3) + " x " + Fixed(info.spacing.y(), 3));
    context.Print("  east     " + Range(info.lowest.x(), info.highest.x(), ""));
    context.Print("  north    " + Range(info.lowest.y(), info.highest.y(), ""));
    if (info.min_value) {
      context.Print("  values   " + Range(*info.min_value,
                                          *info.max_value,
                                          info.unit.empty() ? "" : " " + info.unit));
    }
    context.Print(
        "  known    " + Fixed(100.0 * info.known_share, 2) + " %" +
        (info.row_step > 1 ? " (of every row in " + std::to_string(info.row_step) + ")" : ""));
    for (const std::string& warning : info.warnings) context.Print("  " + OneLine(warning));
  }
  for (const auto& [key, value] : info.exif) {
    context.Print("  " + OneLine(key, 80) + " = " + OneLine(value, 200));
  }
  if (!info.georeferenced) {
    context.Print(std::string("  EXIF ") + (info.exif.empty() ? "none" : "above") + ", XMP " +
                  (info.has_xmp ? "present" : "none"));
  }
}

// Options that change how models are read, where there are none.
void RefuseModelOptions(const CityOptions& city) {
  const CityOptions defaults;
  const auto refuse = [](const char* option) {
    throw InputError(option, "", "no model among the files", "a model, or none of its options");
  };
  if (!city.model_crs.empty()) refuse("--model-crs");
  if (!city.project_to.empty()) refuse("--project-to");
  if (city.height_offset_m != defaults.height_offset_m) refuse("--height-offset");
  if (city.lod != defaults.lod) refuse("--lod");
}

int RunInfo(const InfoArguments& arguments, const Context& context) {
  std::vector<fs::path> models;
  std::vector<fs::path> rasters;
  for (const std::string& file : arguments.files) {
    std::error_code error;
    const bool is_model = fs::is_directory(file, error) || !fs::exists(file, error) ||
                          IsCityStore(file) || FormatOfName(file) != nullptr;
    (is_model ? models : rasters).emplace_back(file);
  }
  if (models.empty()) RefuseModelOptions(arguments.city);
  Json results = Json::array();
  if (!models.empty()) {
    CityOptions options = arguments.city;
    options.threads = context.threads;
    const CityInfo info = DescribeCity(models, options);
    if (context.json) {
      results.push_back(CityJsonOf(info));
    } else {
      PrintCity(info, context);
    }
  }
  for (const fs::path& file : rasters) {
    const RasterInfo info = DescribeRaster(file);
    if (context.json) {
      results.push_back(RasterJsonOf(info));
    } else {
      PrintRaster(info, context);
    }
  }
  if (context.json) context.Print(results.dump(2));
  return kExitOk;
}

}  // namespace

void AddInfoCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command =
      AddCommand(app,
                 context,
                 {"info",
                  "Tells what is in models, terrain models and pictures.",
                  "ridgeline info town/city.gml town/dtm.tif town/images/street_000.jpg"},
                 [arguments](Context& c) { return RunInfo(*arguments, c); });
  command->add_option("files", arguments->files, "Models (one city together), rasters, pictures")
      ->required();
  command->add_option("--model-crs", arguments->city.model_crs, "Overrides the models' CRS");
  command->add_option(
      "--project-to", arguments->city.project_to, "Projected CRS to move models to");
  command->add_option("--height-offset", arguments->city.height_offset_m, "Added to heights [m]");
  command->add_option("--lod", arguments->city.lod, "Level of detail wanted")
      ->check(CLI::Range(1, 4));
}

}  // namespace ridgeline
