// SPDX-License-Identifier: Apache-2.0
#include "cli/doctor.h"

#include <gdal_priv.h>
#include <proj.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "cli/command.h"
#include "cli/version.h"
#include "eval/bench.h"
#include "input/world.h"
#include "report/html_report.h"
#include "synth/town_dataset.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// What a check found: fine, worth knowing, or broken.
enum class Finding { kFine, kNote, kBroken };

struct Check {
  std::string name;
  Finding finding;
  std::string text;  // what was found, and what to do
};

Check CheckProj() {
  const char* database = proj_context_get_database_path(nullptr);
  PJ* crs = proj_create(nullptr, "EPSG:25832");
  const bool known = crs != nullptr;
  proj_destroy(crs);
  if (known) return {"PROJ data", Finding::kFine, database == nullptr ? "built in" : database};
  return {"PROJ data",
          Finding::kBroken,
          "EPSG:25832 is not known; install the Debian package proj-data, or set PROJ_DATA to the "
          "folder of proj.db"};
}

bool InProjFolders(const char* file) {
  const PJ_INFO info = proj_info();
  for (std::size_t i = 0; i < info.path_count; ++i) {
    std::error_code error;
    if (fs::exists(fs::path(info.paths[i]) / file, error)) return true;
  }
  return false;
}

// Grids are needed for old datums and for heights above the ellipsoid only.
Check CheckGrids() {
  std::string missing;
  if (!InProjFolders("de_adv_BETA2007.tif")) missing += " de_adv_BETA2007.tif (German datum DHDN)";
  if (!InProjFolders("de_bkg_gcg2016.tif")) missing += " de_bkg_gcg2016.tif (ellipsoid heights)";
  if (missing.empty()) return {"PROJ grids", Finding::kFine, "BETA2007 and GCG2016 are there"};
  return {"PROJ grids",
          Finding::kNote,
          "absent:" + missing + "; only to change from such systems: projsync --file de_"};
}

Check CheckDrivers() {
  GDALAllRegister();
  std::string missing;
  for (const char* driver : {"GTiff", "VRT", "GPKG", "GeoJSON", "KML"}) {
    if (GetGDALDriverManager()->GetDriverByName(driver) == nullptr) {
      missing += std::string(" ") + driver;
    }
  }
  if (missing.empty()) return {"GDAL drivers", Finding::kFine, "GTiff, VRT, GPKG, GeoJSON, KML"};
  return {
      "GDAL drivers", Finding::kBroken, "missing:" + missing + "; install libgdal-dev of Debian"};
}

Check CheckThreads(int threads) {
  const unsigned hardware = std::thread::hardware_concurrency();
  return {"threads",
          Finding::kFine,
          std::to_string(ResolveThreads(threads)) + " used of " + std::to_string(hardware)};
}

Check CheckPlots() {
  if (ReportHasPlots()) return {"report plots", Finding::kFine, "embedded"};
  return {"report plots",
          Finding::kNote,
          "not in this build; install nodejs and npm, configure and build again"};
}

Check CheckConfigs() {
  const fs::path configs = ShippedConfigs();
  if (!configs.empty()) return {"configurations", Finding::kFine, configs.string()};
  return {"configurations",
          Finding::kNote,
          "no configs folder near the program: --config needs a file, not a name"};
}

// Invents a small town, localizes a picture of it and looks at the error.
Check SelfTest(int threads) {
  const auto start = std::chrono::steady_clock::now();
  const fs::path folder = TemporaryBeside(fs::temp_directory_path() / "ridgeline-doctor");
  fs::create_directory(folder);
  TownDatasetOptions town;
  town.town.blocks_east = town.town.blocks_north = 2;
  town.street = 1;
  town.tilted = town.portrait = town.drone = 0;
  town.width = 640;
  town.height = 480;
  WriteTownDataset(town, folder, threads, [](std::size_t, std::size_t) {});
  const Dataset dataset = ReadDataset(folder / "dataset.json");
  const World world = ReadWorld(dataset, 50.0);
  const LocalizerOptions options;
  const Localizer localizer(world.model, world.dtm, options);
  BenchOptions bench;
  bench.threads = threads;
  const auto runs = RunBench(
      BenchQueries(dataset), localizer, bench, [](const BenchRun&, std::size_t, std::size_t) {});
  RemoveTemporaries();
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const RunRecord& record = runs.front().record;
  if (!record.error) {
    return {"self-test", Finding::kBroken, "no pose for the demo picture: " + record.reason};
  }
  char text[160];
  std::snprintf(text,
                sizeof text,
                "demo picture within %.2f m and %.2f deg, %.1f s in all",
                record.error->translation_m,
                record.error->rotation_deg,
                seconds);
  // Wide: this is about a set-up that works, not about accuracy.
  const bool right = record.error->translation_m < 5.0 && record.error->rotation_deg < 5.0;
  return {"self-test", right ? Finding::kFine : Finding::kBroken, text};
}

std::string MarkOf(Finding finding, bool color) {
  switch (finding) {
    case Finding::kFine:
      return Colored(color, Color::kGreen, "ok    ");
    case Finding::kNote:
      return Colored(color, Color::kYellow, "note  ");
    case Finding::kBroken:
      return Colored(color, Color::kRed, "BROKEN");
  }
  return "";
}

const char* NameOf(Finding finding) {
  return finding == Finding::kFine ? "ok" : finding == Finding::kNote ? "note" : "broken";
}

int RunDoctor(const Context& context, bool quick) {
  std::vector<Check> checks = {{"program", Finding::kFine, VersionText()},
                               CheckProj(),
                               CheckGrids(),
                               CheckDrivers(),
                               CheckThreads(context.threads),
                               CheckConfigs(),
                               CheckPlots()};
  if (!quick) {
    context.Note("Self-test on a small town ...");
    checks.push_back(SelfTest(context.threads));
  }
  bool broken = false;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Check& check : checks) {
    broken = broken || check.finding == Finding::kBroken;
    if (context.json) {
      json.push_back(
          {{"check", check.name}, {"finding", NameOf(check.finding)}, {"text", check.text}});
      continue;
    }
    char name[32];
    std::snprintf(name, sizeof name, "  %-15s ", check.name.c_str());
    context.Print(MarkOf(check.finding, context.color_out) + name + check.text);
  }
  if (context.json) context.Print(json.dump(2));
  return broken ? kExitBadInput : kExitOk;
}

}  // namespace

void AddDoctorCommand(CLI::App& app, Context& context) {
  auto quick = std::make_shared<bool>(false);
  CLI::App* command = AddCommand(
      app,
      context,
      {"doctor", "Checks the set-up, with a self-test, and says what to do.", "ridgeline doctor"},
      [quick](Context& c) { return RunDoctor(c, *quick); });
  command->add_flag("--quick", *quick, "Without the self-test");
}

}  // namespace ridgeline
