// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "convert/convert_options.h"
#include "input/dataset.h"

namespace ridgeline {

// A COLMAP text model: a folder with cameras.txt and images.txt. The pictures' poses become truths;
// points are passed over. An origin that WriteColmapModel noted is added. Throws InputError with
// file and line. Source: colmap.github.io/format.html.
Dataset ReadColmapModel(const std::filesystem::path& folder, const ConvertOptions& options);

// Writes cameras.txt, images.txt and an empty points3D.txt, relative to an origin (the options',
// else one rounded to 100 m near the poses) that stands in the head of images.txt. One camera for
// equal ones. Queries without truth are left out; throws InputError for one without camera. Returns
// the number of pictures.
std::size_t WriteColmapModel(const Dataset& dataset,
                             const ConvertOptions& options,
                             const std::filesystem::path& folder);

}  // namespace ridgeline
