// SPDX-License-Identifier: Apache-2.0
#include "input/picture_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/format_text.h"
#include "camera/magnetic_declination.h"
#include "camera/picture_camera.h"
#include "city/crs.h"
#include "city/read_city.h"
#include "city/terrain.h"
#include "input/prior_pose.h"

namespace ridgeline {
namespace {

// A receiver in a street is this far off [m]; a picture that says how far counts twice that.
constexpr double kReceiverErrorM = 10.0;
constexpr double kMostErrorM = 40.0;
// A barometer's drift, and take-off elsewhere than at the height of the terrain below [m].
constexpr double kTakeoffErrorM = 10.0;
constexpr double kAltitudeErrorM = 15.0;
// A receiver's altitude among houses.
constexpr double kReceiverHeightErrorM = 30.0;
// How level a picture by hand is [deg], and how far a gimbal's angles are off.
constexpr double kHandPitchDeg = 10.0;
constexpr double kHandRollDeg = 4.0;
constexpr double kGimbalErrorDeg = 3.0;
// The model's epoch, where a picture has no date.
constexpr double kUnknownYear = 2025.0;

// From grid north, with words on how it came about.
double GridHeading(const PictureFacts& facts,
                   const Crs& crs,
                   const Eigen::Vector2d& place,
                   const PictureInputOptions& options,
                   std::string& words) {
  const PictureFacts::Direction& direction = *facts.direction;
  double declination = 0.0;
  words = FormatText("%.1f deg from %s north (%s)",
                     direction.heading_deg,
                     direction.magnetic ? "magnetic" : "true",
                     direction.source.c_str());
  if (direction.magnetic) {
    if (options.declination_deg) {
      declination = *options.declination_deg;
      words += FormatText(", declination %.1f as given", declination);
    } else {
      declination = MagneticDeclinationDeg(
          facts.place->latitude_deg, facts.place->longitude_deg, facts.year.value_or(kUnknownYear));
      words += FormatText(", declination %.1f by the World Magnetic Model%s",
                          declination,
                          facts.year ? "" : " for 2025, the date being unknown");
    }
  }
  const double convergence = MeridianConvergenceDeg(crs, place).value_or(0.0);
  const double heading = WrapHeadingDeg(direction.heading_deg + declination - convergence);
  words +=
      FormatText(", meridian convergence %.2f: %.1f deg from grid north", convergence, heading);
  return heading;
}

// The picture's altitude as a height of the model, above sea level or above the ellipsoid; what was
// done to it is noted.
std::optional<double> AltitudeInModel(const PictureFacts& facts,
                                      const Crs& crs,
                                      const std::optional<double>& undulation_m,
                                      PictureInput& input) {
  if (!facts.altitude_m) return std::nullopt;
  const bool model_above_ellipsoid = HasEllipsoidalHeights(crs);
  if (facts.altitude_above_ellipsoid == model_above_ellipsoid) return facts.altitude_m;
  if (!undulation_m) {
    input.notes.push_back(
        "altitude: above the ellipsoid, taken as above sea level, since there is no geoid grid");
    return facts.altitude_m;
  }
  const double altitude_m =
      *facts.altitude_m + (model_above_ellipsoid ? *undulation_m : -*undulation_m);
  input.notes.push_back(FormatText("altitude: %.1f m above %s = %.1f m above %s (EGM96: %.1f m)",
                                   *facts.altitude_m,
                                   model_above_ellipsoid ? "sea level" : "the ellipsoid",
                                   altitude_m,
                                   model_above_ellipsoid ? "the ellipsoid" : "sea level",
                                   *undulation_m));
  return altitude_m;
}

// Why an altitude [m] agrees with somebody who stands on the terrain; empty if it does not. Some
// receivers write heights above the ellipsoid and call them above sea level.
std::string OnGround(double altitude_m,
                     double terrain_m,
                     const std::optional<double>& undulation_m) {
  const double above = altitude_m - terrain_m;
  if (std::abs(above) <= kReceiverHeightErrorM) {
    return "; the altitude of the receiver is too rough to be used";
  }
  if (undulation_m && std::abs(above - *undulation_m) <= kReceiverHeightErrorM) {
    return FormatText(
        "; the altitude %.1f m was meant above the ellipsoid, as it seems (%.1f m above "
        "sea level), and is too rough to be used",
        altitude_m,
        altitude_m - *undulation_m);
  }
  if (above < 0.0) {
    return FormatText(
        "; the altitude %.1f m is not used, being %.0f m below the terrain", altitude_m, -above);
  }
  return "";
}

// An altitude that nobody on the ground has, or that an aircraft tells.
void SetHeightInTheAir(double altitude_m,
                       double terrain_m,
                       const std::optional<double>& undulation_m,
                       bool from_aircraft,
                       PosePrior& prior,
                       PictureInput& input) {
  // Both meanings of the altitude lie in the range.
  input.height_m =
      std::max(kReceiverHeightErrorM, std::abs(undulation_m.value_or(0.0)) + kTakeoffErrorM);
  const double above = altitude_m - terrain_m;
  if (above <= 0.0) {
    prior.height_in_world = terrain_m + input.height_m;
    input.notes.push_back(FormatText(
        "height: up to %.0f m above the terrain, since the picture is an aircraft's; its altitude "
        "%.1f m is not used, being %.0f m below the terrain",
        2.0 * input.height_m,
        altitude_m,
        -above));
    return;
  }
  prior.height_in_world = altitude_m;
  input.notes.push_back(
      FormatText("height: %.1f m, the picture's altitude, +- %.0f m: %s %.0f m above the terrain",
                 altitude_m,
                 input.height_m,
                 from_aircraft ? "an aircraft's picture," : "it seems to be taken from the air,",
                 above));
}

void SetHeight(const PictureFacts& facts,
               const Crs& crs,
               const std::optional<double>& terrain_m,
               const PictureInputOptions& options,
               PosePrior& prior,
               PictureInput& input) {
  if (terrain_m && (facts.height_above_ground_m || facts.altitude_above_takeoff_m)) {
    const bool ground = facts.height_above_ground_m.has_value();
    const double above = ground ? *facts.height_above_ground_m : *facts.altitude_above_takeoff_m;
    prior.height_in_world = *terrain_m + above;
    input.height_m = kTakeoffErrorM;
    input.notes.push_back(FormatText(
        "height: %.1f m = terrain below + %.1f m above %s",
        *prior.height_in_world,
        above,
        ground ? "the ground" : "take-off, which is assumed to have been as high as that terrain"));
    return;
  }
  const std::optional<double> undulation_m =
      GeoidUndulation(facts.place->latitude_deg, facts.place->longitude_deg);
  const std::optional<double> altitude_m = AltitudeInModel(facts, crs, undulation_m, input);
  if (terrain_m && altitude_m) {
    const std::string on_ground = OnGround(*altitude_m, *terrain_m, undulation_m);
    if (on_ground.empty() || facts.from_aircraft) {
      SetHeightInTheAir(*altitude_m, *terrain_m, undulation_m, facts.from_aircraft, prior, input);
      return;
    }
    input.notes.push_back(FormatText("height: terrain + %.1f m assumed", options.camera_height_m) +
                          on_ground);
    return;
  }
  if (!altitude_m) {
    input.notes.push_back(FormatText(
        "height: terrain + %.1f m assumed%s",
        options.camera_height_m,
        facts.from_aircraft ? ", though an aircraft took the picture: it tells no height that "
                              "can be used (--prior gives one)"
                            : ""));
    return;
  }
  prior.height_in_world = altitude_m;
  input.height_m = kAltitudeErrorM;
  input.notes.push_back(FormatText(
      "height: %.1f m, the picture's altitude, taken as the model's height for lack of a "
      "terrain model (--dtm)",
      *altitude_m));
}

// The terrain's height at a place; nullopt where the raster has none.
std::optional<double> TerrainAt(const std::filesystem::path& dtm,
                                const Crs& crs,
                                const Eigen::Vector2d& place) {
  constexpr double kMarginM = 5.0;
  CityModel frame;
  frame.crs = crs;
  frame.origin_in_world = {std::floor(place.x()), std::floor(place.y()), 0.0};
  const Eigen::Vector2d local = place - frame.origin_in_world.head<2>();
  std::vector<std::string> warnings;  // come again when the model is read
  return ReadDtm(dtm, frame, local, local, kMarginM, warnings).HeightAt(local);
}

Crs CrsOf(const Dataset& dataset) {
  CityOptions city;
  city.project_to = dataset.crs;
  return ReadCityCrs(dataset.model, city);
}

}  // namespace

std::optional<PosePrior> PriorOf(const PictureFacts& facts,
                                 const Crs& crs,
                                 const std::string& file,
                                 const std::optional<double>& terrain_m,
                                 const PictureInputOptions& options,
                                 PictureInput& input) {
  input.notes.insert(input.notes.end(), facts.doubts.begin(), facts.doubts.end());
  if (!facts.place) return std::nullopt;
  if (crs.horizontal_epsg == 0) {
    throw InputError(
        "--crs",
        "",
        "nothing, and a model that names no reference system",
        "the model's system, such as EPSG:25832, so that the latitude and longitude of " + file +
            " can be placed in it (or --prior FILE)");
  }
  const auto place = EastNorth(crs, facts.place->latitude_deg, facts.place->longitude_deg);
  if (!place) {
    throw InputError(
        file,
        "position",
        FormatText(
            "latitude %.6f, longitude %.6f", facts.place->latitude_deg, facts.place->longitude_deg),
        "a place in the reach of " + CrsName(crs) + " (--prior FILE gives another)");
  }
  PosePrior prior;
  prior.position_in_world = *place;
  input.horizontal_m = kReceiverErrorM;
  if (facts.horizontal_error_m) {
    input.horizontal_m = std::clamp(2.0 * *facts.horizontal_error_m, kReceiverErrorM, kMostErrorM);
  }
  input.notes.push_back(FormatText("position: %.6f, %.6f (%s) = %.1f east, %.1f north",
                                   facts.place->latitude_deg,
                                   facts.place->longitude_deg,
                                   facts.place->source.c_str(),
                                   place->x(),
                                   place->y()));
  SetHeight(facts, crs, terrain_m, options, prior, input);
  if (facts.direction) {
    std::string words;
    prior.heading_deg = GridHeading(facts, crs, *place, options, words);
    input.magnetic = facts.direction->magnetic;
    prior.pitch_deg = facts.direction->pitch_deg;
    prior.roll_deg = facts.direction->roll_deg;
    input.notes.push_back("heading: " + words);
  } else {
    input.notes.push_back("heading: not told by the picture; all directions are searched");
  }
  const bool known_tilt = prior.pitch_deg.has_value();
  input.pitch_deg = known_tilt ? kGimbalErrorDeg : kHandPitchDeg;
  input.roll_deg = known_tilt ? kGimbalErrorDeg : kHandRollDeg;
  if (known_tilt) {
    input.notes.push_back(FormatText("pitch, roll: %.1f, %.1f deg (%s)",
                                     *prior.pitch_deg,
                                     prior.roll_deg.value_or(0.0),
                                     facts.direction->source.c_str()));
  } else {
    input.notes.push_back("pitch, roll: not told by the picture; held level assumed");
  }
  return prior;
}

PictureInput ReadPictureInput(const Query& query,
                              const Crs& crs,
                              const std::optional<std::filesystem::path>& dtm,
                              const PictureInputOptions& options,
                              PictureReader& pictures) {
  PictureInput input;
  const cv::Mat stored = pictures.Read(query.image);
  const PictureFacts facts = ReadPictureFacts(query.image);
  if (!query.camera) {
    const PictureCamera made = CameraOf(facts, stored.cols, stored.rows);
    input.camera = made.camera;
    input.orientation = facts.orientation;
    input.focal_lengths = made.focal_lengths;
    input.notes.push_back(FormatText("camera: f = %.0f px, ", made.camera.params.front()) +
                          made.source + "; no distortion assumed" +
                          (facts.orientation != 1 ? "; turned upright as its EXIF says" : ""));
    input.notes.insert(input.notes.end(), made.notes.begin(), made.notes.end());
  }
  if (query.prior) return input;
  std::optional<double> terrain;
  if (facts.place && dtm) {
    const auto place = EastNorth(crs, facts.place->latitude_deg, facts.place->longitude_deg);
    if (place) terrain = TerrainAt(*dtm, crs, *place);
  }
  input.prior = PriorOf(facts, crs, query.image.string(), terrain, options, input);
  // A calibrated picture is not turned; its camera was.
  const double turned = query.camera ? OrientationRollDeg(facts.orientation) : 0.0;
  if (input.prior && turned != 0.0) {
    input.prior->roll_deg = HeadingDifferenceDeg(input.prior->roll_deg.value_or(0.0) + turned, 0.0);
    input.notes.push_back(
        FormatText("roll: %.0f deg, since the calibrated picture is stored on its side (EXIF)",
                   *input.prior->roll_deg));
  }
  return input;
}

namespace {

// Some programs write the principal point from the middle of the picture.
std::optional<Assumption> PrincipalPointDoubt(const CameraIntrinsics& camera,
                                              const std::string& source) {
  constexpr double kMostShare = 0.1;
  const PinholeCamera pinhole = camera.Pinhole();
  if (std::abs(pinhole.cx) > kMostShare * camera.width ||
      std::abs(pinhole.cy) > kMostShare * camera.height) {
    return std::nullopt;
  }
  return Assumption{
      "camera",
      FormatText("principal point %.6g, %.6g px as written, in the picture's corner; if it counts "
                 "from the middle, write %.6g, %.6g",
                 pinhole.cx,
                 pinhole.cy,
                 pinhole.cx + 0.5 * camera.width,
                 pinhole.cy + 0.5 * camera.height),
      source};
}

}  // namespace

PictureInput CompleteFromPicture(const Dataset& dataset,
                                 bool prior,
                                 const PictureInputOptions& options,
                                 PictureReader& pictures,
                                 std::optional<Crs>& crs,
                                 Query& query) {
  const bool wants_prior = prior && !query.prior;
  if (prior && query.prior) {
    if (IsInDegrees(*query.prior)) {
      if (!crs) crs = CrsOf(dataset);
      CheckPosition(*query.prior, *crs, dataset.file.string());
    }
    for (Assumption& assumption :
         AssumptionsOf(*query.prior, options.camera_height_m, dataset.file.string())) {
      query.assumptions.push_back(std::move(assumption));
    }
  }
  if (query.camera) {
    if (auto doubt = PrincipalPointDoubt(*query.camera, dataset.file.string())) {
      query.assumptions.push_back(std::move(*doubt));
    }
  }
  if (query.camera && !wants_prior) return {};
  Query asked = query;
  if (!prior) asked.prior.emplace();  // not to be asked for
  if (wants_prior && !crs) crs = CrsOf(dataset);
  PictureInput made = ReadPictureInput(asked, crs.value_or(Crs{}), dataset.dtm, options, pictures);
  if (made.camera) {
    query.camera = made.camera;
    query.orientation = made.orientation;
    query.focal_lengths = made.focal_lengths;
  }
  if (made.prior) query.prior = made.prior;
  for (const std::string& note : made.notes) {
    query.assumptions.push_back(AssumptionOf(note, query.image.string()));
  }
  return made;
}

std::size_t CompleteFromPictures(Dataset& dataset,
                                 bool priors,
                                 const PictureInputOptions& options) {
  std::size_t asked = 0;
  PictureReader pictures;
  std::optional<Crs> crs;
  for (Query& query : dataset.queries) {
    const bool complete = query.camera && (query.prior || !priors);
    CompleteFromPicture(dataset, priors, options, pictures, crs, query);
    if (!complete) ++asked;
  }
  return asked;
}

}  // namespace ridgeline
