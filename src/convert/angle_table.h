// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "convert/convert_options.h"
#include "input/dataset.h"

namespace ridgeline {

// A table of exterior orientations: a line of column names, then a line per picture, divided by
// commas, semicolons, tabs or blanks. Columns, in any order and case: the picture (name, image,
// imagename, label, photo, filename), easting, northing, height (x / y / z, x/easting, e / n / h,
// altitude) and omega, phi, kappa [deg] as in OmegaPhiKappa (Rx Ry Rz, not Loeper's order). So
// Agisoft Metashape ("#Label,X/Easting,...") and Pix4D ("imageName X Y Z Omega Phi Kappa") write
// them. Further columns are passed over.
// Throws InputError with file and line.
Dataset ReadAngleTable(const std::filesystem::path& file, const ConvertOptions& options);

}  // namespace ridgeline
