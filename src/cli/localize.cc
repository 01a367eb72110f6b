// SPDX-License-Identifier: Apache-2.0
#include "cli/localize.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/crs.h"
#include "city/read_city.h"
#include "cli/command.h"
#include "cli/out_folder.h"
#include "cli/version.h"
#include "eval/bench.h"
#include "eval/pose_json.h"
#include "input/picture_input.h"
#include "input/read_picture.h"
#include "input/world.h"
#include "report/bench_report.h"
#include "report/html_report.h"
#include "report/map_files.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct LocalizeArguments {
  std::string image;
  std::string dataset;
  std::string query;
  std::vector<std::string> model;
  std::string dtm;
  std::string crs;
  std::string camera;
  std::string prior;
  std::string lines;
  std::string out;
  std::string report;
  std::optional<double> declination_deg;
  std::uint64_t seed = 1;
  ConfigArguments config;
};

// What is to be localized, and in which model.
struct Task {
  Query query;
  Dataset dataset;    // model, DTM and CRS
  PictureInput made;  // what the picture itself had to tell
};

Task TaskOfDataset(const LocalizeArguments& arguments) {
  Task task;
  task.dataset = ReadDataset(arguments.dataset);
  std::vector<std::string> ids;
  for (const Query& query : task.dataset.queries) {
    ids.push_back(query.id);
    if (query.id == arguments.query) task.query = query;
  }
  if (task.query.id.empty()) {
    throw InputError(
        "--query",
        "",
        "\"" + arguments.query + "\"",
        "an id of " + arguments.dataset + ", e.g. " + NearestName(arguments.query, ids));
  }
  task.dataset.queries = {task.query};
  return task;
}

Task TaskOfFiles(const LocalizeArguments& arguments) {
  const auto require = [](const std::string& value, const char* option, const char* what) {
    if (value.empty()) throw InputError(option, "", "nothing", what);
  };
  require(arguments.image, "IMAGE", "a picture, or --dataset with --query");
  require(arguments.model.empty() ? "" : arguments.model.front(), "--model", "a city model");
  Task task;
  task.query.id = fs::path(arguments.image).stem().string();
  task.query.image = arguments.image;
  if (!arguments.camera.empty()) task.query.camera = ReadCamera(arguments.camera);
  if (!arguments.prior.empty()) task.query.prior = ReadPrior(arguments.prior);
  if (!arguments.lines.empty()) task.query.lines = arguments.lines;
  task.dataset.file = arguments.image;
  task.dataset.name = task.query.id;
  task.dataset.crs = arguments.crs;
  task.dataset.model.assign(arguments.model.begin(), arguments.model.end());
  if (!arguments.dtm.empty()) task.dataset.dtm = arguments.dtm;
  task.dataset.queries = {task.query};
  return task;
}

// Camera and prior from the picture where nothing else gives them.
void TakeFromPicture(const LocalizeArguments& arguments,
                     const LocalizerOptions& options,
                     Task& task) {
  Query& query = task.query;
  if (query.camera && query.prior) return;
  Crs crs;
  if (!query.prior) {
    CityOptions city;
    city.project_to = task.dataset.crs;
    crs = ReadCityCrs(task.dataset.model, city);
  }
  PictureInputOptions picture_options;
  picture_options.declination_deg = arguments.declination_deg;
  picture_options.camera_height_m = options.search.space.camera_height_m;
  task.made = ReadPictureInput(query, crs, task.dataset.dtm, picture_options);
  if (task.made.camera) {
    query.camera = task.made.camera;
    query.orientation = task.made.orientation;
  }
  if (task.made.prior) query.prior = task.made.prior;
  if (!query.prior) {
    throw InputError(query.image.string(),
                     "position",
                     "none in its EXIF or XMP",
                     "--prior FILE with {\"position\": [east, north], \"heading_deg\": ...}");
  }
  task.dataset.queries = {query};
}

