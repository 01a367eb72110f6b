// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/focal_length.h"
#include "camera/picture_facts.h"
#include "city/city_model.h"
#include "input/dataset.h"
#include "input/prior_pose.h"
#include "input/read_picture.h"

namespace ridgeline {

struct PictureInputOptions {
  // Magnetic declination [deg], east positive. Absent: by the World Magnetic Model.
  std::optional<double> declination_deg;
  // Height of a camera above the ground that it stands on [m].
  double camera_height_m = kCameraHeightM;
};

// What was made of a picture's own words.
struct PictureInput {
  std::optional<CameraIntrinsics> camera;  // absent: the query had one
  std::optional<PosePrior> prior;          // absent: the query had one, or there is no position
  int orientation = 1;                     // by which the picture is to be turned
  // What else `camera`'s focal length may be, its own first (FocalLength); empty without `camera`.
  std::vector<FocalHypothesis> focal_lengths;
  // How far the prior may be off, as half-ranges of a search.
  double horizontal_m = 0.0;
  double height_m = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
  bool magnetic = false;  // the heading was turned by the magnetic declination
  // What was taken from where and what was assumed, one line "what: value" each.
  std::vector<std::string> notes;
};

// Camera and prior that a query lacks, from its picture's EXIF and XMP. Directions are turned from
// true or magnetic north to grid north. Heights: above the ground or above take-off, where the
// picture says it (drones), over the terrain at its place; else the terrain + camera height, since
// a receiver's height is off by tens of metres. An altitude more than 30 m above the terrain, also
// if it was meant above the ellipsoid, or an aircraft's, contradicts that: it is taken with a wide
// range. Without a terrain model the altitude is taken as it is.
//
// @param crs  Projected system of the model.
// Throws InputError for a picture that cannot be read or does not lie in the system's reach.
PictureInput ReadPictureInput(const Query& query,
                              const Crs& crs,
                              const std::optional<std::filesystem::path>& dtm,
                              const PictureInputOptions& options,
                              PictureReader& pictures);

// The prior that a picture's facts give; nullopt without a position. `terrain_m` is the terrain's
// height at the place, if known. Notes and half-ranges are added to `input`.
std::optional<PosePrior> PriorOf(const PictureFacts& facts,
                                 const Crs& crs,
                                 const std::string& file,
                                 const std::optional<double>& terrain_m,
                                 const PictureInputOptions& options,
                                 PictureInput& input);

// Gives a query of the dataset the camera and, with `prior`, the prior that its picture tells,
// where it has none, and notes among its assumptions what was made of the picture, and of what a
// prior of its own leaves open.
//
// @param crs  The model's system; found where it is needed and absent.
PictureInput CompleteFromPicture(const Dataset& dataset,
                                 bool prior,
                                 const PictureInputOptions& options,
                                 PictureReader& pictures,
                                 std::optional<Crs>& crs,
                                 Query& query);

// The same for every query of a dataset. Returns the number of queries whose picture was asked.
std::size_t CompleteFromPictures(Dataset& dataset, bool priors, const PictureInputOptions& options);

}  // namespace ridgeline
