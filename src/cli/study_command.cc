// SPDX-License-Identifier: Apache-2.0
#include "cli/study_command.h"

#include <memory>

#include "cli/command.h"
#include "cli/study_run.h"
#include "cli/unsigned_option.h"

namespace ridgeline {

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
  AddKeptWorkOptions(*command, "maps", arguments->work);
  command
      ->add_option(
          "--out", arguments->out, "Folder for tables (CSV), pictures (PNG, SVG) and maps (GeoTIFF)")
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
      ->capture_default_str()
      ->check(Unsigned());
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
