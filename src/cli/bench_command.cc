// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
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
#include "eval/bench_queries.h"
#include "eval/protocol.h"
#include "input/picture_input.h"
#include "input/world.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string dataset;
  std::string out;
  std::string protocol;
  std::string world;
  std::string perturb;
  std::string score_only;
  bool no_report = false;
  int seed = 1;
  int seeds = 1;
  RunOutputs outputs;
  ConfigArguments config;
};

std::string ShareText(const char* name, const RunShare& share) {
  char text[100];
  std::snprintf(text,
                sizeof(text),
                "%s %.1f %% (%.1f to %.1f)",
                name,
                100.0 * share.share,
                100.0 * share.ci95.lower,
                100.0 * share.ci95.upper);
  return text;
}

std::string TableOf(const Summary& summary, const Protocol& protocol) {
  std::string text;
  char line[160];
  if (!protocol.HasRecall()) {
    text = "No right answer is in the search box: recall is not defined.\n";
    if (summary.runs > 0) {
      std::snprintf(line,
                    sizeof(line),
                    "found by widening, within 2 m and 2 deg: %.1f %%; ",
                    100.0 * summary.recall[2]);
      text += line + ShareText("confident and wrong", summary.confident_wrong) + "\n";
    }
  } else if (summary.runs == 0) {
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
                  "median error %.2f m, %.2f deg\n",
                  summary.translation_m.median,
                  summary.rotation_deg.median);
    text += line;
  }
  text += ShareText("confident (>= 0.9)", summary.confident) + ", " +
          ShareText("doubtful", summary.doubtful) + ", " +
          ShareText("abstained", summary.abstained) + "\n";
  std::snprintf(line,
                sizeof(line),
                "%.2f s per query (median), %.0f poses/s",
                summary.seconds_median,
                summary.evaluations_per_second);
  return text + line;
}

