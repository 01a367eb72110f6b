// SPDX-License-Identifier: Apache-2.0
#include "cli/convert.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "city/crs.h"
#include "cli/command.h"
#include "convert/dataset_formats.h"
#include "convert/doubts.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::vector<std::string> inputs;
  std::string from;
  std::string to;
  std::string out;
  std::string images;
  std::string name;
  std::string crs;
  std::string camera;
  std::string dtm;
  std::vector<std::string> model;
  std::vector<double> origin;
};

ConvertOptions OptionsOf(const ConvertArguments& arguments) {
  ConvertOptions options;
  if (!arguments.crs.empty() && !ParseCrs(arguments.crs)) {
    throw InputError(
        "--crs", "", "\"" + arguments.crs + "\"", "a reference system such as EPSG:25832");
  }
  options.crs = arguments.crs;
  if (!arguments.origin.empty()) {
    options.origin = Eigen::Vector3d(arguments.origin[0], arguments.origin[1], arguments.origin[2]);
  }
  if (!arguments.camera.empty()) options.camera = ReadCamera(arguments.camera);
  return options;
}

// What a dataset needs and the source may not have.
void CompleteDataset(const ConvertArguments& arguments, bool is_dataset, Dataset& dataset) {
  if (!arguments.name.empty()) dataset.name = arguments.name;
  if (!arguments.model.empty()) {
    dataset.model.assign(arguments.model.begin(), arguments.model.end());
  }
  if (!arguments.dtm.empty()) dataset.dtm = arguments.dtm;
  if (dataset.model.empty()) {
    throw InputError("--model", "", "nothing", "the city model that the dataset is about");
  }
  // Pictures lie beside the file that names them, unless the user knows better.
  if (is_dataset) return;
  const fs::path source = dataset.file;
  const fs::path beside = fs::is_directory(source) ? source : source.parent_path();
  const fs::path folder = arguments.images.empty() ? beside : fs::path(arguments.images);
  for (Query& query : dataset.queries) query.image = folder / query.image;
}

// A camera for pictures without one, where all have theirs.
void RefuseIdleCamera(const std::optional<CameraIntrinsics>& camera, const Dataset& dataset) {
  if (!camera) return;
  for (const Query& query : dataset.queries) {
    const bool is_it = query.camera && query.camera->model == camera->model &&
                       query.camera->params == camera->params;
    if (is_it) return;
  }
  throw InputError("--camera", "", "pictures that all have their cameras", "no camera");
}

// Options of a dataset, where none is written; and a folder of pictures that is known already.
void RefuseIdle(const ConvertArguments& arguments, const std::string& from, const std::string& to) {
  const auto is_one_of = [](const std::string& name, std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool takes_origin = is_one_of(from, {"colmap", "opk", "results", "visloc"}) ||
                            to == "colmap" || arguments.inputs.size() > 1;
  if (!arguments.origin.empty() && !takes_origin) {
    throw InputError("--origin", "", "formats of whole coordinates", "no origin");
  }
  if (from == "dataset" && !arguments.images.empty()) {
    throw InputError("--images", "", "a folder beside a dataset", "the dataset's own pictures");
  }
  if (to == "dataset") return;
  const std::pair<bool, const char*> given[] = {{!arguments.name.empty(), "--name"},
                                                {!arguments.model.empty(), "--model"},
                                                {!arguments.dtm.empty(), "--dtm"},
                                                {!arguments.images.empty(), "--images"}};
  for (const auto& [is_given, option] : given) {
    if (is_given) throw InputError(option, "", "an output of format " + to, "a dataset (.json)");
  }
}

void WarnOfDoubts(const Dataset& dataset, const ConvertOptions& options, const Context& context) {
  const Eigen::Vector3d origin = options.origin.value_or(Eigen::Vector3d::Zero());
  for (const std::string& doubt : DoubtsOf(dataset, origin)) {
    context.Warn(dataset.file.string() + ": " + doubt);
  }
}

int RunConvert(const ConvertArguments& arguments, const Context& context) {
  const ConvertOptions options = OptionsOf(arguments);
  const std::string to = arguments.to.empty() ? FormatOfOutput(arguments.out) : arguments.to;
  const std::string from =
      arguments.from.empty() ? FormatOfInput(arguments.inputs.front()) : arguments.from;
  Dataset dataset = ReadInput(arguments.inputs.front(), from, options);
  for (std::size_t i = 1; i < arguments.inputs.size(); ++i) {
    const std::string format = FormatOfInput(arguments.inputs[i]);
    Merge(ReadInput(arguments.inputs[i], format, options), format == "results", dataset);
  }
  if (from != "dataset") WarnOfDoubts(dataset, options, context);
  RefuseIdle(arguments, from, to);
  RefuseIdleCamera(options.camera, dataset);
  if (to == "dataset") {
    CompleteDataset(arguments, from == "dataset", dataset);
  } else if (from == "dataset") {
    // Other programs know pictures by their path from the dataset's folder.
    const fs::path folder = fs::absolute(dataset.file).lexically_normal().parent_path();
    for (Query& query : dataset.queries) {
      query.image = fs::absolute(query.image).lexically_normal().lexically_relative(folder);
    }
  }
  const std::size_t count = WriteOutput(dataset, to, options, arguments.out);
  if (context.json) {
    const nlohmann::ordered_json json = {
        {"from", from}, {"to", to}, {"out", arguments.out}, {"pictures", count}};
    context.Print(json.dump(2));
  } else {
    context.Print(arguments.out + ": " + std::to_string(count) + " pictures, from " + from +
                  " to " + to);
    if (count < dataset.queries.size()) {
      context.Note(std::to_string(dataset.queries.size() - count) +
                   " pictures without a pose left out");
    }
  }
  return kExitOk;
}

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

void AddConvertCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"convert",
       "Turns poses and cameras of other programs into a dataset, and results into their formats.",
       "ridgeline convert town/dataset.json --to colmap --out colmap\n"
       "ridgeline convert colmap --model town/city.gml --dtm town/dtm.tif \\\n"
       "    --images town/images --out again.json\n"
       "ridgeline convert town/dataset.json results/results.csv --out results.kml"},
      [arguments](Context& c) { return RunConvert(*arguments, c); });
  command
      ->add_option("inputs",
                   arguments->inputs,
                   "File or folder to read; further ones add cameras and poses by picture name")
      ->required();
  command->add_option("--out", arguments->out, "File or folder to write")->required();
  command
      ->add_option(
          "--from", arguments->from, "Format of the first input: " + Joined(InputFormats()))
      ->type_name("FORMAT");
  command->add_option("--to", arguments->to, "Format to write: " + Joined(OutputFormats()))
      ->type_name("FORMAT");
  command->add_option("--crs", arguments->crs, "Projected system of the poses, e.g. EPSG:25832");
  command
      ->add_option("--origin",
                   arguments->origin,
                   "East, north, height that the other program's positions are relative to")
      ->expected(3)
      ->delimiter(',')
      ->type_name("E,N,H");
  command->add_option("--camera", arguments->camera, "Camera file, for formats without cameras");
  command->add_option("--images", arguments->images, "Folder of the pictures");
  command->add_option("--model", arguments->model, "City model of the dataset: files or folders");
  command->add_option("--dtm", arguments->dtm, "Terrain model of the dataset");
  command->add_option("--name", arguments->name, "Name of the dataset");
}

}  // namespace ridgeline
