// SPDX-License-Identifier: Apache-2.0
#include "cli/compare.h"

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/crs.h"
#include "cli/command.h"
#include "cli/out_folder.h"
#include "cli/shell_command.h"
#include "cli/version.h"
#include "eval/comparison_files.h"
#include "eval/provenance.h"
#include "eval/results_csv.h"
#include "input/picture_input.h"
#include "input/world.h"
#include "report/compare_report.h"
#include "report/html_report.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct CompareArguments {
  std::vector<std::string> results;
  std::vector<std::string> names;
  std::string out;
  std::string dataset;
};

struct Results {
  System system;
  fs::path file;
  std::optional<Provenance> provenance;
};

const HashedFile* DatasetOf(const Results& results) {
  if (!results.provenance) return nullptr;
  for (const HashedFile& input : results.provenance->inputs) {
    if (input.role == "dataset") return &input;
  }
  return nullptr;
}

Results ReadResults(const fs::path& path, const std::string& name) {
  Results results;
  const bool is_folder = fs::is_directory(path);
  results.file = is_folder ? path / "results.csv" : path;
  if (!fs::exists(results.file)) {
    throw InputError(path.string(), "", "no results.csv", "a folder of bench, or its results.csv");
  }
  results.system.name = name;
  results.system.records = ReadResultsCsv(results.file);
  const fs::path provenance = results.file.parent_path() / kProvenanceFile;
  if (fs::exists(provenance)) {
    results.provenance = ReadProvenance(provenance);
    results.system.has_seeds = results.provenance->command != "bench --score-only";
  }
  return results;
}

// The folders' own names, or whole paths where those are the same.
std::vector<std::string> NamesOf(const CompareArguments& arguments) {
  if (!arguments.names.empty()) {
    if (arguments.names.size() == arguments.results.size()) return arguments.names;
    throw InputError("--name",
                     "",
                     std::to_string(arguments.names.size()) + " names",
                     "one for each of " + std::to_string(arguments.results.size()) + " results");
  }
  std::vector<std::string> names;
  std::map<std::string, int> count;
  for (const std::string& path : arguments.results) {
    const fs::path whole = fs::absolute(path).lexically_normal();
    names.push_back((whole.has_filename() ? whole : whole.parent_path()).filename().string());
    ++count[names.back()];
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (count[names[i]] > 1) names[i] = arguments.results[i];
  }
  return names;
}

void CheckSameDataset(const std::vector<Results>& all) {
  const Results* first = nullptr;
  for (const Results& results : all) {
    const HashedFile* dataset = DatasetOf(results);
    if (dataset == nullptr) continue;
    if (first == nullptr) first = &results;
    if (DatasetOf(*first)->sha256 == dataset->sha256) continue;
    throw InputError(results.file.string(),
                     "dataset",
                     dataset->path,
                     "the dataset of " + first->file.string() + ", " + DatasetOf(*first)->path);
  }
}

// The dataset that was asked for, or the results' own where it is still there.
std::optional<Dataset> FindDataset(const CompareArguments& arguments,
                                   const std::vector<Results>& all) {
  if (!arguments.dataset.empty()) return ReadDataset(arguments.dataset);
  for (const Results& results : all) {
    const HashedFile* dataset = DatasetOf(results);
    if (dataset == nullptr) continue;
    const fs::path place = PlaceOf(*dataset, *results.provenance);
    if (!place.empty()) return ReadDataset(place);
  }
  return std::nullopt;
}

// Whether a run has a truth, which an answer withheld does not say itself.
void MarkTruths(const std::optional<Dataset>& dataset, std::vector<Results>& all) {
  std::map<std::string, bool> has_truth;
  if (dataset) {
    for (const Query& query : dataset->queries) has_truth[query.id] = query.truth.has_value();
  }
  for (const Results& results : all) {
    for (const RunRecord& run : results.system.records) {
      if (run.error) has_truth[run.query] = true;
    }
  }
  for (Results& results : all) {
    for (RunRecord& run : results.system.records) run.has_truth = has_truth[run.query];
  }
}

std::string CommandOf(const CompareArguments& arguments) {
  ShellCommand command("ridgeline compare");
  for (const std::string& path : arguments.results) command.Word(path);
  return command.Option("--name", arguments.names).text();
}

void WritePage(const CompareArguments& arguments,
               const std::vector<Comparison>& comparisons,
               std::optional<Dataset> dataset,
               const Context& context) {
  CompareTitle title{"Comparison of " + comparisons.front().a + " with " + comparisons.front().b +
                         (comparisons.size() > 1 ? " and others" : ""),
                     CommandOf(arguments),
                     VersionText(),
                     ""};
  const fs::path file = fs::path(arguments.out) / "compare.html";
  if (!dataset) {
    context.Warn("the dataset is not where it was: no photos (--dataset FILE)");
    WriteHtmlReport(CompareReport(title, comparisons, nullptr, nullptr), file);
    return;
  }
  CompleteFromPictures(*dataset, false, PictureInputOptions{});
  World world = ReadWorld(RequestFor(*dataset, 50.0));
  for (const std::string& warning : world.warnings) context.Warn(warning);
  const LocalizerOptions options;
  const Localizer localizer(world.model, world.dtm, options);
  title.crs = CrsName(world.model.crs);
  WriteHtmlReport(CompareReport(title, comparisons, &*dataset, &localizer), file);
}

int RunCompare(const CompareArguments& arguments, const Context& context) {
  if (arguments.results.size() < 2) {
    throw InputError("compare", "", "results of one system", "those of two or more");
  }
  const std::vector<std::string> names = NamesOf(arguments);
  std::vector<Results> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    all.push_back(ReadResults(arguments.results[i], names[i]));
  }
  CheckSameDataset(all);
  const std::optional<Dataset> dataset = FindDataset(arguments, all);
  MarkTruths(dataset, all);
  const OutFolder out_folder("--out", arguments.out);
  std::vector<Comparison> comparisons;
  for (std::size_t i = 1; i < all.size(); ++i) {
    comparisons.push_back(Compare(all[0].system, all[i].system));
  }
  if (!arguments.out.empty()) {
    const fs::path out = arguments.out;
    WriteFileAtomically(out / "compare.csv", ComparisonCsv(comparisons));
    WriteFileAtomically(out / "pairs.csv", PairsCsv(comparisons));
    WriteFileAtomically(out / "compare.json", ComparisonJson(comparisons));
    WritePage(arguments, comparisons, dataset, context);
  }
  if (context.json) {
    context.Print(ComparisonJson(comparisons));
    return kExitOk;
  }
  for (const Comparison& comparison : comparisons) context.Print(ComparisonText(comparison));
  if (!arguments.out.empty()) context.Print("written to " + arguments.out);
  return kExitOk;
}

}  // namespace

void AddCompareCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"compare",
       "Compares results of several systems on the same photos, pair by pair.",
       "ridgeline compare results_paper results_default --out comparison\n"
       "ridgeline bench town/dataset.json --score-only poses.csv --out theirs\n"
       "ridgeline compare theirs results_default --out comparison"},
      [arguments](Context& c) { return RunCompare(*arguments, c); });
  command
      ->add_option("results",
                   arguments->results,
                   "Folders of bench, or their results.csv; the first is compared with each other")
      ->required();
  command->add_option("--name", arguments->names, "Names of the systems, in their order")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option(
          "--out", arguments->out, "Folder for compare.html, compare.csv, pairs.csv, compare.json")
      ->type_name("DIR");
  command
      ->add_option("--dataset", arguments->dataset, "dataset.json, if it is not where it was")
      ->type_name("FILE");
}

}  // namespace ridgeline