void WriteResults(const BenchArguments& arguments,
                  const Dataset& dataset,
                  const Protocol& protocol,
                  const std::vector<RunRecord>& records,
                  const Eigen::Vector3d& origin,
                  const Context& context) {
  const std::string config = arguments.config.config.empty() ? "default" : arguments.config.config;
  const std::string summary = SummaryJson(dataset.name, config, protocol, records);
  if (!arguments.out.empty()) {
    const fs::path out = arguments.out;
    WriteFileAtomically(out / "results.csv", ResultsCsv(records));
    WriteFileAtomically(out / "evidence.csv", EvidenceCsv(records));
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
  context.Print("protocol " + protocol.name + ": " + protocol.words);
  context.Print(TableOf(figures, protocol));
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

// What was made of pictures.
void NoteAssumptions(const Dataset& dataset, const Context& context) {
  for (const Query& query : dataset.queries) {
    for (const Assumption& assumption : query.assumptions) {
      context.Note("  " + query.id + ": " + TextOf(assumption));
    }
  }
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
  NoteAssumptions(dataset, context);
}

// With --out the report goes there, unless another place is named or none is wanted.
RunOutputs OutputsOf(const BenchArguments& arguments) {
  RunOutputs outputs = arguments.outputs;
  if (outputs.report.empty() && !arguments.out.empty() && arguments.score_only.empty() &&
      !arguments.no_report) {
    outputs.report = (fs::path(arguments.out) / "report.html").string();
  }
  return outputs;
}

std::string CommandOf(const BenchArguments& arguments) {
  std::string command = "ridgeline bench " + arguments.dataset;
  if (!arguments.config.config.empty()) command += " --config " + arguments.config.config;
  for (const std::string& assignment : arguments.config.set) command += " --set " + assignment;
  if (!arguments.protocol.empty()) command += " --protocol " + arguments.protocol;
  if (!arguments.world.empty()) command += " --world " + arguments.world;
  if (!arguments.perturb.empty()) command += " --perturb " + arguments.perturb;
  return command + " --seed " + std::to_string(arguments.seed) + " --seeds " +
         std::to_string(arguments.seeds);
}

// Poses that are there already take nothing of a search.
void CheckScoreOnly(const BenchArguments& arguments) {
  if (arguments.score_only.empty()) return;
  const BenchArguments defaults;
  const std::pair<bool, const char*> given[] = {
      {!arguments.protocol.empty(), "--protocol"},
      {!arguments.world.empty(), "--world"},
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

// Absent: the dataset's own priors.
std::optional<Protocol> ProtocolOf(const BenchArguments& arguments) {
  std::optional<Protocol> protocol;
  if (!arguments.perturb.empty()) protocol = PerturbedProtocol(arguments.perturb);
  if (!arguments.protocol.empty()) protocol = FindProtocol(arguments.protocol);
  const bool elsewhere = protocol && protocol->place == PriorPlace::kOtherWorld;
  if (elsewhere && arguments.world.empty()) {
    throw InputError("--world", "", "nothing", "the dataset.json of the place that is searched");
  }
  if (!elsewhere && !arguments.world.empty()) {
    throw InputError("--world", "", arguments.world, "--protocol elsewhere with it");
  }
  return protocol;
}

// The queries as the search gets them, and the dataset whose model is searched.
struct BenchTask {
  BenchQueries queries;
  Dataset searched;
};

BenchTask TaskOf(const BenchArguments& arguments,
                 const LocalizerOptions& options,
                 const Context& context) {
  Dataset dataset = ReadDataset(arguments.dataset);
  const std::optional<Protocol> protocol = ProtocolOf(arguments);
  const PriorPlace place = protocol ? protocol->place : PriorPlace::kDataset;
  if (place != PriorPlace::kPicture) {
    CompleteDataset(dataset, place == PriorPlace::kDataset, options, context);
  }
  if (!protocol) return {BenchQueries(dataset), dataset};
  if (place != PriorPlace::kOtherWorld) {
    BenchQueries queries(*protocol, std::move(dataset), options.search.space);
    if (place == PriorPlace::kPicture) NoteAssumptions(queries.dataset(), context);
    return {queries, queries.dataset()};
  }
  const Dataset other = ReadDataset(arguments.world);
  dataset.name += " in " + other.name;
  return {BenchQueries(*protocol, std::move(dataset), options.search.space, PlacesOf(other)),
          other};
}

int RunScoreOnly(const BenchArguments& arguments, const Context& context) {
  const Dataset dataset = ReadDataset(arguments.dataset);
  Protocol protocol;
  protocol.name = "score-only";
  protocol.words = "poses of another system, " + arguments.score_only;
  WriteResults(arguments,
               dataset,
               protocol,
               ScorePoses(dataset, arguments.score_only),
               Eigen::Vector3d::Zero(),
               context);
  return kExitOk;
}

int RunBenchCommand(const BenchArguments& arguments, const Context& context) {
  LocalizerOptions options;
  ApplyConfig(arguments.config, [&](OptionVisitor& v) { options.Visit(v); });
  options.Validate();
  RefuseIdleOptions(arguments.config.set, options);
  CheckScoreOnly(arguments);
  BenchOptions bench;
  bench.seeds.clear();
  for (int k = 0; k < arguments.seeds; ++k) bench.seeds.push_back(arguments.seed + k);
  bench.threads = context.threads;
  const OutFolder out_folder("--out", arguments.out);
  const RunOutputs outputs = OutputsOf(arguments);
  CheckRunOutputs(outputs, true);
  if (!arguments.score_only.empty()) return RunScoreOnly(arguments, context);
  const BenchTask task = TaskOf(arguments, options, context);
  const Dataset& dataset = task.queries.dataset();
  const Protocol& protocol = task.queries.protocol();
  // Places are those of truths and priors; a box beside the truth reaches further.
  const double margin_m = protocol.place == PriorPlace::kBesideTruth ? 100.0 : 50.0;
  WorldRequest request = RequestFor(task.searched, margin_m);
  request.needs_terrain = request.needs_terrain || task.queries.NeedsTerrain();
  World world = ReadWorld(request);
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
    runs = RunBench(task.queries, localizer, bench, show);
  }
  WriteResults(arguments, dataset, protocol, records, world.model.origin_in_world, context);
  WriteRunOutputs(outputs,
                  true,
                  {"Bench of " + dataset.name + ", protocol " + protocol.name,
                   CommandOf(arguments),
                   OptionsToJson([&](OptionVisitor& v) { options.Visit(v); }),
                   protocol},
                  dataset.queries,
                  localizer,
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
                  "ridgeline bench town/dataset.json --protocol phone --seeds 5 --out results"},
                 [arguments](Context& c) { return RunBenchCommand(*arguments, c); });
  command->add_option("dataset", arguments->dataset, "dataset.json")->required();
  command->add_option(
      "--out", arguments->out, "Folder for results.csv, summary.json, poses.txt and report.html");
  command
      ->add_option("--protocol",
                   arguments->protocol,
                   "What a search is told: paper, known-tilt, phone, photo, outside or elsewhere "
                   "(default: the dataset's priors)")
      ->type_name("NAME");
  command
      ->add_option("--world",
                   arguments->world,
                   "With --protocol elsewhere: dataset.json of the place that is searched")
      ->type_name("FILE");
  command
      ->add_option("--perturb",
                   arguments->perturb,
                   "Draw priors around the truth: east,north,height,heading[,pitch,roll] "
                   "half-ranges in m and deg; also the ranges of the search")
      ->excludes("--protocol");
  command->add_flag("--no-report", arguments->no_report, "No report.html: for many small runs");
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
