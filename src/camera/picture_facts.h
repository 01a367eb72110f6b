// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/picture_blocks.h"

namespace ridgeline {

// What a picture says about its camera and where it was taken: EXIF, and the XMP of DJI (and of
// makers who took over its names), Parrot, Skydio, Pix4D, senseFly and Google; docs/inputs.md has
// the table. Absent: the picture does not say, or says what cannot be meant (then it is a doubt).
// XMP, being the finer, goes before EXIF.
struct PictureFacts {
  // EXIF orientation, 1 to 8: how the stored rows and columns are to be shown.
  int orientation = 1;
  std::string make;
  std::string camera;          // model name
  std::optional<double> year;  // decimal
  // Size as the camera recorded it; the picture at hand may have been turned, resized, cropped.
  struct Size {
    double width_px = 0.0;
    double height_px = 0.0;  // 0: not told
  };
  std::optional<Size> recorded;
  std::optional<double> zoom;  // digital, > 1
  std::optional<double> focal_mm;
  std::optional<double> focal_35mm;       // equivalent on 36 x 24 mm
  std::optional<double> plane_px_per_mm;  // resolution of the sensor's plane at the recorded size
  // The maker's calibration, with the size it belongs to; some makers write mm, not px.
  struct Calibration {
    double focal = 0.0;        // [px], or [mm] if no camera has so few pixels
    std::optional<Size> size;  // absent: the recorded size
  };
  std::optional<Calibration> calibration;

  struct Place {
    double latitude_deg = 0.0;  // WGS 84
    double longitude_deg = 0.0;
    std::string source;
  };
  std::optional<Place> place;
  std::optional<double> horizontal_error_m;
  std::optional<double> altitude_m;
  bool altitude_above_ellipsoid = false;  // else above sea level
  std::optional<double> altitude_above_takeoff_m;
  std::optional<double> height_above_ground_m;
  bool from_aircraft = false;  // by its maker or the items of its XMP

  // Of the optical axis, from true or magnetic north; pitch and roll as in ViewAngles.
  struct Direction {
    double heading_deg = 0.0;
    bool magnetic = false;
    std::optional<double> pitch_deg;
    std::optional<double> roll_deg;
    std::string source;
  };
  std::optional<Direction> direction;

  // Items that are absent or odd and what was assumed or dropped because of it, a sentence each.
  std::vector<std::string> doubts;
};

PictureFacts FactsOf(const ExifItems& exif, const XmpProperties& xmp);

// Throws InputError if the file cannot be read, and for panoramas, which no camera here describes.
PictureFacts ReadPictureFacts(const std::filesystem::path& path);

// Whether a picture of this EXIF orientation is shown with width and height exchanged.
bool OrientationSwapsSides(int orientation);

// Roll of the camera [deg] that stored a picture of this orientation upright: 90 for 6, whose first
// row is the scene's right side. Mirrored pictures as their unmirrored ones.
double OrientationRollDeg(int orientation);

}  // namespace ridgeline
