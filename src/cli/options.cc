// SPDX-License-Identifier: Apache-2.0
#include "cli/options.h"

#include <memory>

#include "cli/command.h"
#include "localize/localizer_options.h"

namespace ridgeline {
namespace {

int RunOptions(const ConfigArguments& arguments, const Context& context) {
  LocalizerOptions options;
  const VisitOptions visit = [&](OptionVisitor& v) { options.Visit(v); };
  ApplyConfig(arguments, visit);
  options.Validate();
  std::string json = OptionsToJson(visit);
  json.pop_back();  // Print ends the line itself
  context.Print(json);
  return kExitOk;
}

}  // namespace

void AddOptionsCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<ConfigArguments>();
  CLI::App* command = AddCommand(app,
                                 context,
                                 {"options",
                                  "All keys of --set with their values, as a configuration file.",
                                  "ridgeline options > mine.json\n"
                                  "ridgeline options --config paper"},
                                 [arguments](Context& c) { return RunOptions(*arguments, c); });
  AddConfigOptions(*command, *arguments);
}

}  // namespace ridgeline
