// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_score_only.h"

#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/crs.h"
#include "cli/bench_table.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/shell_command.h"
#include "cli/version.h"
#include "eval/bench_files.h"
#include "eval/judge_pose.h"
#include "eval/run_folder.h"
#include "input/picture_input.h"
#include "input/world.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Poses that are there already take nothing of a search.
void CheckArguments(const BenchArguments& arguments) {
  const BenchArguments defaults;
  const std::pair<bool, const char*> given[] = {{!arguments.protocol.empty(), "--protocol"},
                                                {!arguments.world.empty(), "--world"},
                                                {!arguments.perturb.empty(), "--perturb"},
                                                {!arguments.sensors.empty(), "--sensors"},
                                                {arguments.seed != defaults.seed, "--seed"},
                                                {arguments.seeds != defaults.seeds, "--seeds"},
                                                {arguments.work.resume, "--resume"},
                                                {!arguments.work.shard.empty(), "--shard"}};
  for (const auto& [is_given, option] : given) {
    if (is_given) {
      throw InputError(option, "", "an option of a search", "nothing of it beside --score-only");
    }
  }
}

std::map<std::string, Pose> ReadPoses(const fs::path& path, const Dataset& dataset) {
  std::map<std::string, Pose> poses = ReadPosesCsv(path);
  std::map<std::string, Pose> known;
  for (const Query& query : dataset.queries) {
    if (auto node = poses.extract(query.id)) known.insert(std::move(node));
  }
  if (!poses.empty()) {
    throw InputError(path.string(),
                     "query",
                     "\"" + poses.begin()->first + "\"",
                     "an id of " + dataset.file.string());
  }
  return known;
}

// Cameras that are left to pictures, of the pictures that are there.
void CompleteCameras(Dataset& dataset) {
  PictureReader pictures;
  std::optional<Crs> crs;
  for (Query& query : dataset.queries) {
    std::error_code error;
    if (query.camera || !fs::exists(query.image, error)) continue;
    CompleteFromPicture(dataset, false, PictureInputOptions{}, pictures, crs, query);
  }
}

// As far as poses may be off and still be looked at.
constexpr double kFarM = 200.0;

WorldRequest RequestWith(const Dataset& dataset, const std::map<std::string, Pose>& poses) {
  WorldRequest request = RequestFor(dataset, 50.0);
  const Eigen::AlignedBox2d places = request.places;
  for (const auto& [id, pose] : poses) {
    const Eigen::Vector2d place = pose.center_in_world.head<2>();
    if (places.isEmpty() || places.exteriorDistance(place) < kFarM) request.places.extend(place);
  }
  return request;
}

// One pose in the place of a localization.
BenchRun RunOf(const Dataset& dataset,
               std::size_t index,
               const std::map<std::string, Pose>& poses,
               const Localizer& localizer,
               PictureReader& pictures,
               int threads) {
  const Query& query = dataset.queries[index];
  BenchRun run;
  run.query = index;
  run.is_given = true;
  Localization& found = run.localization;
  found.energy = found.confidence = found.posterior_mass = kNone;
  found.reason = "no pose is given";
  std::error_code error;
  if (const auto it = poses.find(query.id); it != poses.end()) {
    found.pose = it->second;
    found.status = LocalizationStatus::kOk;
    found.reason.clear();
    if (query.camera && fs::exists(query.image, error)) {
      const LocalizationInput input = InputOf(query, localizer.options(), pictures);
      PoseJudgement judgement = JudgePose(localizer, input, *found.pose, threads);
      found.energy = judgement.energy;
      found.goodness = std::move(judgement.goodness);
      if (!judgement.reason.empty()) found.notes = {"no energy: " + judgement.reason};
    } else {
      found.notes = {"no energy: no picture with a camera"};
    }
  }
  run.record = RecordOf(query, 1, found, kNone);
  run.record.is_searched = false;
  run.record.ellipse_holds_truth.reset();  // other systems give no region
  run.record.interval_holds_truth.reset();
  return run;
}

Provenance ProvenanceOfPoses(const BenchArguments& arguments,
                             const Dataset& dataset,
                             const std::vector<std::size_t>& chosen,
                             LocalizerOptions options) {
  Json queries = Json::array();
  for (const std::size_t q : chosen) queries.push_back(dataset.queries[q].id);
  Provenance provenance;
  provenance.version = VersionText();
  provenance.command = "bench --score-only";
  provenance.folder = fs::current_path().string();
  provenance.arguments = Json({{"dataset", arguments.dataset},
                               {"score_only", arguments.score_only},
                               {"queries", arguments.work.queries},
                               {"sets", arguments.work.sets},
                               {"config", arguments.config.config},
                               {"set", arguments.config.set}})
                             .dump(-1, ' ', false, Json::error_handler_t::replace);
  provenance.task =
      Json({{"queries", queries},
            {"options", Json::parse(OptionsToJson([&](OptionVisitor& v) { options.Visit(v); }))}})
          .dump(-1, ' ', false, Json::error_handler_t::replace);
  provenance.inputs = HashInputs(dataset, chosen, "dataset");
  AddHashed("poses", arguments.score_only, provenance.inputs);
  return provenance;
}

std::string CommandOfPoses(const BenchArguments& arguments) {
  return ShellCommand("ridgeline bench")
      .Word(arguments.dataset)
      .Option("--score-only", arguments.score_only)
      .Option("--config", arguments.config.config)
      .Option("--set", arguments.config.set)
      .text();
}

}  // namespace

int RunScoreOnly(const BenchArguments& arguments, const Context& context) {
  CheckArguments(arguments);
  LocalizerOptions options = OptionsOf(arguments);
  const OutFolder out_folder("--out", arguments.out);
  CheckRunOutputs(arguments.outputs, true);
  Dataset dataset = ReadDataset(arguments.dataset);
  const std::vector<std::size_t> chosen =
      ChooseQueries(dataset, arguments.work.queries, arguments.work.sets);
  const std::map<std::string, Pose> poses = ReadPoses(arguments.score_only, dataset);
  CompleteCameras(dataset);
  std::optional<RunFolder> folder;
  if (!arguments.out.empty()) {
    folder.emplace(
        arguments.out, ProvenanceOfPoses(arguments, dataset, chosen, options), arguments.work.resume);
  }
  World world = ReadWorld(RequestWith(dataset, poses));
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const Localizer localizer(world.model, world.dtm, options);
  if (folder) folder->Begin();
  PictureReader pictures;
  std::vector<BenchRun> runs;
  std::vector<RunRecord> records;
  {
    Progress progress(context, "Judging", chosen.size(), "poses");
    for (const std::size_t q : chosen) {
      runs.push_back(RunOf(dataset, q, poses, localizer, pictures, context.threads));
      records.push_back(runs.back().record);
      progress.Advance();
    }
  }
  Protocol protocol;
  protocol.name = "score-only";
  protocol.words = "poses of another system, " + arguments.score_only;
  WriteBenchTables({dataset.name, "", protocol},
                   records,
                   world.model.origin_in_world,
                   arguments.out,
                   context);
  WriteRunOutputs(arguments.outputs,
                  true,
                  {"Poses of " + fs::path(arguments.score_only).filename().string() + " in " +
                       dataset.name,
                   CommandOfPoses(arguments),
                   OptionsToJson([&](OptionVisitor& v) { options.Visit(v); }),
                   protocol},
                  dataset.queries,
                  localizer,
                  runs,
                  context);
  return kExitOk;
}

}  // namespace ridgeline
