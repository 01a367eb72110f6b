// SPDX-License-Identifier: Apache-2.0
#include "cli/synth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/command.h"
#include "cli/progress.h"
#include "cli/shell_command.h"
#include "convert/egeniouss.h"
#include "input/dataset.h"
#include "synth/town_dataset.h"
#include "synth/walk.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// Buildings of a block, parts counted with their building; a mean over many blocks.
constexpr double kBuildingsPerBlock = 12.0;

struct SynthArguments {
  std::string out;
  std::string size;
  std::optional<int> buildings;
  bool overwrite = false;
  std::vector<std::string> set;
  std::string layout;
  TownDatasetOptions options;
  int walk_frames = 0;
  int drive_frames = 0;
  int flight_frames = 0;

  int Frames() const { return walk_frames + drive_frames + flight_frames; }
  WalkOptions Walk() const {
    return drive_frames > 0 ? DriveDefaults() : flight_frames > 0 ? FlightDefaults() : WalkOptions();
  }
};

void ParseSize(const std::string& size, int& width, int& height) {
  char rest = '\0';
  if (std::sscanf(size.c_str(), "%dx%d%c", &width, &height, &rest) != 2) {
    throw InputError("--size", "", "\"" + size + "\"", "WIDTHxHEIGHT in pixels, e.g. 1280x960");
  }
}

void CheckTarget(const fs::path& out, bool overwrite) {
  std::error_code error;
  if (!fs::exists(out, error) || overwrite) return;
  throw InputError(
      "--out", "", out.string() + ", which exists", "a new folder, or --overwrite to replace it");
}

// Moves the finished folder to its place.
void Commit(const fs::path& temporary, const fs::path& out) {
  if (fs::exists(out)) {
    const fs::path old = TemporaryBeside(out);
    fs::rename(out, old);
    CommitFile(temporary, out);
    fs::remove_all(old);
    return;
  }
  CommitFile(temporary, out);
}

// A walk has frames in place of a town's pictures.
void RefuseTownPictures(const TownDatasetOptions& options) {
  const TownDatasetOptions defaults;
  const auto refuse = [](const char* option) {
    throw InputError(option, "", "pictures of a town beside those of a film", "one of the two");
  };
  if (options.street != defaults.street) refuse("--queries");
  if (options.tilted != defaults.tilted) refuse("--tilted");
  if (options.portrait != defaults.portrait) refuse("--portrait");
  if (options.drone != defaults.drone) refuse("--drone");
}

constexpr const char* kEgeniouss = "egenioussbench";

// Upright pictures of one phone, as that benchmark has them.
void ChooseEgeniouss(TownDatasetOptions& options) {
  options.portrait = options.street;
  options.street = options.tilted = options.drone = 0;
  options.one_camera = true;
}

// Puts the dataset of a finished folder into the benchmark's layout, in a folder in its place.
fs::path InEgenioussLayout(const fs::path& town, int seed, const fs::path& out) {
  const fs::path folder = TemporaryBeside(out);
  fs::create_directory(folder);
  WriteEgenioussFolder(
      ReadDataset(town / "dataset.json"), static_cast<std::uint64_t>(seed), folder);
  fs::remove_all(town);
  return folder;
}

// Both give the size of the town.
void RefuseBlocksBesideBuildings(const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) {
    if (!assignment.starts_with("town.blocks_")) continue;
    throw InputError(
        "--buildings", "", "a size of the town beside --set " + assignment, "one of the two");
  }
}

// What to try with what was made; empty: nothing.
std::string NextCommand(const SynthArguments& arguments, bool has_pictures) {
  const fs::path out = arguments.out;
  const std::string dataset = (out / "dataset.json").string();
  if (!arguments.layout.empty()) {
    return ShellCommand("ridgeline convert").Word(out.string()).Option("--out", "DATASET.json").text();
  }
  ShellCommand command("ridgeline bench");
  if (arguments.walk_frames > 0) {
    command = ShellCommand("ridgeline skyline")
                  .Option("--dataset", dataset)
                  .Option("--sensors", (out / "sensors.csv").string());
  } else if (arguments.Frames() > 0) {
    command = ShellCommand("ridgeline track")
                  .Word(dataset)
                  .Option("--odometry", (out / "odometry.csv").string());
  } else if (has_pictures) {
    command.Word(dataset);
  } else {
    return "";
  }
  return command.Option("--out", "DIR").text();
}

