// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "convert/convert_options.h"
#include "input/dataset.h"

namespace ridgeline {

// A reconstruction.json of OpenSfM or OpenDroneMap: shots with their cameras, in the topocentric
// frame of reference_lla, moved to the options' system. Heights are the reconstruction's own: above
// the ellipsoid, or what the pictures' EXIF said. Cameras: perspective, simple_radial, radial,
// brown. Throws InputError naming the place for damaged files, for reconstructions without a place
// in the world, other cameras, and where no system is given. Source: opensfm.org/docs, "Geometric
// Models"; opensfm/geo.py.
Dataset ReadOpenSfm(const std::filesystem::path& file, const ConvertOptions& options);

}  // namespace ridgeline
