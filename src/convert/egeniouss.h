// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "convert/convert_options.h"
#include "input/dataset.h"

namespace ridgeline {

// The layout of egenioussBench (Fanta-Jende et al. 2025; docs/egenioussbench.md):
//   lod2/ (CityGML)  metadata/camera_parameters.txt  query_images/{val,test}/
//   query_images/val_gt_poses.txt, val_android_poses.txt, test_android_poses.csv
// Poses are lines "name qw qx qy qz east north altitude", # comments; the rotation takes the
// photogrammetric camera (x right, y up, z backward) to the world.

// Whether a folder is such a benchmark, or query_images/val or /test of one.
bool IsEgenioussFolder(const std::filesystem::path& folder);

// The pictures of a benchmark, in the sets "val" and "test", or of one of the two folders. Truths
// from val_gt_poses; of the phones' own poses only the position is taken, since the organizers warn
// that their headings are wrong and their heights are the receiver's. Pictures that no list names
// have no prior. Throws InputError with file and line.
Dataset ReadEgeniouss(const std::filesystem::path& folder, const ConvertOptions& options);

// The poses of a dataset's truths as a list in the benchmark's form: a submission. Numbers read
// back to the same doubles.
std::string EgenioussPoses(const Dataset& dataset);

// Writes a dataset in the benchmark's layout into the existing folder: its model, its pictures, the
// last quarter of them as "test", and priors with the errors of a phone drawn from the seed. The
// pictures must have one camera and truths. A DTM is copied to dtm.tif beside the layout, which has
// none.
void WriteEgenioussFolder(const Dataset& dataset,
                          std::uint64_t seed,
                          const std::filesystem::path& folder);

}  // namespace ridgeline
