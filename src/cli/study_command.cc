// SPDX-License-Identifier: Apache-2.0
#include "cli/study_command.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/command.h"
#include "cli/progress.h"
#include "cli/study_output.h"
#include "cli/version.h"
#include "input/picture_input.h"
#include "input/world.h"
#include "report/html_report.h"
#include "report/study_report.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::string dataset;
  std::string out;
  std::string report;
  std::vector<std::string> scores;
  std::vector<std::string> queries;
  std::vector<std::string> vary;
  std::vector<int> classes = {50, 100, 200};
  std::string protocol;
  std::string perturb;
  std::uint64_t seed = 1;
  bool explore = false;
  ConfigArguments config;
};

std::string Cell(const char* format, double value) {
  if (!std::isfinite(value)) return "-";
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string TableOf(std::span<const StudySummary> summaries) {
  char line[256];
  std::string text =
      "                                          minimum within         medians\n"
      "score                set          queries 2m2deg 5m5deg 9m10deg  better     comes home from "
      "  "
      "margin  rank\n";
  for (const StudySummary& s : summaries) {
    std::snprintf(line,
                  sizeof line,
                  "%-20.20s %-12.12s %7d %4.0f %% %4.0f %% %5.0f %%  %-9s %5s m %5s deg  %6s %6s\n",
                  s.score.c_str(),
                  s.set.c_str(),
                  s.queries,
                  100.0 * s.recall[0],
                  100.0 * s.recall[1],
                  100.0 * s.recall[2],
                  Cell("%.3g %%", 100.0 * s.median[2]).c_str(),
                  Cell("%.1f", s.median[3]).c_str(),
                  Cell("%.1f", s.median[4]).c_str(),
                  Cell("%.2f", s.median[5]).c_str(),
                  Cell("%.2f", s.median[6]).c_str());
    text += line;
  }
  text.pop_back();
  return text;
}

std::string SensitivityTextOf(const StudyNames& names, std::span<const LevelSummary> levels) {
  char line[256];
  std::string text =
      "                                       minimum within         medians\n"
      "changed     level    score             2m2deg 5m5deg 9m10deg  better     comes home from\n";
  for (const LevelSummary& entry : levels) {
    const Variation& variation = names.variations[entry.variation];
    const StudySummary& s = entry.summary;
    std::snprintf(line,
                  sizeof line,
                  "%-11s %-8s %-17.17s %4.0f %% %4.0f %% %5.0f %%  %-9s %5s m %5s deg\n",
                  variation.name.c_str(),
                  variation.levels[entry.level].c_str(),
                  s.score.c_str(),
                  100.0 * s.recall[0],
                  100.0 * s.recall[1],
                  100.0 * s.recall[2],
                  Cell("%.3g %%", 100.0 * s.median[2]).c_str(),
                  Cell("%.1f", s.median[3]).c_str(),
                  Cell("%.1f", s.median[4]).c_str());
    text += line;
  }
  text.pop_back();
  return text;
}

std::string CommandOf(const StudyArguments& arguments) {
  std::string command = "ridgeline study " + arguments.dataset;
  for (const std::string& score : arguments.scores) command += " --score " + score;
  for (const std::string& query : arguments.queries) command += " --query " + query;
  for (const std::string& name : arguments.vary) command += " --vary " + name;
  if (arguments.explore) command += " --explore";
  if (!arguments.config.config.empty()) command += " --config " + arguments.config.config;
  for (const std::string& assignment : arguments.config.set) command += " --set " + assignment;
  if (!arguments.protocol.empty()) command += " --protocol " + arguments.protocol;
  if (!arguments.perturb.empty()) command += " --perturb " + arguments.perturb;
  command += " --seed " + std::to_string(arguments.seed);
  std::string classes;
  for (const int c : arguments.classes) classes += (classes.empty() ? "" : ",") + std::to_string(c);
  return command + " --classes " + classes;
}

std::vector<Variation> VariationsOf(const std::vector<std::string>& texts) {
  std::vector<Variation> variations;
  for (const std::string& text : texts) {
    if (text == "all") return Variations();
    variations.push_back(ParseVariation(text));
  }
  return variations;
}

// Fails before the work, not after.
void CheckOutputs(const StudyArguments& arguments) {
  if (!arguments.out.empty()) {
    std::error_code error;
    fs::create_directories(arguments.out, error);
    if (error) throw InputError("--out", "", arguments.out + ": " + error.message(), "a folder");
    TemporaryBeside(fs::path(arguments.out) / "summary.csv");
  }
  if (!arguments.report.empty()) TemporaryBeside(arguments.report);
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

int RunStudyCommand(const StudyArguments& arguments, const Context& context) {
  LocalizerOptions localizer_options;
  ApplyConfig(arguments.config, [&](OptionVisitor& v) { localizer_options.Visit(v); });
  localizer_options.Validate();
  StudyOptions options;
  options.seed = arguments.seed;
  options.classes = arguments.classes;
  options.explore = arguments.explore;
  options.threads = context.threads;
  options.Validate();
  const std::vector<ScoreChoice> scores = ChooseScores(arguments.scores, localizer_options.score);
  const std::vector<Variation> variations = VariationsOf(arguments.vary);
  const Protocol protocol = ProtocolOf(arguments);
  Dataset with_cameras = ReadDataset(arguments.dataset);
  if (protocol.place != PriorPlace::kPicture) {
    CompleteFromPictures(with_cameras, false, PictureInputOptions{});  // priors are drawn
  }
  const BenchQueries source(protocol, std::move(with_cameras), localizer_options.search.space);
  const Dataset& dataset = source.dataset();
  const std::vector<std::size_t> queries = StudyQueries(dataset, arguments.queries);
  CheckOutputs(arguments);

  constexpr double kPlaceMarginM = 50.0;
  WorldRequest request = RequestFor(dataset, kPlaceMarginM);
  request.needs_terrain = request.needs_terrain || source.NeedsTerrain();
  World world = ReadWorld(request);
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const Localizer localizer(world.model, std::move(world.dtm), localizer_options);
  std::vector<ScoreStudy> studies;
  {
    Progress progress(context, "Mapping", queries.size() * scores.size(), "maps");
    studies = RunStudy(source, queries, localizer, scores, options, [&](const StudyProgress& p) {
      progress.Set(p.done);
    });
  }
  std::vector<VariedStudy> varied;
  if (!variations.empty()) {
    std::unique_ptr<Progress> progress;
    varied = RunVariations(
        source, queries, localizer, scores, variations, options, [&](const StudyProgress& p) {
          if (!progress) progress = std::make_unique<Progress>(context, "Varying", p.total, "maps");
          progress->Set(p.done);
        });
  }

  const StudyNames names{dataset, scores, variations};
  const std::vector<StudySummary> summaries = SummariesOf(studies, scores, dataset.name);
  const std::vector<LevelSummary> levels = LevelSummariesOf(varied, scores);
  const int epsg = localizer.scene().model().crs.horizontal_epsg;
  if (!arguments.out.empty()) {
    WriteStudy({names, source.protocol(), options, studies, summaries, varied, levels},
               epsg,
               arguments.out);
  }
  if (!arguments.report.empty()) {
    WriteHtmlReport(
        StudyReport({"Score study of " + dataset.name,
                     CommandOf(arguments),
                     VersionText(),
                     epsg == 0 ? "" : "EPSG:" + std::to_string(epsg),
                     OptionsToJson([&](OptionVisitor& v) { localizer_options.Visit(v); }),
                     source.protocol()},
                    names,
                    localizer,
                    options,
                    studies,
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

}  // namespace

void AddStudyCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"study",
       "Shows how far scores can be trusted: dense maps of their energy around priors drawn near "
       "the "
       "truth, with figures of reliability.",
       "ridgeline study town/dataset.json --score evidence,line_energy --out study --report "
       "study.html\n"
       "ridgeline study town/dataset.json --vary heights --vary focal=-10,0,10"},
      [arguments](Context& c) { return RunStudyCommand(*arguments, c); });
  command->add_option("dataset", arguments->dataset, "dataset.json, with truths")->required();
  command
      ->add_option("--score",
                   arguments->scores,
                   "Scores, or cues of \"evidence\" alone; \"all\" (default: the configuration's)")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--query", arguments->queries, "These queries only (default: all with a truth)")
      ->type_name("ID")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--out", arguments->out, "Folder for tables (CSV), pictures (PNG) and maps (GeoTIFF)")
      ->type_name("DIR");
  command->add_option("--report", arguments->report, "HTML report that opens offline")
      ->type_name("FILE");
  command
      ->add_option(
          "--protocol",
          arguments->protocol,
          "What the prior knows, and box of the map: paper, known-tilt (default), phone or "
          "photo")
      ->type_name("NAME");
  command
      ->add_option("--perturb",
                   arguments->perturb,
                   "The same in numbers: east,north,height,heading[,pitch,roll] half-ranges in m "
                   "and deg")
      ->excludes("--protocol");
  command->add_option("--seed", arguments->seed, "Seed of priors, searches and variations")
      ->capture_default_str();
  command
      ->add_option("--classes",
                   arguments->classes,
                   "Evaluations of a TPE search after which score and error are compared")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("50,100,200");
  command
      ->add_option("--vary",
                   arguments->vary,
                   "Sensitivity to edges, clutter, heights, footprints, focal, size, detector, or "
                   "all; may be repeated")
      ->type_name("NAME[=LEVEL,...]")
      ->allow_extra_args(false);
  command->add_flag("--explore",
                    arguments->explore,
                    "Positions every 0.5 m with the best heading, pitch and roll at each");
  AddConfigOptions(*command, arguments->config);
}

}  // namespace ridgeline
