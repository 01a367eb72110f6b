// SPDX-License-Identifier: Apache-2.0
#include "cli/index.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "city/store/city_store.h"
#include "cli/command.h"
#include "cli/progress.h"

namespace ridgeline {
namespace {

struct IndexArguments {
  std::vector<std::string> tiles;
  std::string out;
  CityOptions city;
};

int RunIndex(const IndexArguments& arguments, const Context& context) {
  CityOptions options = arguments.city;
  options.threads = context.threads;
  const std::vector<std::filesystem::path> tiles(arguments.tiles.begin(), arguments.tiles.end());
  std::optional<Progress> progress;
  const CityStoreResult result =
      WriteCityStore(tiles, arguments.out, options, [&](std::size_t done, std::size_t total) {
        if (!progress) progress.emplace(context, "Indexing", total, "tiles");
        progress->Set(done);
      });
  progress.reset();
  for (const std::string& warning : result.warnings) context.Warn(warning);
  if (context.json) {
    const nlohmann::ordered_json json = {{"store", arguments.out},
                                         {"buildings_and_parts", result.buildings},
                                         {"tiles", result.tiles},
                                         {"tiles_of_an_earlier_run", result.tiles_before},
                                         {"warnings", result.warnings}};
    context.Print(json.dump(2));
    return kExitOk;
  }
  std::string line = arguments.out + ": " + std::to_string(result.buildings) +
                     " buildings and parts of " +
                     std::to_string(result.tiles + result.tiles_before) + " tiles";
  if (result.tiles_before > 0) {
    line += " (" + std::to_string(result.tiles_before) + " of an earlier run)";
  }
  context.Print(line);
  return kExitOk;
}

}  // namespace

void AddIndexCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<IndexArguments>();
  CLI::App* command = AddCommand(app,
                                 context,
                                 {"index",
                                  "Puts the tiles of a city into one file that is quick to search.",
                                  "ridgeline index town/city.gml --out city.gpkg"},
                                 [arguments](Context& c) { return RunIndex(*arguments, c); });
  command->add_option("tiles", arguments->tiles, "Model files, or folders of them")->required();
  command->add_option("--out", arguments->out, "GeoPackage to write (city.gpkg)")->required();
  command->add_option("--model-crs", arguments->city.model_crs, "Overrides the tiles' CRS");
  command->add_option("--project-to", arguments->city.project_to, "Projected CRS of the store");
  command->add_option("--height-offset", arguments->city.height_offset_m, "Added to heights [m]");
  command->add_option("--lod", arguments->city.lod, "Level of detail wanted")
      ->check(CLI::Range(1, 4));
}

}  // namespace ridgeline
