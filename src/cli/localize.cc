// SPDX-License-Identifier: Apache-2.0
#include "cli/localize.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/crs.h"
#include "cli/command.h"
#include "cli/idle_options.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/query_input.h"
#include "cli/sensor_priors.h"
#include "cli/unsigned_option.h"
#include "cli/version.h"
#include "eval/localize_task.h"
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
  QueryArguments query;
  std::string prior;
  std::string lines;
  std::string sensors;
  std::string out;
  std::string report;
  std::optional<double> declination_deg;
  std::uint64_t seed = 1;
  ConfigArguments config;
};

// Takes the configuration and, for --lines, the detector that it implies.
void ReadOptions(const LocalizeArguments& arguments, LocalizerOptions& options) {
  const VisitOptions visit = [&](OptionVisitor& v) { options.Visit(v); };
  ApplyConfig({arguments.config.config, {}}, visit);
  if (!arguments.lines.empty()) options.lines.detector = "file";
  ApplyConfig({"", arguments.config.set}, visit);
  if (!arguments.lines.empty() && options.lines.detector != "file") {
    throw InputError("--lines",
                     "",
                     "lines.detector=" + options.lines.detector + " beside it",
                     "segments of a file or a detector's, not both");
  }
  options.Validate();
  RefuseIdleOptions(arguments.config.set, options);
}

Dataset ReadDatasetOf(const LocalizeArguments& arguments) {
  if (arguments.query.image.empty() && arguments.query.dataset.empty()) {
    throw InputError("IMAGE", "", "nothing", "a picture, or --dataset with --query");
  }
  Dataset dataset = ReadQuery(arguments.query);
  Query& query = dataset.queries.front();
  if (!arguments.prior.empty() && !arguments.sensors.empty()) {
    throw InputError("--prior", "", "a prior beside --sensors", "one of the two");
  }
  if (!arguments.prior.empty()) {
    query.prior = ReadPrior(arguments.prior);
    dataset.file = arguments.prior;  // which is named where the prior leaves something open
  }
  return dataset;
}

void PrintDoubts(const Localization& found, const Context& context) {
  for (const std::string& doubt : found.doubts) context.Print("doubt       " + doubt);
  for (const std::string& note : found.notes) context.Print("note        " + note);
}

