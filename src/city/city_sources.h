// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "city/projected_sources.h"

namespace ridgeline {

struct CitySources {
  ProjectedSources projected;
  std::vector<std::string> warnings;  // of files that were fetched or passed over
};

// Reads the files, stores and folders in one projected system: the first half of ReadCity.
CitySources ReadCitySources(const std::vector<std::filesystem::path>& paths,
                            const CityOptions& options);

}  // namespace ridgeline