// A prior of the picture's own is searched as far as it may be off, unless the user says otherwise.
void WidenRanges(const PictureInput& made,
                 PoseSpaceOptions& ranges,
                 std::vector<std::string>& notes) {
  if (!made.prior) return;
  const PoseSpaceOptions defaults;
  const auto widen = [](double& range, double default_range, double wanted) {
    if (range == default_range) range = std::max(range, wanted);
  };
  widen(ranges.east_m, defaults.east_m, made.horizontal_m);
  widen(ranges.north_m, defaults.north_m, made.horizontal_m);
  widen(ranges.height_m, defaults.height_m, made.height_m);
  widen(ranges.pitch_deg, defaults.pitch_deg, made.pitch_deg);
  widen(ranges.roll_deg, defaults.roll_deg, made.roll_deg);
  char text[200];
  std::snprintf(
      text,
      sizeof(text),
      "search: within %.0f m east and north, %.0f m up and down, %.0f deg heading, %.0f pitch, "
      "%.0f roll (--set search.pitch_deg=... and the like)",
      std::max(ranges.east_m, ranges.north_m),
      ranges.height_m,
      made.prior->heading_deg ? ranges.heading_deg : 180.0,
      ranges.pitch_deg,
      ranges.roll_deg);
  notes.push_back(text);
}

// Whether there is a place at all for the camera: said before the search, since the user can mend
// it.
void CheckPlace(const Task& task, const Localizer& localizer, const PoseSpaceOptions& ranges) {
  const PosePrior& prior = *task.query.prior;
  const Eigen::Vector2d local =
      prior.position_in_world - localizer.scene().model().origin_in_world.head<2>();
  if (!local.allFinite() || !ranges.free_space) return;
  char place[80];
  std::snprintf(
      place, sizeof(place), "%.1f, %.1f", prior.position_in_world.x(), prior.position_in_world.y());
  constexpr int kSteps = 10;  // each way from the middle
  bool on_terrain = localizer.dtm() == nullptr;
  std::optional<PoseSpace> space;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double east = ranges.east_m * i / kSteps;
      const double north = ranges.north_m * j / kSteps;
      if (localizer.dtm() != nullptr &&
          !localizer.dtm()->HeightAt(local + Eigen::Vector2d(east, north))) {
        continue;
      }
      on_terrain = true;
      if (!space && (prior.height_in_world || localizer.dtm()->HeightAt(local))) {
        space.emplace(prior, ranges, localizer.scene(), localizer.dtm(), localizer.footprints());
      }
      for (const double height : {0.0, ranges.height_m, -ranges.height_m}) {
        if (space && space->PositionAt(east, north, height)) return;
      }
    }
  }
  if (!on_terrain || !space) {
    throw InputError(task.dataset.dtm ? task.dataset.dtm->string() : "prior",
                     "position",
                     std::string("no terrain at the prior, ") + place,
                     "a terrain model that covers the prior");
  }
  throw InputError("prior",
                   "position",
                   std::string("a place in a building or under ground, ") + place +
                       ", and none outside of it within the search ranges",
                   "a place where a camera can be (or larger search.east_m, search.north_m)");
}

void PrintResult(const BenchRun& run, const Task& task, const Context& context) {
  const Localization& found = run.localization;
  char line[200];
  if (!found.pose) {
    context.Print(task.query.id + ": abstained: " + found.reason);
    return;
  }
  const Eigen::Vector3d& c = found.pose->center_in_world;
  const ViewAngles view = ViewAnglesOf(found.pose->cam_from_world);
  std::snprintf(
      line, sizeof(line), "position    %.2f %.2f %.2f (east north height)", c.x(), c.y(), c.z());
  context.Print(line);
  std::snprintf(line,
                sizeof(line),
                "direction   heading %.2f, pitch %.2f, roll %.2f deg",
                view.heading_deg,
                view.pitch_deg,
                view.roll_deg);
  context.Print(line);
  std::snprintf(
      line, sizeof(line), "confidence  %.2f (energy %.4f)", found.confidence, found.energy);
  context.Print(line);
  if (run.record.error) {
    std::snprintf(line,
                  sizeof(line),
                  "error       %.2f m, %.2f deg against the truth",
                  run.record.error->translation_m,
                  run.record.error->rotation_deg);
    context.Print(line);
  }
  std::snprintf(line,
                sizeof(line),
                "time        %.2f s, %llu poses",
                run.record.seconds,
                static_cast<unsigned long long>(found.evaluations));
  context.Print(line);
}

