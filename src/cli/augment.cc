// SPDX-License-Identifier: Apache-2.0
#include "cli/augment.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "city/read_city.h"
#include "cli/command.h"
#include "cli/view_input.h"
#include "report/inserted_building.h"
#include "report/picture_file.h"

namespace ridgeline {
namespace {

struct AugmentArguments {
  ViewArguments view;
  std::vector<std::string> building;
  std::string place;
  double heading_deg = 0.0;
  double scale = 1.0;
  InsertOptions insert;
  std::string out;
};

// East, north and perhaps height of --place.
std::vector<double> ParsePlace(const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(text);
  std::string part;
  while (std::getline(stream, part, ',')) {
    char* end = nullptr;
    values.push_back(std::strtod(part.c_str(), &end));
    if (part.empty() || *end != '\0' || !std::isfinite(values.back())) {
      values.clear();
      break;
    }
  }
  if (values.size() != 2 && values.size() != 3) {
    throw InputError("--place", "", '"' + text + '"', "east,north or east,north,height");
  }
  return values;
}

// The building in the local frame of the view.
CityModel ReadBuilding(const AugmentArguments& arguments, const ViewInput& view) {
  CityOptions options;
  if (view.model.crs.horizontal_epsg != 0) {
    options.project_to = "EPSG:" + std::to_string(view.model.crs.horizontal_epsg);
  }
  const CityModel model = ReadCity({arguments.building.begin(), arguments.building.end()}, options);
  const Eigen::Vector3d& origin = view.model.origin_in_world;
  if (arguments.place.empty()) {
    // It has world coordinates of its own.
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : model.vertices) box.extend(v);
    const Eigen::Vector3d base(box.center().x(), box.center().y(), box.min().z());
    return PlacedModel(
        model, base + model.origin_in_world - origin, arguments.heading_deg, arguments.scale);
  }
  const std::vector<double> place = ParsePlace(arguments.place);
  const Eigen::Vector2d xy = Eigen::Vector2d(place[0], place[1]) - origin.head<2>();
  double height = 0.0;
  if (place.size() == 3) {
    height = place[2] - origin.z();
  } else {
    const auto terrain = view.dtm ? view.dtm->HeightAt(xy) : std::nullopt;
    if (!terrain) {
      throw InputError(
          "--place", "", "no terrain there", "east,north,height, or a DTM that covers it");
    }
    height = *terrain;
  }
  return PlacedModel(model, {xy.x(), xy.y(), height}, arguments.heading_deg, arguments.scale);
}

int RunAugment(const AugmentArguments& arguments, const Context& context) {
  if (!(arguments.scale > 0.0)) {
    throw InputError("--scale", "", std::to_string(arguments.scale), "more than 0");
  }
  if (!(arguments.insert.opacity > 0.0 && arguments.insert.opacity <= 1.0)) {
    throw InputError("--opacity", "", std::to_string(arguments.insert.opacity), "(0, 1]");
  }
  const std::unique_ptr<ViewInput> view = ReadView(arguments.view, context.threads);
  for (const Assumption& assumption : view->assumptions) context.Note(TextOf(assumption));
  for (const std::string& warning : view->warnings) context.Warn(warning);
  if (view->photo.empty()) throw InputError("--image", "", "nothing", "the photo to draw into");
  const CityModel building = ReadBuilding(arguments, *view);
  for (const std::string& warning : building.warnings) context.Warn(warning);
  const Scene scene(building, nullptr, ProjectionOptions{});
  const InsertedPicture result = InsertBuilding(
      view->photo, *view->scene, scene, view->camera, view->cam_from_local, arguments.insert);
  WritePicture(result.picture, arguments.out);
  if (result.visible_share == 0.0) context.Warn("the building is not visible in the picture");
  if (context.json) {
    context.Print(nlohmann::ordered_json{{"picture", arguments.out},
                                         {"visible_share", result.visible_share},
                                         {"hidden_share", result.hidden_share}}
                      .dump(2));
    return kExitOk;
  }
  char line[160];
  std::snprintf(line,
                sizeof line,
                ": the building fills %.1f %% of it; %.0f %% of the building is hidden",
                100.0 * result.visible_share,
                100.0 * result.hidden_share);
  context.Print(arguments.out + line);
  return kExitOk;
}

}  // namespace

void AddAugmentCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<AugmentArguments>();
  CLI::App* command =
      AddCommand(app,
                 context,
                 {"augment",
                  "Draws a planned building into a photo, hidden by what stands before it.",
                  "ridgeline synth --out new --seed 2 --set town.blocks_east=1 \\\n"
                  "    --set town.blocks_north=1 --queries 0 --tilted 0 --portrait 0 --drone 0\n"
                  "ridgeline augment --dataset town/dataset.json --query street_000 \\\n"
                  "    --building new/city.gml --place 654100,5412080 --out augmented.jpg"},
                 [arguments](Context& c) { return RunAugment(*arguments, c); });
  AddViewOptions(*command, arguments->view);
  command
      ->add_option("--building", arguments->building, "Model of the building (OBJ, CityGML, ...)")
      ->required()
      ->type_name("PATH");
  command->add_option(
      "--place", arguments->place, "E,N or E,N,H of its base; else its own coordinates");
  command->add_option("--heading", arguments->heading_deg, "Turns it clockwise [deg]");
  command->add_option("--scale", arguments->scale, "Enlarges it");
  command->add_option("--light-azimuth", arguments->insert.light_azimuth_deg, "Light from [deg]")
      ->capture_default_str();
  command
      ->add_option("--light-elevation", arguments->insert.light_elevation_deg, "Its height [deg]")
      ->capture_default_str();
  command->add_option("--opacity", arguments->insert.opacity, "Of the building, (0, 1]")
      ->capture_default_str();
  command->add_option("--out", arguments->out, "Picture to write (.jpg, .png)")->required();
}

}  // namespace ridgeline
