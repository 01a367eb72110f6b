// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "city/city_options.h"
#include "city/source_model.h"

namespace ridgeline {

// Model files as read, in one projected system in metres.
struct ProjectedSources {
  std::vector<SourceModel> sources;
  Crs crs;
  // East and north of all buildings, those outside of the region too.
  Eigen::AlignedBox2d extent;
};

// Moves sources to one projected system, by what they say and the options, and removes the
// buildings outside of options.region. What was converted or is doubted is counted in the sources'
// tallies. Throws InputError for sources in different systems, unknown ones, and such that are not
// true to scale.
ProjectedSources ProjectSources(std::vector<SourceModel> sources, const CityOptions& options);

// The system of one file: the forced one, or what its srsNames agree on; horizontal_epsg 0: it
// names none.
Crs CrsOfSource(const SourceModel& source, const std::optional<Crs>& forced);

// The system that an option names; nullopt: the text is empty. Throws InputError, naming the field
// ("model_crs").
std::optional<Crs> ParseCrsOption(const char* field, const std::string& text);

}  // namespace ridgeline