void PrintResult(const BenchRun& run, const Context& context) {
  const Localization& found = run.localization;
  char line[200];
  if (!found.pose) {
    context.Print(run.record.query + ": abstained: " + found.reason);
    PrintDoubts(found, context);
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
  context.Print("status      " + StatusOf(found));
  if (found.protection) {
    std::snprintf(line,
                  sizeof(line),
                  "protection  %.1f m, %.1f deg (exceeded once in a thousand answers)",
                  found.protection->position_m,
                  found.protection->heading_deg);
    context.Print(line);
  }
  PrintDoubts(found, context);
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

// Files that the result is made of, hashed.
std::vector<HashedFile> InputsOf(const LocalizeArguments& arguments, const Dataset& dataset) {
  const Query& query = dataset.queries.front();
  std::vector<HashedFile> inputs;
  AddHashed("image", query.image, inputs);
  for (const fs::path& model : dataset.model) AddHashed("model", model, inputs);
  if (dataset.dtm) AddHashed("dtm", *dataset.dtm, inputs);
  if (query.lines) AddHashed("lines", *query.lines, inputs);
  const std::pair<const char*, const std::string&> named[] = {
      {"dataset", arguments.query.dataset},
      {"camera", arguments.query.camera},
      {"prior", arguments.prior},
      {"sensors", arguments.sensors}};
  for (const auto& [role, path] : named) {
    if (!path.empty()) AddHashed(role, path, inputs);
  }
  return inputs;
}

// What the search found, in files.
void WriteResults(const LocalizeArguments& arguments,
                  const Dataset& dataset,
                  const Localizer& localizer,
                  const BenchRun& run,
                  const std::string& pose_json,
                  const std::string& options_json,
                  PictureReader& pictures) {
  if (arguments.out.empty() && arguments.report.empty()) return;
  const Query& query = dataset.queries.front();
  const Crs& crs = localizer.scene().model().crs;
  const ReportOrigin origin{"Pose of " + query.image.filename().string(),
                            "ridgeline localize",
                            VersionText(),
                            CrsName(crs),
                            options_json,
                            {}};
  const ReportData data = BenchReport(origin, dataset.queries, localizer, {&run, 1}, pictures);
  if (!arguments.out.empty()) {
    const fs::path out = arguments.out;
    WriteFileAtomically(out / "pose.json", pose_json);
    WriteFileAtomically(
        out / "report.json",
        RunJson(run.localization,
                arguments.seed,
                VersionText(),
                options_json,
                query.assumptions,
                InputsOf(arguments, dataset),
                fs::current_path().string()));
    const cv::Mat photo = UndistortImage(BgrOf(pictures.Read(query)), *query.camera);
    WriteOverlay(
        photo, ResultOverlay(localizer, CameraOf(query, run.localization), run), {}, out / "overlay.png");
    WriteMap(data.runs, crs.horizontal_epsg, out / "map.geojson");
    if (!data.runs.empty() && data.runs.front().map) {
      WriteEnergyMap(*data.runs.front().map, crs.horizontal_epsg, out / "energy.tif");
    }
  }
  if (!arguments.report.empty()) WriteHtmlReport(data, arguments.report);
}

int RunLocalize(LocalizeArguments arguments, const Context& context) {
  Stages stages(context);
  stages.Begin("reading the picture");
  const SensorOptions sensors = TakeSensorOptions(arguments.sensors, arguments.config.set);
  LocalizeTask task;
  task.dataset = ReadDatasetOf(arguments);
  if (!arguments.sensors.empty()) {
    PriorsFromSensors(arguments.sensors, sensors, context, task.dataset);
  }
  ReadOptions(arguments, task.options);
  task.declination_deg = arguments.declination_deg;
  task.lines = arguments.lines;
  const OutFolder out_folder("--out", arguments.out);
  CheckFileToWrite("--report", arguments.report);
  PictureReader pictures;
  CompleteTask(task, pictures);
  const Query& query = task.query();
  stages.End();
  for (const Assumption& assumption : query.assumptions) context.Note(TextOf(assumption));

  stages.Begin("reading the model");
  const World world = ReadWorldOf(task);
  stages.End();
  for (const std::string& warning : world.warnings) context.Warn(warning);
  stages.Begin("building the scene");
  const Localizer localizer(world.model, world.dtm, task.options);
  CheckPlace(task, localizer);

  stages.Begin("searching");
  const BenchRun run = RunTask(task, localizer, arguments.seed, context.threads, pictures);
  const std::string pose_json =
      PoseJson(query.image.string(), run.localization, world.model, query.assumptions);
  stages.Begin("writing the results");
  WriteResults(arguments,
               task.dataset,
               localizer,
               run,
               pose_json,
               OptionsToJson([&](OptionVisitor& v) { task.options.Visit(v); }),
               pictures);
  stages.End();
  for (const std::string& warning : run.localization.warnings) context.Warn(warning);
  if (context.json) {
    context.Print(pose_json);
  } else {
    PrintResult(run, context);
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
       "ridgeline localize --dataset town/dataset.json --query street_000 \\\n"
       "    --out result --report result.html\n"
       "# a photo of your own with GNSS in its EXIF, or with --camera and --prior files:\n"
       "# ridgeline localize photo.jpg --model tiles/ --dtm dtm.tif --out result"},
      [arguments](Context& c) { return RunLocalize(*arguments, c); });
  command->add_option("image", arguments->query.image, "Picture");
  AddQueryOptions(*command, arguments->query);
  command->add_option(
      "--prior",
      arguments->prior,
      "Prior file: position, heading_deg, pitch_deg, roll_deg; else from EXIF, XMP");
  command->add_option(
      "--declination",
      arguments->declination_deg,
      "Magnetic declination [deg], east positive; else by the World Magnetic Model");
  command->add_option(
      "--lines", arguments->lines, "Segments of another detector, in place of lines.detector");
  command
      ->add_option("--sensors",
                   arguments->sensors,
                   "Prior from a phone's instruments (CSV, docs/skyline.md), by the picture's name")
      ->type_name("FILE");
  command->add_option("--out",
                      arguments->out,
                      "Folder for pose.json, report.json, overlay.png, map.geojson, energy.tif");
  command->add_option("--report", arguments->report, "HTML report");
  command->add_option("--seed", arguments->seed, "Seed of the samplers (default 1)")
      ->check(Unsigned());
  AddConfigOptions(*command, arguments->config);
}

}  // namespace ridgeline
