// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "camera/intrinsics.h"

namespace ridgeline {

// Cameras of a calibration as text.
struct CameraFile {
  std::optional<CameraIntrinsics> common;  // of all pictures
  std::map<std::string, CameraIntrinsics> by_picture;

  // Of a picture by name; the common one where it is not named.
  std::optional<CameraIntrinsics> Of(const std::string& picture) const;
};

// Reads what photogrammetric programs and people write as "camera parameters", for pictures of
// width x height px:
//   - Pix4D's calibrated_camera_parameters: per picture "name width height", the matrix K in three
//     lines, radial and tangential distortion (position and rotation after it are passed over)
//   - Pix4D's .cam: F, Px, Py, K1, K2, K3, T1, T2 in mm with "sensor width of 9.8x7.3mm"
//   - the matrix K alone, in three lines or one
//   - words and numbers: fx 1000, focal length (px): 1000, cx = 480, k1, k2, k3, p1, p2, t1, t2,
//     width, height, principal point 480 640, image size 960 x 1280; or a line of names over one of
//     numbers
//   - COLMAP's "id MODEL width height params", or with a picture's name for the id
// A camera of larger or smaller pictures of the same shape is scaled. Distortion is Brown's, as in
// Pix4D, OpenCV and COLMAP.
// Throws InputError with file and line, or with what was looked for, for anything else, for
// millimetres without a sensor's size, and for a camera of another shape or one that cannot be of
// such pictures.
// Sources: Pix4D, articles 202559089 and 202977149; COLMAP, doc/format.rst.
CameraFile ReadCameraFile(const std::filesystem::path& file, int width, int height);

}  // namespace ridgeline
