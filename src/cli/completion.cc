// SPDX-License-Identifier: Apache-2.0
#include "cli/completion.h"

#include <filesystem>
#include <memory>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/command.h"
#include "cli/shell_text.h"

namespace ridgeline {
namespace {

struct CompletionArguments {
  std::string what = "bash";
  std::string out;  // of man pages; "": here
};

int RunCompletion(const CompletionArguments& arguments,
                  const CLI::App& app,
                  const Context& context) {
  if (arguments.what != "man" && !arguments.out.empty()) {
    throw InputError("--out", "", "a folder for " + arguments.what, "man, or > FILE");
  }
  if (arguments.what == "bash") {
    context.Print(BashCompletion(app));
    return kExitOk;
  }
  if (arguments.what == "zsh") {
    context.Print(ZshCompletion(app));
    return kExitOk;
  }
  const std::filesystem::path folder = arguments.out.empty() ? "." : arguments.out;
  WriteFileAtomically(folder / "ridgeline.1", ProgramManual(app));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    WriteFileAtomically(folder / ("ridgeline-" + command->get_name() + ".1"),
                        CommandManual(app, *command));
  }
  return kExitOk;
}

}  // namespace

void AddCompletionCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<CompletionArguments>();
  CLI::App* command =
      AddCommand(app,
                 context,
                 {"completion",
                  "Prints shell completion, or writes man pages.",
                  "eval \"$(ridgeline completion bash)\"  # in ~/.bashrc\n"
                  "mkdir -p man1 && ridgeline completion man --out man1"},
                 [arguments, &app](Context& c) { return RunCompletion(*arguments, app, c); });
  command->add_option("what", arguments->what, "bash, zsh or man")
      ->check(CLI::IsMember({"bash", "zsh", "man"}))
      ->required();
  command->add_option("--out", arguments->out, "Folder for the man pages [.]")->type_name("DIR");
}

}  // namespace ridgeline
