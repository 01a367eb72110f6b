// SPDX-License-Identifier: Apache-2.0
#include "cli/bench.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/command.h"
#include "cli/idle_options.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/run_outputs.h"
#include "eval/bench.h"
#include "eval/bench_files.h"
#include "input/picture_input.h"
#include "input/world.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string dataset;
  std::string out;
  std::string perturb;
  std::string score_only;
  int seed = 1;
  int seeds = 1;
  RunOutputs outputs;
  ConfigArguments config;
};

std::string TableOf(const Summary& summary) {
  std::string text;
  char line[160];
  if (summary.runs == 0) {
    text = "No query has a truth: recall and errors are not known.\n";
  } else {
    text = "            recall   95 % interval   among the answered\n";
    for (std::size_t t = 0; t < kRecallThresholds.size(); ++t) {
      std::snprintf(line,
                    sizeof(line),
                    "%-10s %6.1f %%   %5.1f to %5.1f   %6.1f %%\n",
                    kRecallThresholds[t].name,
                    100.0 * summary.recall[t],
                    100.0 * summary.recall_ci95[t].lower,
                    100.0 * summary.recall_ci95[t].upper,
                    100.0 * summary.recall_answered[t]);
      text += line;
    }
    std::snprintf(line,
                  sizeof(line),
                  "median error %.2f m, %.2f deg; ",
                  summary.translation_m.median,
                  summary.rotation_deg.median);
    text += line;
  }
  std::snprintf(line,
                sizeof(line),
                "abstained %.1f %%; %.2f s per query (median), %.0f poses/s",
                100.0 * summary.abstained,
                summary.seconds_median,
                summary.evaluations_per_second);
  return text + line;
}

void WriteResults(const BenchArguments& arguments,
                  const Dataset& dataset,
                  const std::vector<RunRecord>& records,
                  const Eigen::Vector3d& origin,
                  const Context& context) {
  const std::string config = arguments.config.config.empty() ? "default" : arguments.config.config;
  const std::string summary = SummaryJson(dataset.name, config, records);
  if (!arguments.out.empty()) {
    const fs::path out = arguments.out;
    WriteFileAtomically(out / "results.csv", ResultsCsv(records));
    WriteFileAtomically(out / "poses.txt", PosesText(records, origin));
    WriteFileAtomically(out / "summary.json", summary);
  }
  if (context.json) {
    context.Print(summary);
    return;
  }
  const Summary figures = Summarize(records);
  context.Print(dataset.name + ": " + std::to_string(figures.queries) + " queries, " +
                std::to_string(figures.all_runs) + " runs, " + std::to_string(figures.runs) +
                " with truth");
  context.Print(TableOf(figures));
  if (!arguments.out.empty()) context.Print("written to " + arguments.out);
}

// Poses of another system in the same table.
std::vector<RunRecord> ScorePoses(const Dataset& dataset, const fs::path& path) {
  std::map<std::string, Pose> poses = ReadPosesCsv(path);
  std::vector<RunRecord> records;
  for (const Query& query : dataset.queries) {
    const auto it = poses.find(query.id);
    Localization localization;
    if (it != poses.end()) {
      localization.pose = it->second;
      localization.status = LocalizationStatus::kOk;
      poses.erase(it);
    }
    RunRecord record = RecordOf(query, 1, localization, 0.0);
    record.ellipse_holds_truth.reset();  // other systems give no region
    record.interval_holds_truth.reset();
    records.push_back(record);
  }
  if (!poses.empty()) {
    throw InputError(path.string(),
                     "query",
                     "\"" + poses.begin()->first + "\"",
                     "an id of " + dataset.file.string());
  }
  return records;
}

// Cameras and priors that queries leave to their pictures.
void CompleteDataset(Dataset& dataset,
                     bool priors,
                     const LocalizerOptions& options,
                     const Context& context) {
  PictureInputOptions picture_options;
  picture_options.camera_height_m = options.search.space.camera_height_m;
  const std::size_t asked = CompleteFromPictures(dataset, priors, picture_options);
  if (asked == 0) return;
  context.Note(std::to_string(asked) + " queries take their camera or prior from EXIF and XMP:");
  for (const Query& query : dataset.queries) {
    for (const Assumption& assumption : query.assumptions) {
      context.Note("  " + query.id + ": " + TextOf(assumption));
    }
  }
}

// With --out the report goes there, unless another place is named.
RunOutputs OutputsOf(const BenchArguments& arguments) {
  RunOutputs outputs = arguments.outputs;
  if (outputs.report.empty() && !arguments.out.empty() && arguments.score_only.empty()) {
    outputs.report = (fs::path(arguments.out) / "report.html").string();
  }
  return outputs;
}

