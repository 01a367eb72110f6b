// SPDX-License-Identifier: Apache-2.0
#include "cli/run_outputs.h"

#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/file_name.h"
#include "cli/out_folder.h"
#include "cli/version.h"
#include "input/read_picture.h"
#include "report/bench_report.h"
#include "report/html_report.h"
#include "report/map_files.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

std::string OverlayName(const RunRecord& record, bool seeds) {
  return FileNameOf(record.query) + (seeds ? "_" + std::to_string(record.seed) : "") + ".jpg";
}

void WriteOverlayOf(const BenchRun& run,
                    const Query& query,
                    const Localizer& localizer,
                    PictureReader& pictures,
                    const fs::path& path) {
  const cv::Mat photo = UndistortImage(BgrOf(pictures.Read(query)), *query.camera);
  WriteOverlay(photo,
               ResultOverlay(localizer, CameraOf(query, run.localization), run),
               OverlayDrawOptions{},
               path);
}

}  // namespace

void AddRunOutputOptions(CLI::App& command, RunOutputs& outputs, bool many) {
  command.add_option("--report", outputs.report, "HTML report that opens offline")
      ->type_name("FILE");
  command.add_option("--map", outputs.map, "Map of poses and errors: .gpkg, .geojson or .kml")
      ->type_name("FILE");
  if (many) {
    command.add_option("--overlays", outputs.overlays, "Folder for the photos with model edges")
        ->type_name("DIR");
    return;
  }
  command.add_option("--overlay", outputs.overlays, "Photo with model edges: .png, .jpg or .svg")
      ->type_name("FILE");
  command.add_option("--energy-map", outputs.energy_map, "Energy by position: GeoTIFF")
      ->type_name("FILE");
}

void CheckRunOutputs(const RunOutputs& outputs, bool many) {
  CheckFileToWrite("--report", outputs.report);
  CheckFileToWrite("--map", outputs.map);
  if (!outputs.map.empty()) CheckMapName(outputs.map);
  CheckFileToWrite("--energy-map", outputs.energy_map);
  if (!many) {
    CheckFileToWrite("--overlay", outputs.overlays);
    return;
  }
  if (outputs.overlays.empty()) return;
  std::error_code error;
  fs::create_directories(outputs.overlays, error);
  if (error)
    throw InputError("--overlays", "", outputs.overlays + ": " + error.message(), "a folder");
}

void WriteRunOutputs(const RunOutputs& outputs,
                     bool many,
                     const RunOrigin& origin,
                     const std::vector<Query>& queries,
                     const Localizer& localizer,
                     std::span<const BenchRun> runs,
                     const Context& context) {
  const int epsg = localizer.scene().model().crs.horizontal_epsg;
  PictureReader pictures;
  if (!outputs.report.empty() || !outputs.map.empty()) {
    const std::string crs = epsg == 0 ? "" : "EPSG:" + std::to_string(epsg);
    const ReportData data = BenchReport(
        {origin.title, origin.command, VersionText(), crs, origin.options_json, origin.protocol},
        queries,
        localizer,
        runs,
        pictures);
    if (!outputs.map.empty()) {
      WriteMap(data.runs, epsg, outputs.map);
      context.Note("map: " + outputs.map);
    }
    if (!outputs.report.empty()) {
      WriteHtmlReport(data, outputs.report);
      context.Note("report: " + outputs.report);
    }
  }
  if (!outputs.overlays.empty()) {
    bool seeds = false;
    for (const BenchRun& run : runs) seeds = seeds || run.record.seed != runs.front().record.seed;
    for (const BenchRun& run : runs) {
      const fs::path file = many ? fs::path(outputs.overlays) / OverlayName(run.record, seeds)
                                 : fs::path(outputs.overlays);
      WriteOverlayOf(run, queries[run.query], localizer, pictures, file);
    }
    context.Note((many ? "overlays: " : "overlay: ") + outputs.overlays);
  }
  if (!outputs.energy_map.empty() && !runs.empty()) {
    const EnergyMap& map = runs.front().localization.map;
    if (map.energies.empty()) {
      context.Warn("no energy map: this search method makes none");
      return;
    }
    WriteEnergyMap(
        {map.first, map.spacing_m, map.columns, map.rows, map.energies}, epsg, outputs.energy_map);
    context.Note("energy map: " + outputs.energy_map);
  }
}

}  // namespace ridgeline