int RunLocalize(const LocalizeArguments& arguments, const Context& context) {
  Task task = arguments.dataset.empty() ? TaskOfFiles(arguments) : TaskOfDataset(arguments);
  LocalizerOptions options;
  const VisitOptions visit = [&](OptionVisitor& v) { options.Visit(v); };
  ApplyConfig(arguments.config, visit);
  options.Validate();
  const OutFolder out_folder("--out", arguments.out);
  CheckFileToWrite("--report", arguments.report);
  TakeFromPicture(arguments, options, task);
  WidenRanges(task.made, options.search.space, task.made.notes);
  for (const std::string& note : task.made.notes) context.Note(note);
  const PoseSpaceOptions& ranges = options.search.space;
  const World world = ReadWorld(task.dataset, std::max(ranges.east_m, ranges.north_m));
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const Localizer localizer(world.model, world.dtm, options);
  CheckPlace(task, localizer, ranges);

  BenchOptions bench;
  bench.seeds = {static_cast<int>(arguments.seed)};
  bench.threads = context.threads;
  const std::vector<BenchRun> runs = RunBench(task.dataset, localizer, bench, {});
  const BenchRun& run = runs.front();
  for (const std::string& warning : run.localization.warnings) context.Warn(warning);
  const std::string pose_json = PoseJson(task.query.image.string(), run.localization, world.model);
  const std::string options_json = OptionsToJson(visit);

  const ReportOrigin origin{"Pose of " + task.query.image.filename().string(),
                            "ridgeline localize",
                            VersionText(),
                            CrsName(world.model.crs),
                            options_json};
  if (!arguments.out.empty()) {
    const fs::path out = arguments.out;
    WriteFileAtomically(out / "pose.json", pose_json);
    WriteFileAtomically(out / "report.json",
                        RunJson(run.localization, arguments.seed, VersionText(), options_json));
    const cv::Mat photo = UndistortImage(BgrOf(ReadPicture(task.query)), *task.query.camera);
    WriteOverlay(photo,
                 ResultOverlay(localizer, task.query.camera->Pinhole(), run),
                 {},
                 out / "overlay.png");
    const ReportData data = BenchReport(origin, task.dataset.queries, localizer, ranges, runs);
    WriteMap(data.runs, world.model.crs.horizontal_epsg, out / "map.geojson");
    if (!data.runs.empty() && data.runs.front().map) {
      WriteEnergyMap(*data.runs.front().map, world.model.crs.horizontal_epsg, out / "energy.tif");
    }
  }
  if (!arguments.report.empty()) {
    WriteHtmlReport(BenchReport(origin, task.dataset.queries, localizer, ranges, runs),
                    arguments.report);
  }
  if (context.json) {
    context.Print(pose_json);
  } else {
    PrintResult(run, task, context);
    if (!arguments.out.empty()) {
      context.Print("overlay     " + (fs::path(arguments.out) / "overlay.png").string());
    }
    if (!arguments.report.empty()) context.Print("report      " + arguments.report);
  }
  return run.localization.pose ? kExitOk : kExitAbstained;
}

}  // namespace

void AddLocalizeCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<LocalizeArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"localize",
       "Finds the pose of one picture.",
       "ridgeline localize photo.jpg --model city.gpkg --dtm dtm.tif\n"
       "ridgeline localize photo.jpg --model city.gml --dtm dtm.tif --camera camera.json \\\n"
       "    --prior prior.json --out result --report result.html\n"
       "ridgeline localize --dataset town/dataset.json --query street_000 --out result"},
      [arguments](Context& c) { return RunLocalize(*arguments, c); });
  command->add_option("image", arguments->image, "Picture");
  command->add_option(
      "--dataset", arguments->dataset, "Take picture, model and prior from a dataset");
  command->add_option("--query", arguments->query, "Id of the query in --dataset");
  command->add_option("--model", arguments->model, "City model: files or folders");
  command->add_option("--dtm", arguments->dtm, "Terrain model (any GDAL raster)");
  command->add_option("--crs", arguments->crs, "Projected system of the prior, e.g. EPSG:25832");
  command->add_option("--camera",
                      arguments->camera,
                      "Camera file (COLMAP model and parameters); else from the picture's EXIF");
  command->add_option(
      "--prior",
      arguments->prior,
      "Prior file: position, heading_deg, pitch_deg, roll_deg; else from EXIF, XMP");
  command->add_option(
      "--declination",
      arguments->declination_deg,
      "Magnetic declination [deg], east positive; else by the World Magnetic Model");
  command->add_option(
      "--lines", arguments->lines, "Segments of another detector, for lines.detector=file");
  command->add_option("--out",
                      arguments->out,
                      "Folder for pose.json, report.json, overlay.png, map.geojson, energy.tif");
  command->add_option("--report", arguments->report, "HTML report");
  command->add_option("--seed", arguments->seed, "Seed of the samplers (default 1)");
  AddConfigOptions(*command, arguments->config);
}

}  // namespace ridgeline
