// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_run.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "cli/bench_score_only.h"
#include "cli/bench_table.h"
#include "cli/idle_options.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/sensor_priors.h"
#include "cli/shell_command.h"
#include "cli/version.h"
#include "eval/run_folder.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What was made of pictures.
void NoteAssumptions(const Dataset& dataset, const Context& context) {
  for (const Query& query : dataset.queries) {
    for (const Assumption& assumption : query.assumptions) {
      context.Note("  " + query.id + ": " + TextOf(assumption));
    }
  }
}

// With --out the report goes there, unless another place is named or none is wanted; a shard's
// would show a part only.
RunOutputs OutputsOf(const BenchArguments& arguments) {
  RunOutputs outputs = arguments.outputs;
  if (outputs.report.empty() && !arguments.out.empty() && arguments.work.shard.empty() &&
      !arguments.no_report) {
    outputs.report = (fs::path(arguments.out) / "report.html").string();
  }
  return outputs;
}

// With the priors that instruments tell in place of the dataset's.
BenchTask TaskOfSensors(const BenchArguments& arguments, const Context& context) {
  Dataset dataset = ReadDataset(arguments.dataset);
  std::vector<std::string> set = arguments.config.set;
  PriorsFromSensors(arguments.sensors, TakeSensorOptions(arguments.sensors, set), context, dataset);
  return {BenchQueries(dataset), dataset};
}

BenchTask Chosen(const BenchArguments& arguments, BenchTask task) {
  if (!arguments.work.queries.empty() || !arguments.work.sets.empty()) {
    task.queries.Choose(arguments.work.queries, arguments.work.sets);
  }
  return task;
}

// Instruments and protocols both say what the priors are.
void CheckSensors(const BenchArguments& arguments) {
  if (arguments.sensors.empty()) return;
  const bool has_protocol = !arguments.protocol.empty();
  if (!has_protocol && arguments.perturb.empty()) return;
  throw InputError("--sensors",
                   "",
                   std::string("instruments beside ") + (has_protocol ? "--protocol" : "--perturb"),
                   "one of the two: both say what the priors are");
}

std::string ConfigName(const BenchArguments& arguments) {
  return arguments.config.config.empty() ? "default" : arguments.config.config;
}

}  // namespace

LocalizerOptions OptionsOf(const BenchArguments& arguments) {
  LocalizerOptions options;
  const VisitOptions visit = [&](OptionVisitor& v) { options.Visit(v); };
  ConfigArguments config = arguments.config;
  TakeSensorOptions(arguments.sensors, config.set);  // which are not a localizer's
  if (!arguments.options_json.empty()) {
    OptionsFromJson(arguments.options_json, kProvenanceFile, visit);
  } else {
    ApplyConfig(config, visit);
  }
  options.Validate();
  if (arguments.options_json.empty()) RefuseIdleOptions(config.set, options);
  return options;
}

BenchTask TaskOf(const BenchArguments& arguments,
                 const LocalizerOptions& options,
                 const Context& context) {
  if (!arguments.sensors.empty()) return Chosen(arguments, TaskOfSensors(arguments, context));
  BenchTask task = ReadBenchTask(
      {arguments.dataset, arguments.protocol, arguments.world, arguments.perturb}, options);
  if (task.asked > 0) {
    context.Note(std::to_string(task.asked) +
                 " queries take their camera or prior from EXIF and XMP:");
  }
  if (task.asked > 0 || task.queries.protocol().place == PriorPlace::kPicture) {
    NoteAssumptions(task.queries.dataset(), context);
  }
  return Chosen(arguments, std::move(task));
}

BenchOptions BenchOptionsOf(const BenchArguments& arguments, const Context& context) {
  BenchOptions bench;
  bench.seeds.clear();
  for (int k = 0; k < arguments.seeds; ++k) bench.seeds.push_back(arguments.seed + k);
  bench.threads = context.threads;
  if (!arguments.work.shard.empty()) bench.shard = ParseShard(arguments.work.shard);
  return bench;
}

