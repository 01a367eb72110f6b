// SPDX-License-Identifier: Apache-2.0
#include "cli/augment.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "augment/impact.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/augment_parts.h"
#include "cli/command.h"
#include "cli/out_folder.h"
#include "report/picture_file.h"

namespace ridgeline {
namespace {

// Options of the other kind of output.
void CheckKind(const AugmentArguments& a) {
  const auto refuse = [](const char* option, const char* found, const char* expected) {
    throw InputError(option, "", found, expected);
  };
  if (a.out.empty() == a.film.empty()) {
    refuse("--out", a.out.empty() ? "nothing" : "a picture beside --film", "--out or --film");
  }
  if (a.film.empty()) {
    if (!a.poses.empty()) refuse("--poses", "poses of frames", "--film FILE with them");
    if (!a.frames.empty()) refuse("--frames", "frames", "--film FILE with them");
    if (!a.sensors.empty()) refuse("--sensors", "instruments of frames", "--film FILE with them");
    if (!a.stability.empty()) refuse("--stability", "figures of a film", "--film FILE with them");
    if (!a.set.empty()) refuse("--set", "options of instruments", "--film FILE with --sensors");
    return;
  }
  if (!a.view.query.query.empty()) refuse("--query", "one picture", "all frames of a film");
  if (!a.view.query.image.empty()) refuse("--image", "one picture", "--frames for a film");
  if (!a.view.pose.empty()) refuse("--pose", "one pose", "--poses for a film");
  if (!a.impact.empty()) refuse("--impact", "the outline of one picture", "--out with it");
}

int RunPicture(const AugmentArguments& arguments, const Context& context) {
  const std::unique_ptr<ViewInput> view = ReadView(arguments.view, context.threads);
  for (const Assumption& assumption : view->assumptions) context.Note(TextOf(assumption));
  for (const std::string& warning : view->warnings) context.Warn(warning);
  if (view->photo.empty()) throw InputError("--image", "", "nothing", "the photo to draw into");
  const TexturedMesh mesh = ReadInsertedBuilding(
      arguments, view->model, view->dtm ? &*view->dtm : nullptr, context);
  InsertionOptions options = arguments.insert;
  options.threads = context.threads;
  options.towards_sun = LightOf(arguments, view->model, mesh, context);
  const cv::Mat foreground = ForegroundOf(arguments,
                                          arguments.view.query.query,
                                          view->photo,
                                          *view->scene,
                                          view->camera,
                                          view->cam_from_local);
  const Insertion result = Inserter(*view->scene, mesh).Insert(
      view->photo, view->camera, view->cam_from_local, options, foreground);
  WritePicture(result.picture, arguments.out);
  const SkyImpact impact =
      ImpactOf(*view->scene, view->camera, view->cam_from_local, result.coverage);
  if (!arguments.impact.empty()) WriteFileAtomically(arguments.impact, ImpactCsv(impact));
  if (result.visible_share == 0.0) context.Warn("the building is not visible in the picture");
  if (context.json) {
    context.Print(nlohmann::ordered_json{{"picture", arguments.out},
                                         {"visible_share", result.visible_share},
                                         {"hidden_share", result.hidden_share},
                                         {"sky_before", impact.sky_before},
                                         {"sky_lost", impact.sky_lost},
                                         {"raised_columns", impact.raised_columns},
                                         {"mean_rise_px", impact.mean_rise_px},
                                         {"highest_rise_px", impact.highest_rise_px}}
                      .dump(2));
    return kExitOk;
  }
  char line[240];
  std::snprintf(line,
                sizeof line,
                ": the building fills %.1f %% of it; %.0f %% of the building is hidden",
                100.0 * result.visible_share,
                100.0 * result.hidden_share);
  context.Print(arguments.out + line);
  std::snprintf(line,
                sizeof line,
                "skyline: %.1f %% of the sky is lost; raised in %.0f %% of the columns, by %.0f px "
                "in the mean and %.0f px at most",
                100.0 * impact.sky_lost,
                100.0 * impact.raised_columns,
                impact.mean_rise_px,
                impact.highest_rise_px);
  context.Print(line);
  return kExitOk;
}

int RunAugment(const AugmentArguments& arguments, const Context& context) {
  CheckKind(arguments);
  arguments.insert.Validate();
  CheckFileToWrite("--impact", arguments.impact);
  return arguments.film.empty() ? RunPicture(arguments, context)
                                : RunAugmentFilm(arguments, context);
}

void AddBuildingOptions(CLI::App& command, AugmentArguments& arguments) {
  command
      .add_option("--building", arguments.building, "Model of the building (glTF, OBJ, CityGML, ...)")
      ->required()
      ->type_name("PATH");
  command.add_option(
      "--place", arguments.place, "E,N or E,N,H of its base; else its own coordinates");
  command.add_option("--heading", arguments.heading_deg, "Turns it clockwise [deg]");
  command.add_option("--scale", arguments.scale, "Enlarges it");
  command.add_flag("--y-up", arguments.y_up, "An OBJ or other mesh with y upward");
}

void AddLightOptions(CLI::App& command, AugmentArguments& arguments) {
  command.add_option("--light-azimuth", arguments.light_azimuth_deg, "Light from [deg]")
      ->capture_default_str();
  command.add_option("--light-elevation", arguments.light_elevation_deg, "Its height [deg]")
      ->capture_default_str();
  command
      .add_option("--sun", arguments.sun, "Light of the sun at a time, e.g. 2026-06-21T14:30+02:00")
      ->type_name("TIME")
      ->excludes("--light-azimuth")
      ->excludes("--light-elevation");
  command.add_flag("--shadows",
                   arguments.insert.shadows,
                   "Shadows on itself, its neighbours and the terrain (slower)");
  command.add_option("--samples", arguments.insert.samples, "Rays per pixel, across and down")
      ->capture_default_str();
  command.add_option("--opacity", arguments.insert.opacity, "Of the building, (0, 1]")
      ->capture_default_str();
  command.add_option("--reveal", arguments.insert.reveal, "Shows hidden parts, hatched, [0, 1]")
      ->capture_default_str();
  command.add_option("--foreground",
                     arguments.foreground,
                     "Mask of what is in front, folder of them by frame, or auto (approximate)");
}

}  // namespace

void AddAugmentCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<AugmentArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"augment",
       "Draws a planned building into a photo or a film, hidden by what stands before it.",
       "ridgeline augment --dataset town/dataset.json --query street_000 \\\n"
       "    --building town/tower.obj --place 654228,5412066 --shadows --out augmented.jpg\n"
       "ridgeline augment --dataset walk/dataset.json --poses poses/frames.csv \\\n"
       "    --building walk/tower.obj --place 654168,5412050 --film augmented.mp4"},
      [arguments](Context& c) { return RunAugment(*arguments, c); });
  AddViewOptions(*command, arguments->view);
  AddBuildingOptions(*command, *arguments);
  AddLightOptions(*command, *arguments);
  command->add_option("--out", arguments->out, "Picture to write (.jpg, .png)");
  command->add_option("--impact", arguments->impact, "Skyline before and after, by column (CSV)");
  command->add_option("--film", arguments->film, "Film of all frames to write (.mp4)");
  command->add_option("--frames", arguments->frames, "Film or folder of pictures of a film");
  command->add_option("--poses", arguments->poses, "Poses by frame: frames.csv of skyline");
  command->add_option("--sensors", arguments->sensors, "Instruments of a film (CSV)");
  command->add_option("--stability", arguments->stability, "Errors and jitter of a film (CSV)");
  command->add_option("--set", arguments->set, "Options of the instruments, sensors.KEY=VALUE")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace ridgeline
