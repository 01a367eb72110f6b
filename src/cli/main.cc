// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "cli/commands.h"
#include "cli/interrupt.h"

namespace {

using namespace ridgeline;

constexpr char kNoMemory[] =
    "memory: got too little for inputs of this size, expected smaller ones (a picture, a raster, a "
    "part of the model), fewer --threads, or a larger machine";

bool TakesColors(int descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return ::isatty(descriptor) == 1 && (no_color == nullptr || *no_color == '\0') &&
         term != nullptr && std::string(term) != "dumb";
}

int Fail(const Context& context, const std::string& message, int exit_code) {
  RemoveTemporaries();
  std::cerr << Colored(context.color_err, Color::kRed, "error: ") << message << '\n';
  return exit_code;
}

std::string UnknownCommand(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return "no command \"" + word + "\"; did you mean \"" + NearestName(word, names) + "\"?";
}

// The nearest option of the chosen command and of the program to the first word that is none.
std::string UnknownOption(const CLI::App& app, const CLI::App& command) {
  for (const std::string& word :
       app.remaining(true)) {  // unknown words fall through to the program
    if (word.size() < 2 || word[0] != '-') continue;
    const std::string given = word.substr(0, word.find('='));
    std::vector<std::string> names;
    for (const CLI::App* of : {&command, &app}) {
      for (const CLI::Option* option : of->get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      }
    }
    return "no option \"" + given + "\"; did you mean \"" + NearestName(given, names) + "\"?";
  }
  return "";
}

int Parse(CLI::App& app, int argc, char** argv, const Context& context) {
  try {
    app.parse(argc, argv);
    return kExitOk;
  } catch (const CLI::Success& e) {  // --help, --version
    app.exit(e);
    std::exit(kExitOk);
  } catch (const CLI::ParseError& e) {
    const auto chosen = app.get_subcommands();
    const std::string name = chosen.empty() ? "ridgeline" : "ridgeline " + chosen[0]->get_name();
    std::string message = e.what();
    if (argc == 1) {
      std::cerr << app.help();
      return kExitBadInput;
    }
    if (chosen.empty() && argv[1][0] != '-') message = UnknownCommand(app, argv[1]);
    if (dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr) {
      const std::string unknown = UnknownOption(app, chosen.empty() ? app : *chosen[0]);
      if (!unknown.empty()) message = unknown;
    }
    return Fail(context, message + "\nSee " + name + " --help", kExitBadInput);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Context context;
  context.color_out = TakesColors(STDOUT_FILENO);
  context.color_err = TakesColors(STDERR_FILENO);
  context.terminal_err = ::isatty(STDERR_FILENO) == 1;
  try {
    CleanUpOnInterrupt();
    const auto app = MakeProgram(context);
    const int parsed = Parse(*app, argc, argv, context);
    if (parsed != kExitOk) return parsed;
    cv::setNumThreads(ResolveThreads(context.threads));
    const int exit_code = context.run();
    if (!std::cout.flush())
      return Fail(context, "standard output cannot be written", kExitBadInput);
    return exit_code;
  } catch (const InputError& e) {
    return Fail(context, e.what(), kExitBadInput);
  } catch (const std::filesystem::filesystem_error& e) {
    return Fail(context, e.path1().string() + ": " + e.code().message(), kExitBadInput);
  } catch (const std::bad_alloc&) {
    return Fail(context, kNoMemory, kExitBadInput);
  } catch (const cv::Exception& e) {
    if (e.code == cv::Error::StsNoMem) return Fail(context, kNoMemory, kExitBadInput);
    return Fail(context, "internal error, please report it: " + e.msg, kExitInternal);
  } catch (const std::exception& e) {
    return Fail(
        context, std::string("internal error, please report it: ") + e.what(), kExitInternal);
  }
}
