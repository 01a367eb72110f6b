// SPDX-License-Identifier: Apache-2.0
// Finds the pose of one photo with the library.
//
//   localize_photo DATASET QUERY        e.g. localize_photo town/dataset.json street_000
//
// A dataset (docs/dataset.md) names a city model, a terrain raster, and photos with their cameras
// and with what is known of their poses: the priors. `ridgeline synth` invents one to try this on.
#include <cstdio>
#include <exception>

#include "input/dataset.h"
#include "input/read_picture.h"
#include "input/world.h"
#include "localize/localizer.h"

namespace {

int Run(const char* dataset_file, const char* query_id) {
  // What is read from files is checked here: an InputError says which file, which field, what was
  // found, and what was expected.
  //
  // A Localizer stands for one world. Its constructor does the costly work, once: edges, their
  // neighbours, a hierarchy of boxes for rays. It keeps a reference to the model, so the world has
  // to live longer. After that any number of photos may be localized, from several threads at a
  // time.
  //
  // The world is read as far as it can be seen from the priors, widened by the search's reach.
  //
  // [README
  const ridgeline::Dataset dataset = ridgeline::ReadDataset(dataset_file);
  const ridgeline::Query& query =
      dataset.queries.at(ridgeline::FindQuery(dataset, query_id, "QUERY"));

  ridgeline::LocalizerOptions options;  // the defaults; each field says what it means
  options.search.space.east_m = options.search.space.north_m = 15.0;
  const ridgeline::World world = ridgeline::ReadWorld(dataset, 15.0);
  const ridgeline::Localizer localizer(world.model, world.dtm, options);

  ridgeline::LocalizationInput input;
  input.picture = ridgeline::ReadPicture(query);
  input.camera = query.camera.value();
  input.prior = query.prior.value();
  const ridgeline::Localization found = localizer.Localize(input, /*seed=*/1, /*threads=*/0);

  if (!found.pose) return std::printf("abstained: %s\n", found.reason.c_str()), 3;
  const Eigen::Vector3d& p = found.pose->center_in_world;
  std::printf("%.2f %.2f %.2f, confidence %.2f\n", p.x(), p.y(), p.z(), found.confidence);
  // README]

  // The pose is that of the optical axis, too: heading clockwise from grid north, pitch up
  // positive, roll clockwise positive.
  const ridgeline::ViewAngles view = ridgeline::ViewAnglesOf(found.pose->cam_from_world);
  std::printf(
      "heading %.2f, pitch %.2f, roll %.2f deg\n", view.heading_deg, view.pitch_deg, view.roll_deg);

  // A pose that comes with doubts is still a pose; the doubts are sentences for people.
  for (const std::string& doubt : found.doubts) std::printf("doubt: %s\n", doubt.c_str());

  // In an invented town the truth is known. Nothing above has seen it.
  if (!query.truth) return 0;
  const double error_m = (p - query.truth->center_in_world).norm();
  const double error_deg =
      ridgeline::RotationDistanceDeg(found.pose->cam_from_world, query.truth->cam_from_world);
  std::printf("off by %.2f m, %.2f deg\n", error_m, error_deg);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "localize_photo DATASET QUERY\n"), 2;
  try {
    return Run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
