// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "convert/convert_options.h"
#include "input/dataset.h"

namespace ridgeline {

// Poses that ridgeline found, as truths: results.csv of bench (of several seeds the first one's; or
// any CSV query,e,n,h,qw,qx,qy,qz), poses.txt of bench, or pose.json of localize. Runs that
// abstained have none. Throws InputError with file and line.
Dataset ReadResults(const std::filesystem::path& file, const ConvertOptions& options);

}  // namespace ridgeline
