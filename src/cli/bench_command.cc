// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_command.h"

#include <memory>

#include "cli/bench_run.h"
#include "cli/command.h"

namespace ridgeline {

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
  AddKeptWorkOptions(*command, "runs", arguments->work);
  command
      ->add_option("--sensors",
                   arguments->sensors,
                   "Priors from a phone's instruments (CSV, docs/skyline.md), by query id")
      ->type_name("FILE");
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