int RunSynth(SynthArguments& arguments, const Context& context) {
  TownDatasetOptions& options = arguments.options;
  WalkOptions walk = arguments.Walk();
  const bool is_walk = arguments.Frames() > 0;
  if (is_walk) RefuseTownPictures(options);
  if (!arguments.size.empty()) {
    ParseSize(arguments.size,
              is_walk ? walk.width : options.width,
              is_walk ? walk.height : options.height);
  }
  if (arguments.buildings) {
    RefuseBlocksBesideBuildings(arguments.set);
    const int side =
        static_cast<int>(std::ceil(std::sqrt(*arguments.buildings / kBuildingsPerBlock)));
    options.town.blocks_east = options.town.blocks_north = std::max(1, side);
  }
  const bool is_egeniouss = !arguments.layout.empty();
  if (is_egeniouss) ChooseEgeniouss(options);
  walk.town = options.town;
  walk.frames = arguments.Frames();
  for (const std::string& assignment : arguments.set) {
    SetOption(assignment, [&](OptionVisitor& v) { is_walk ? walk.Visit(v) : options.Visit(v); });
  }
  is_walk ? CheckOptions(walk) : CheckOptions(options);
  fs::path out = fs::absolute(arguments.out).lexically_normal();
  if (!out.has_filename()) out = out.parent_path();
  CheckTarget(out, arguments.overwrite);

  fs::path temporary = TemporaryBeside(out);
  fs::create_directory(temporary);
  std::unique_ptr<Progress> progress;
  const auto show = [&](std::size_t done, std::size_t total) {
    if (!progress) progress = std::make_unique<Progress>(context, "Building", total, "files");
    progress->Set(done);
  };
  const TownDatasetSummary summary =
      is_walk ? WriteWalkDataset(walk, temporary, context.threads, show)
              : WriteTownDataset(options, temporary, context.threads, show);
  progress.reset();
  if (is_egeniouss) temporary = InEgenioussLayout(temporary, options.town.seed, out);
  Commit(temporary, out);

  if (context.json) {
    context.Print(nlohmann::ordered_json{{"folder", arguments.out},
                                         {"buildings", summary.buildings},
                                         {"model_files", summary.model_files},
                                         {"pictures", summary.pictures}}
                      .dump(2));
    return kExitOk;
  }
  context.Print("Town of " + std::to_string(summary.buildings) + " buildings and parts, " +
                std::to_string(summary.pictures) + " pictures, in " + arguments.out);
  const std::string next = NextCommand(arguments, summary.pictures > 0);
  if (!next.empty()) context.Print("Next: " + next);
  return kExitOk;
}

}  // namespace

void AddSynthCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<SynthArguments>();
  CLI::App* command = AddCommand(app,
                                 context,
                                 {"synth",
                                  "Invents a town: CityGML, DTM and pictures with exact poses.",
                                  "ridgeline synth --out town --queries 20\n"
                                  "ridgeline synth --out big --buildings 100000 --queries 0\n"
                                  "ridgeline synth --out walk --walk 60\n"
                                  "ridgeline synth --out drive --drive 60 --set "
                                  "gnss.spoof_from_s=10"},
                                 [arguments](Context& c) { return RunSynth(*arguments, c); });
  TownDatasetOptions& options = arguments->options;
  command->add_option("--out", arguments->out, "Folder to make")->required()->type_name("DIR");
  command->add_option("--seed", options.town.seed, "Another seed, another town")
      ->capture_default_str();
  command->add_option("--queries", options.street, "Street pictures")->capture_default_str();
  command->add_option("--tilted", options.tilted, "Pictures looking up")->capture_default_str();
  command->add_option("--portrait", options.portrait, "Upright pictures")->capture_default_str();
  command->add_option("--drone", options.drone, "Pictures from a drone")->capture_default_str();
  command->add_option("--walk", arguments->walk_frames, "Instead: frames of a hand-held walk")
      ->type_name("FRAMES");
  command->add_option("--drive", arguments->drive_frames, "Instead: frames of a car's camera")
      ->excludes("--walk")
      ->type_name("FRAMES");
  command->add_option("--flight", arguments->flight_frames, "Instead: frames of a drone's camera")
      ->excludes("--walk")
      ->excludes("--drive")
      ->type_name("FRAMES");
  command
      ->add_option("--layout", arguments->layout, "Upright pictures in another benchmark's folders")
      ->check(CLI::IsMember(std::vector<std::string>{kEgeniouss}))
      ->excludes("--walk")
      ->excludes("--drive")
      ->excludes("--flight")
      ->type_name("NAME");
  command->add_option("--size", arguments->size, "Size of the pictures [1280x960; walk 640x480, drive 1280x720]")
      ->type_name("WxH");
  command->add_option(
      "--buildings", arguments->buildings, "About so many buildings, in tiles if many");
  command->add_option("--set", arguments->set, "Any other option, e.g. --set survey_sigma_m=0.2")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--overwrite", arguments->overwrite, "Replace the folder if it exists");
}

}  // namespace ridgeline
