// SPDX-License-Identifier: Apache-2.0
#include "cli/command.h"

#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// The file a --config value stands for.
fs::path ResolveConfig(const std::string& config) {
  std::error_code error;
  if (fs::exists(config, error) || config.find('/') != std::string::npos) return config;
  const fs::path shipped = ShippedConfigs();
  const fs::path named = shipped / (config + ".json");
  if (!shipped.empty() && fs::exists(named, error)) return named;
  std::vector<std::string> names;
  if (!shipped.empty()) {
    for (const auto& entry : fs::directory_iterator(shipped, error)) {
      if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
  }
  const std::string nearest = NearestName(config, names);
  throw InputError(
      "--config",
      "",
      "\"" + config + "\"",
      nearest.empty() ? "an existing file" : "an existing file, or a shipped one, e.g. \"" + nearest + "\"");
}

}  // namespace

CLI::App* AddCommand(CLI::App& app,
                     Context& context,
                     const CommandText& text,
                     std::function<int(Context&)> run) {
  CLI::App* command = app.add_subcommand(text.name, text.description);
  command->footer("Example:\n  " + CLI::detail::find_and_replace(text.example, "\n", "\n  "));
  command->fallthrough();
  command->callback(
      [&context, run = std::move(run)] { context.run = [&context, run] { return run(context); }; });
  return command;
}

void AddConfigOptions(CLI::App& command, ConfigArguments& arguments) {
  command.add_option(
      "--config", arguments.config, "JSON file, or the name of a shipped one, e.g. paper");
  command
      .add_option(
          "--set", arguments.set, "Override one key, e.g. --set search.east_m=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void ApplyConfig(const ConfigArguments& arguments, const VisitOptions& options) {
  if (!arguments.config.empty()) {
    const fs::path file = ResolveConfig(arguments.config);
    OptionsFromJson(ReadFile(file), file.string(), options);
  }
  for (const std::string& assignment : arguments.set) SetOption(assignment, options);
}

fs::path ShippedConfigs() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (fs::path folder = program.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    for (const fs::path& configs : {folder / "share/ridgeline/configs", folder / "configs"}) {
      if (fs::exists(configs / "paper.json", error)) return configs;
    }
  }
  return {};
}

}  // namespace ridgeline
