// SPDX-License-Identifier: Apache-2.0
#include "cli/verify.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "cli/bench_run.h"
#include "cli/command.h"
#include "cli/in_folder.h"
#include "cli/progress.h"
#include "cli/version.h"
#include "eval/run_folder.h"
#include "eval/run_json.h"
#include "eval/verify_results.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct VerifyArguments {
  std::string folder;
  int rerun = 0;
};

// Some runs, drawn by a fixed seed.
std::vector<PlannedRun> SampleOf(std::vector<PlannedRun> plan, int count) {
  constexpr std::uint64_t kSeed = 1;
  constexpr std::uint64_t kStage = 602;
  Random random(kSeed, kStage);
  std::vector<PlannedRun> sample;
  while (!plan.empty() && static_cast<int>(sample.size()) < count) {
    const std::size_t at = random.Below(plan.size());
    sample.push_back(plan[at]);
    plan.erase(plan.begin() + static_cast<long>(at));
  }
  return sample;
}

// Makes some runs again and compares all but their times.
std::vector<Check> Rerun(const fs::path& folder,
                         const Provenance& provenance,
                         const BenchArguments& arguments,
                         const BenchTask& task,
                         int count,
                         const Context& context) {
  const LocalizerOptions options = OptionsOf(arguments);
  World world = ReadWorldOf(task);
  const Localizer localizer(world.model, world.dtm, options);
  const BenchOptions bench = BenchOptionsOf(arguments, context);
  const std::vector<PlannedRun> sample = SampleOf(PlanRuns(task.queries, bench), count);
  std::vector<Check> checks;
  PictureReader pictures;
  Progress progress(context, "Making again", sample.size(), "runs");
  for (const PlannedRun& planned : sample) {
    const Query& query = task.queries.dataset().queries[planned.query];
    Check check{"run of " + query.id + ", seed " + std::to_string(planned.seed), true, ""};
    const auto kept = ReadPiece(folder, FingerprintOf(provenance), PieceNameOf(planned, query));
    const BenchRun again = MakeRun(planned, task.queries, localizer, pictures, context.threads);
    if (!kept) {
      check = {check.what, false, "is not among the results"};
    } else if (WithoutTimes(*kept) != WithoutTimes(RunText(again))) {
      check = {check.what, false, "gives another result now"};
    }
    checks.push_back(std::move(check));
    progress.Advance();
  }
  return checks;
}

// Of a folder of bench: its tables, and some of its runs.
std::vector<Check> CheckBench(const fs::path& folder,
                              const Provenance& provenance,
                              int rerun,
                              const Context& context) {
  const InFolder where_paths_hold(provenance.folder);
  BenchArguments arguments = BenchArgumentsFrom(provenance);
  if (provenance.shard) arguments.work.shard = TextOf(*provenance.shard);
  try {
    const BenchTask task = TaskOf(arguments, OptionsOf(arguments), context);
    std::vector<Check> checks = CheckTables(folder, provenance, task.queries.dataset());
    if (rerun == 0) return checks;
    for (Check& check : Rerun(folder, provenance, arguments, task, rerun, context)) {
      checks.push_back(std::move(check));
    }
    return checks;
  } catch (const InputError& e) {
    return {{"runs", false, std::string("cannot be judged: ") + e.what()}};
  }
}

int Report(const Provenance& provenance, const std::vector<Check>& checks, const Context& context) {
  const auto bad = std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.ok; });
  if (context.json) {
    Json list = Json::array();
    for (const Check& check : checks) {
      list.push_back({{"what", check.what}, {"ok", check.ok}, {"found", check.found}});
    }
    context.Print(Json({{"version", provenance.version},
                        {"command", provenance.command},
                        {"ok", bad == 0},
                        {"checks", list}})
                      .dump(1, ' ', false, Json::error_handler_t::replace));
  } else {
    for (const Check& check : checks) {
      if (!check.ok) context.Print(check.what + " " + check.found);
    }
    context.Print(std::to_string(checks.size() - static_cast<std::size_t>(bad)) + " of " +
                  std::to_string(checks.size()) + " as the results say (" + provenance.command +
                  ", " + provenance.version + ")");
  }
  return bad == 0 ? kExitOk : kExitBadInput;
}

int RunVerify(const VerifyArguments& arguments, const Context& context) {
  const fs::path folder = fs::absolute(arguments.folder).lexically_normal();
  const Provenance provenance = ProvenanceOfResults(folder);
  if (provenance.version != VersionText()) {
    context.Warn("made with " + provenance.version + ", verified with " + VersionText());
  }
  std::vector<Check> checks = CheckInputs(provenance);
  if (provenance.command == "bench") {
    for (Check& check : CheckBench(folder, provenance, arguments.rerun, context)) {
      checks.push_back(std::move(check));
    }
  } else if (arguments.rerun > 0) {
    throw InputError("--rerun", "", "results of " + provenance.command, "results of bench");
  }
  return Report(provenance, checks, context);
}

}  // namespace

void AddVerifyCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command =
      AddCommand(app,
                 context,
                 {"verify",
                  "Says whether results still are what their inputs give: hashes of the inputs, "
                  "tables, and runs made again.",
                  "ridgeline verify results --rerun 3"},
                 [arguments](Context& c) { return RunVerify(*arguments, c); });
  command->add_option("folder", arguments->folder, "Folder of bench, study or localize --out")
      ->required();
  command
      ->add_option(
          "--rerun", arguments->rerun, "Make so many runs of a bench again, and compare (default 0)")
      ->type_name("N")
      ->check(CLI::Range(0, 100000));
}

}  // namespace ridgeline