Provenance ProvenanceOf(const BenchArguments& arguments,
                        const BenchTask& task,
                        const LocalizerOptions& options) {
  LocalizerOptions resolved = options;
  const Dataset& dataset = task.queries.dataset();
  Json queries = Json::array();
  for (const std::size_t q : task.queries.usable()) queries.push_back(dataset.queries[q].id);
  Provenance provenance;
  provenance.version = VersionText();
  provenance.command = "bench";
  provenance.folder = fs::current_path().string();
  provenance.arguments = Json({{"dataset", arguments.dataset},
                               {"protocol", arguments.protocol},
                               {"world", arguments.world},
                               {"perturb", arguments.perturb},
                               {"sensors", arguments.sensors},
                               {"queries", arguments.work.queries},
                               {"sets", arguments.work.sets},
                               {"seed", arguments.seed},
                               {"seeds", arguments.seeds},
                               {"config", arguments.config.config},
                               {"set", arguments.config.set}})
                             .dump(-1, ' ', false, Json::error_handler_t::replace);
  Json of_sensors = Json::array();
  for (const std::string& assignment : arguments.config.set) {
    if (assignment.starts_with("sensors.")) of_sensors.push_back(assignment);
  }
  provenance.task =
      Json({{"sensors", of_sensors},
            {"protocol", task.queries.protocol().name},
            {"first_seed", arguments.seed},
            {"seeds", arguments.seeds},
            {"queries", queries},
            {"options",
             Json::parse(OptionsToJson([&](OptionVisitor& v) { resolved.Visit(v); }))}})
          .dump(-1, ' ', false, Json::error_handler_t::replace);
  provenance.inputs = HashInputs(dataset, task.queries.usable(), "dataset");
  if (!arguments.sensors.empty()) AddHashed("sensors", arguments.sensors, provenance.inputs);
  if (!arguments.world.empty()) {
    for (HashedFile& input : HashInputs(task.searched, {}, "world")) {
      provenance.inputs.push_back(std::move(input));
    }
  }
  if (!arguments.work.shard.empty()) provenance.shard = ParseShard(arguments.work.shard);
  return provenance;
}

BenchArguments BenchArgumentsFrom(const Provenance& provenance) {
  const Json json = Json::parse(provenance.arguments);
  BenchArguments arguments;
  try {
    arguments.dataset = json.at("dataset").get<std::string>();
    arguments.protocol = json.at("protocol").get<std::string>();
    arguments.world = json.at("world").get<std::string>();
    arguments.perturb = json.at("perturb").get<std::string>();
    arguments.sensors = json.at("sensors").get<std::string>();
    arguments.work.queries = json.at("queries").get<std::vector<std::string>>();
    arguments.work.sets = json.at("sets").get<std::vector<std::string>>();
    arguments.seed = json.at("seed").get<int>();
    arguments.seeds = json.at("seeds").get<int>();
    arguments.config.config = json.at("config").get<std::string>();
    arguments.config.set = json.at("set").get<std::vector<std::string>>();
    arguments.options_json = Json::parse(provenance.task).at("options").dump();
  } catch (const Json::exception&) {
    throw InputError(kProvenanceFile, "arguments", "not those of bench", "results of bench");
  }
  return arguments;
}

std::string CommandOf(const BenchArguments& arguments) {
  ShellCommand command("ridgeline bench");
  command.Word(arguments.dataset)
      .Option("--config", arguments.config.config)
      .Option("--set", arguments.config.set)
      .Option("--protocol", arguments.protocol)
      .Option("--world", arguments.world)
      .Option("--perturb", arguments.perturb)
      .Option("--sensors", arguments.sensors);
  AddChoice(arguments.work, command);
  return command.Option("--seed", std::to_string(arguments.seed))
      .Option("--seeds", std::to_string(arguments.seeds))
      .text();
}

int RunBenchCommand(const BenchArguments& arguments, const Context& context) {
  if (!arguments.score_only.empty()) return RunScoreOnly(arguments, context);
  const LocalizerOptions options = OptionsOf(arguments);
  CheckKeeping(arguments.work, arguments.out, "runs");
  CheckSensors(arguments);
  BenchOptions bench = BenchOptionsOf(arguments, context);
  const OutFolder out_folder("--out", arguments.out);
  const RunOutputs outputs = OutputsOf(arguments);
  CheckRunOutputs(outputs, true);
  const BenchTask task = TaskOf(arguments, options, context);
  const Dataset& dataset = task.queries.dataset();
  const Protocol& protocol = task.queries.protocol();
  std::optional<RunFolder> folder;
  if (!arguments.out.empty()) {
    folder.emplace(arguments.out, ProvenanceOf(arguments, task, options), arguments.work.resume);
    bench.folder = &*folder;
    if (folder->found() > 0) {
      context.Note("going on with " + std::to_string(folder->found()) + " finished runs");
    }
  }
  World world = ReadWorldOf(task);
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const Localizer localizer(world.model, world.dtm, options);
  if (folder) folder->Begin();
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
  WriteBenchTables({dataset.name, ConfigName(arguments), protocol},
                   records,
                   world.model.origin_in_world,
                   arguments.out,
                   context);
  LocalizerOptions resolved = options;
  WriteRunOutputs(outputs,
                  true,
                  {"Bench of " + dataset.name + ", protocol " + protocol.name,
                   CommandOf(arguments),
                   OptionsToJson([&](OptionVisitor& v) { resolved.Visit(v); }),
                   protocol},
                  dataset.queries,
                  localizer,
                  runs,
                  context);
  return kExitOk;
}

}  // namespace ridgeline
