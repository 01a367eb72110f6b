// SPDX-License-Identifier: Apache-2.0
#include "cli/merge.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/bench_run.h"
#include "cli/command.h"
#include "cli/in_folder.h"
#include "cli/out_folder.h"
#include "cli/study_run.h"
#include "eval/merge_folders.h"
#include "eval/run_folder.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> folders;
  std::string out;
  std::string report;
  bool no_report = false;
};

// All pieces are there, so that the command that made them only has to write its results.
int RunMerge(const MergeArguments& arguments, const Context& context) {
  const MergedFolders merged =
      FindShards({arguments.folders.begin(), arguments.folders.end()});
  const bool is_study = merged.whole.command == "study";
  if (is_study && arguments.no_report) {
    throw InputError("--no-report", "", "results of study", "it for bench, which reports unasked");
  }
  const std::string out = fs::absolute(arguments.out).lexically_normal().string();
  const std::string report =
      arguments.report.empty() ? "" : fs::absolute(arguments.report).string();
  const OutFolder out_folder("--out", out);
  {
    const RunFolder folder(out, merged.whole, true);
    folder.Begin();
    CopyPieces(merged.pieces, out);
  }
  const InFolder where_paths_hold(merged.whole.folder);
  if (is_study) {
    StudyArguments study = StudyArgumentsFrom(merged.whole);
    study.out = out;
    study.report = report;
    study.work.resume = true;
    return RunStudyCommand(study, context);
  }
  BenchArguments bench = BenchArgumentsFrom(merged.whole);
  bench.out = out;
  bench.outputs.report = report;
  bench.no_report = arguments.no_report;
  bench.work.resume = true;
  return RunBenchCommand(bench, context);
}

}  // namespace

void AddMergeCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"merge",
       "Puts the shards of a bench or a study together, as if it had been one.",
       "ridgeline bench town/dataset.json --shard 1/2 --out part1\n"
       "ridgeline bench town/dataset.json --shard 2/2 --out part2\n"
       "ridgeline merge part1 part2 --out results"},
      [arguments](Context& c) { return RunMerge(*arguments, c); });
  command->add_option("folders", arguments->folders, "Folders of all shards")->required();
  command->add_option("--out", arguments->out, "Folder for the whole's results")
      ->required()
      ->type_name("DIR");
  command->add_option("--report", arguments->report, "HTML report that opens offline")
      ->type_name("FILE");
  command->add_flag("--no-report", arguments->no_report, "No report.html of a bench");
}

}  // namespace ridgeline
