// SPDX-License-Identifier: Apache-2.0
#include "cli/options_command.h"

#include <memory>

#include "cli/command.h"
#include "localize/localizer_options.h"

namespace ridgeline {
namespace {

struct OptionsArguments {
  ConfigArguments config;
  bool ranges = false;
};

int RunOptions(const OptionsArguments& arguments, const Context& context) {
  LocalizerOptions options;
  const VisitOptions visit = [&](OptionVisitor& v) { options.Visit(v); };
  ApplyConfig(arguments.config, visit);
  options.Validate();
  std::string text = arguments.ranges ? OptionsWithRanges(visit) : OptionsToJson(visit);
  text.pop_back();  // Print ends the line itself
  context.Print(text);
  return kExitOk;
}

}  // namespace

void AddOptionsCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<OptionsArguments>();
  CLI::App* command = AddCommand(app,
                                 context,
                                 {"options",
                                  "All keys of --set with their values, as a configuration file.",
                                  "ridgeline options > mine.json\n"
                                  "ridgeline options --ranges\n"
                                  "ridgeline options --config paper"},
                                 [arguments](Context& c) { return RunOptions(*arguments, c); });
  AddConfigOptions(*command, arguments->config);
  command->add_flag("--ranges", arguments->ranges, "A line per key: its value, what it may be.");
}

}  // namespace ridgeline