std::string CommandOf(const BenchArguments& arguments) {
  std::string command = "ridgeline bench " + arguments.dataset;
  if (!arguments.config.config.empty()) command += " --config " + arguments.config.config;
  for (const std::string& assignment : arguments.config.set) command += " --set " + assignment;
  if (!arguments.perturb.empty()) command += " --perturb " + arguments.perturb;
  return command + " --seed " + std::to_string(arguments.seed) + " --seeds " +
         std::to_string(arguments.seeds);
}

// Poses that are there already take nothing of a search.
void CheckScoreOnly(const BenchArguments& arguments) {
  if (arguments.score_only.empty()) return;
  const BenchArguments defaults;
  const std::pair<bool, const char*> given[] = {
      {!arguments.perturb.empty(), "--perturb"},
      {arguments.seed != defaults.seed, "--seed"},
      {arguments.seeds != defaults.seeds, "--seeds"},
      {!arguments.config.config.empty(), "--config"},
      {!arguments.config.set.empty(), "--set"},
      {!arguments.outputs.report.empty(), "--report"},
      {!arguments.outputs.map.empty(), "--map"},
      {!arguments.outputs.overlays.empty(), "--overlays"}};
  for (const auto& [is_given, option] : given) {
    if (is_given) {
      throw InputError(option, "", "an option of a search", "nothing of it beside --score-only");
    }
  }
}

int RunBenchCommand(const BenchArguments& arguments, const Context& context) {
  Dataset dataset = ReadDataset(arguments.dataset);
  LocalizerOptions options;
  ApplyConfig(arguments.config, [&](OptionVisitor& v) { options.Visit(v); });
  options.Validate();
  RefuseIdleOptions(arguments.config.set, options);
  CheckScoreOnly(arguments);
  BenchOptions bench;
  if (!arguments.perturb.empty()) bench.perturb = ParsePerturbation(arguments.perturb);
  bench.seeds.clear();
  for (int k = 0; k < arguments.seeds; ++k) bench.seeds.push_back(arguments.seed + k);
  bench.threads = context.threads;
  const OutFolder out_folder("--out", arguments.out);
  const RunOutputs outputs = OutputsOf(arguments);
  CheckRunOutputs(outputs, true);
  if (!arguments.score_only.empty()) {
    WriteResults(arguments,
                 dataset,
                 ScorePoses(dataset, arguments.score_only),
                 Eigen::Vector3d::Zero(),
                 context);
    return kExitOk;
  }

  CompleteDataset(dataset, !bench.perturb, options, context);
  constexpr double kPlaceMarginM = 50.0;
  World world = ReadWorld(dataset, kPlaceMarginM);
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const Localizer localizer(world.model, world.dtm, options);
  std::vector<RunRecord> records;
  std::vector<BenchRun> runs;
  {
    std::unique_ptr<Progress> progress;
    const auto show = [&](const BenchRun& run, std::size_t done, std::size_t total) {
      if (!progress) progress = std::make_unique<Progress>(context, "Localizing", total, "runs");
      progress->Set(done);
      records.push_back(run.record);
    };
    runs = RunBench(dataset, localizer, bench, show);
  }
  WriteResults(arguments, dataset, records, world.model.origin_in_world, context);
  const PoseSpaceOptions& space = options.search.space;
  WriteRunOutputs(outputs,
                  true,
                  {"Bench of " + dataset.name,
                   CommandOf(arguments),
                   OptionsToJson([&](OptionVisitor& v) { options.Visit(v); })},
                  dataset.queries,
                  localizer,
                  bench.perturb ? RangesOf(space, *bench.perturb) : space,
                  runs,
                  context);
  return kExitOk;
}

}  // namespace

void AddBenchCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command =
      AddCommand(app,
                 context,
                 {"bench",
                  "Localizes the queries of a dataset and scores the poses against their truths.",
                  "ridgeline bench town/dataset.json --perturb 10,10,0,20 --seeds 5 --out results"},
                 [arguments](Context& c) { return RunBenchCommand(*arguments, c); });
  command->add_option("dataset", arguments->dataset, "dataset.json")->required();
  command->add_option(
      "--out", arguments->out, "Folder for results.csv, summary.json, poses.txt and report.html");
  command->add_option("--perturb",
                      arguments->perturb,
                      "Draw priors around the truth: east,north,height,heading[,pitch,roll] "
                      "half-ranges in m and deg; also the ranges of the search");
  command->add_option("--seed", arguments->seed, "First seed (default 1)");
  command->add_option("--seeds", arguments->seeds, "Number of seeds (default 1)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--score-only",
                      arguments->score_only,
                      "Score another system's poses: CSV query,e,n,h,qw,qx,qy,qz");
  AddRunOutputOptions(*command, arguments->outputs, true);
  AddConfigOptions(*command, arguments->config);
}

}  // namespace ridgeline
