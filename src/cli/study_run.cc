// SPDX-License-Identifier: Apache-2.0
#include "cli/study_run.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/out_folder.h"
#include "cli/progress.h"
#include "cli/shell_command.h"
#include "cli/study_output.h"
#include "cli/study_table.h"
#include "cli/unread_options.h"
#include "cli/version.h"
#include "eval/run_folder.h"
#include "input/picture_input.h"
#include "input/world.h"
#include "report/html_report.h"
#include "report/study_report.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string CommandOf(const StudyArguments& arguments) {
  ShellCommand command("ridgeline study");
  command.Word(arguments.dataset).Option("--score", arguments.scores);
  AddChoice(arguments.work, command);
  command.Option("--vary", arguments.vary);
  if (arguments.explore) command.Word("--explore");
  std::string classes;
  for (const int c : arguments.classes) classes += (classes.empty() ? "" : ",") + std::to_string(c);
  return command.Option("--config", arguments.config.config)
      .Option("--set", arguments.config.set)
      .Option("--protocol", arguments.protocol)
      .Option("--perturb", arguments.perturb)
      .Option("--seed", std::to_string(arguments.seed))
      .Option("--classes", classes)
      .text();
}

std::vector<Variation> VariationsOf(const std::vector<std::string>& texts) {
  std::vector<Variation> variations;
  for (const std::string& text : texts) {
    if (text == "all") return Variations();
    variations.push_back(ParseVariation(text));
  }
  return variations;
}

Protocol ProtocolOf(const StudyArguments& arguments) {
  if (!arguments.perturb.empty()) return PerturbedProtocol(arguments.perturb);
  if (arguments.protocol.empty()) return FindProtocol("known-tilt");
  const Protocol& protocol = FindProtocol(arguments.protocol);
  if (!protocol.HasRecall()) {
    throw InputError("--protocol",
                     "",
                     "\"" + protocol.name + "\"",
                     "one whose box holds the truth, since a study compares scores with it");
  }
  return protocol;
}

LocalizerOptions OptionsOf(const StudyArguments& arguments) {
  LocalizerOptions options;
  const VisitOptions visit = [&](OptionVisitor& v) { options.Visit(v); };
  if (!arguments.options_json.empty()) {
    OptionsFromJson(arguments.options_json, kProvenanceFile, visit);
  } else {
    ApplyConfig(arguments.config, visit);
  }
  options.Validate();
  return options;
}

StudyOptions StudyOptionsOf(const StudyArguments& arguments, const Context& context) {
  StudyOptions options;
  options.seed = arguments.seed;
  options.classes = arguments.classes;
  options.explore = arguments.explore;
  options.threads = context.threads;
  if (!arguments.work.shard.empty()) options.shard = ParseShard(arguments.work.shard);
  options.Validate();
  return options;
}

// What the results depend on.
Provenance ProvenanceOf(const StudyArguments& arguments,
                        const Dataset& dataset,
                        const std::vector<std::size_t>& queries,
                        const StudyNames& names,
                        const Protocol& protocol,
                        LocalizerOptions options) {
  Json ids = Json::array();
  for (const std::size_t q : queries) ids.push_back(dataset.queries[q].id);
  Json scores = Json::array();
  for (const ScoreChoice& score : names.scores) scores.push_back(score.name);
  Json variations = Json::array();
  for (const Variation& v : names.variations) variations.push_back({v.name, Json(v.levels)});
  Provenance provenance;
  provenance.version = VersionText();
  provenance.command = "study";
  provenance.folder = fs::current_path().string();
  provenance.arguments = Json({{"dataset", arguments.dataset},
                               {"scores", arguments.scores},
                               {"queries", arguments.work.queries},
                               {"sets", arguments.work.sets},
                               {"vary", arguments.vary},
                               {"classes", arguments.classes},
                               {"protocol", arguments.protocol},
                               {"perturb", arguments.perturb},
                               {"seed", arguments.seed},
                               {"explore", arguments.explore},
                               {"config", arguments.config.config},
                               {"set", arguments.config.set}})
                             .dump(-1, ' ', false, Json::error_handler_t::replace);
  provenance.task =
      Json({{"protocol", protocol.name},
            {"seed", arguments.seed},
            {"queries", ids},
            {"scores", scores},
            {"variations", variations},
            {"classes", arguments.classes},
            {"explore", arguments.explore},
            {"options", Json::parse(OptionsToJson([&](OptionVisitor& v) { options.Visit(v); }))}})
          .dump(-1, ' ', false, Json::error_handler_t::replace);
  provenance.inputs = HashInputs(dataset, queries, "dataset");
  if (!arguments.work.shard.empty()) provenance.shard = ParseShard(arguments.work.shard);
  return provenance;
}

struct StudyRuns {
  std::vector<ScoreStudy> studies;
  std::vector<VariedStudy> varied;
};

StudyRuns MakeMaps(const BenchQueries& source,
                   std::span<const std::size_t> queries,
                   const Localizer& localizer,
                   const StudyNames& names,
                   const StudyOptions& options,
                   const Context& context) {
  StudyRuns runs;
  std::unique_ptr<Progress> progress;
  const auto show = [&](const char* title) {
    return [&progress, &context, title](const StudyProgress& p) {
      if (!progress) progress = std::make_unique<Progress>(context, title, p.total, "maps");
      progress->Set(p.done);
    };
  };
  runs.studies = RunStudy(source, queries, localizer, names.scores, options, show("Mapping"));
  progress.reset();
  if (names.variations.empty()) return runs;
  runs.varied = RunVariations(
      source, queries, localizer, names.scores, names.variations, options, show("Varying"));
  return runs;
}

}  // namespace

