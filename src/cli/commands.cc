// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"

#include "cli/augment.h"
#include "cli/bench_command.h"
#include "cli/calibrate.h"
#include "cli/compare.h"
#include "cli/completion.h"
#include "cli/convert.h"
#include "cli/doctor.h"
#include "cli/index.h"
#include "cli/info.h"
#include "cli/localize.h"
#include "cli/merge.h"
#include "cli/options_command.h"
#include "cli/render.h"
#include "cli/replay.h"
#include "cli/skyline_command.h"
#include "cli/study_command.h"
#include "cli/synth.h"
#include "cli/track.h"
#include "cli/verify.h"
#include "cli/version.h"

namespace ridgeline {
namespace {

using AddFunction = void (*)(CLI::App&, Context&);

// One line per command, in the order of --help.
constexpr AddFunction kCommands[] = {
    AddLocalizeCommand,
    AddBenchCommand,
    AddStudyCommand,
    AddMergeCommand,
    AddCompareCommand,
    AddVerifyCommand,
    AddIndexCommand,
    AddInfoCommand,
    AddConvertCommand,
    AddCalibrateCommand,
    AddRenderCommand,
    AddSkylineCommand,
    AddTrackCommand,
    AddAugmentCommand,
    AddReplayCommand,
    AddSynthCommand,
    AddOptionsCommand,
    AddDoctorCommand,
    AddCompletionCommand,
    AddVersionCommand,
};

}  // namespace

std::unique_ptr<CLI::App> MakeProgram(Context& context) {
  auto app = std::make_unique<CLI::App>("Finds the 6-DoF pose of a photo from a city model alone.",
                                        "ridgeline");
  app->require_subcommand(1);
  app->set_help_all_flag("--help-all", "Help of every command");
  app->set_version_flag("--version", VersionText());
  app->add_flag("-q,--quiet", context.quiet, "Results and errors only");
  app->add_flag("--json", context.json, "Results as JSON on standard output");
  app->add_option("--threads", context.threads, "Threads to use; 0: all")
      ->check(CLI::Range(0, 1024));
  app->footer("ridgeline COMMAND --help shows the options of a command and an example.");
  for (const AddFunction add : kCommands) add(*app, context);
  return app;
}

}  // namespace ridgeline