StudyArguments StudyArgumentsFrom(const Provenance& provenance) {
  using Texts = std::vector<std::string>;
  const Json json = Json::parse(provenance.arguments);
  StudyArguments arguments;
  try {
    arguments.dataset = json.at("dataset").get<std::string>();
    arguments.scores = json.at("scores").get<Texts>();
    arguments.work.queries = json.at("queries").get<Texts>();
    arguments.work.sets = json.at("sets").get<Texts>();
    arguments.vary = json.at("vary").get<Texts>();
    arguments.classes = json.at("classes").get<std::vector<int>>();
    arguments.protocol = json.at("protocol").get<std::string>();
    arguments.perturb = json.at("perturb").get<std::string>();
    arguments.seed = json.at("seed").get<std::uint64_t>();
    arguments.explore = json.at("explore").get<bool>();
    arguments.config.config = json.at("config").get<std::string>();
    arguments.config.set = json.at("set").get<Texts>();
    arguments.options_json = Json::parse(provenance.task).at("options").dump();
  } catch (const Json::exception&) {
    throw InputError(kProvenanceFile, "arguments", "not those of study", "results of study");
  }
  return arguments;
}

int RunStudyCommand(const StudyArguments& arguments, const Context& context) {
  const LocalizerOptions localizer_options = OptionsOf(arguments);
  CheckKeeping(arguments.work, arguments.out, "maps");
  StudyOptions options = StudyOptionsOf(arguments, context);
  const std::vector<ScoreChoice> scores = ChooseScores(arguments.scores, localizer_options.score);
  const std::vector<Variation> variations = VariationsOf(arguments.vary);
  const Protocol protocol = ProtocolOf(arguments);
  if (arguments.options_json.empty()) {
    RefuseUnreadOptions(
        arguments.config.set, localizer_options, scores, !arguments.scores.empty(), protocol);
  }
  Dataset with_cameras = ReadDataset(arguments.dataset);
  if (protocol.place != PriorPlace::kPicture) {
    CompleteFromPictures(with_cameras, false, PictureInputOptions{});  // priors are drawn
  }
  const BenchQueries source(protocol, std::move(with_cameras), localizer_options.search.space);
  const Dataset& dataset = source.dataset();
  const std::vector<std::size_t> queries =
      StudyQueries(dataset, arguments.work.queries, arguments.work.sets);
  const StudyNames names{dataset, scores, variations};
  const OutFolder out_folder("--out", arguments.out);
  CheckFileToWrite("--report", arguments.report);
  std::optional<RunFolder> folder;
  if (!arguments.out.empty()) {
    folder.emplace(
        arguments.out,
        ProvenanceOf(arguments, dataset, queries, names, source.protocol(), localizer_options),
        arguments.work.resume);
    options.folder = &*folder;
    if (folder->found() > 0) {
      context.Note("going on with " + std::to_string(folder->found()) + " finished maps");
    }
  }

  constexpr double kPlaceMarginM = 50.0;
  WorldRequest request = RequestFor(dataset, kPlaceMarginM);
  request.needs_terrain = request.needs_terrain || source.NeedsTerrain();
  World world = ReadWorld(request);
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const Localizer localizer(world.model, std::move(world.dtm), localizer_options);
  if (folder) folder->Begin();
  const StudyRuns runs = MakeMaps(source, queries, localizer, names, options, context);

  const std::vector<StudySummary> summaries = SummariesOf(runs.studies, scores, dataset.name);
  const std::vector<LevelSummary> levels = LevelSummariesOf(runs.varied, scores);
  const int epsg = localizer.scene().model().crs.horizontal_epsg;
  if (!arguments.out.empty()) {
    WriteStudy({names, source.protocol(), options, runs.studies, summaries, runs.varied, levels},
               epsg,
               arguments.out);
  }
  if (!arguments.report.empty()) {
    LocalizerOptions resolved = localizer_options;
    WriteHtmlReport(StudyReport({"Score study of " + dataset.name,
                                 CommandOf(arguments),
                                 VersionText(),
                                 epsg == 0 ? "" : "EPSG:" + std::to_string(epsg),
                                 OptionsToJson([&](OptionVisitor& v) { resolved.Visit(v); }),
                                 source.protocol()},
                                names,
                                localizer,
                                options,
                                runs.studies,
                                summaries,
                                levels),
                    arguments.report);
    context.Note("report: " + arguments.report);
  }
  if (context.json) {
    context.Print(StudySummaryJson(dataset.name, source.protocol(), summaries));
    return kExitOk;
  }
  context.Print("protocol " + source.protocol().name + ": " + source.protocol().words);
  context.Print(TableOf(summaries));
  if (!levels.empty()) context.Print(SensitivityTextOf(names, levels));
  if (!arguments.out.empty()) context.Print("written to " + arguments.out);
  return kExitOk;
}

}  // namespace ridgeline
