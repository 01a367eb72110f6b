// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "city/city_options.h"
#include "city/city_region.h"
#include "city/source_model.h"

namespace ridgeline {

// A city in one file: a GeoPackage, which any GIS opens, with one feature per building or part in
// the layer "buildings" (outline box, id, heights, tile, and the surfaces as a blob) under a
// spatial index. A store that is being written is called "<name>.part"; it gets its name when it is
// whole.

struct CityStoreResult {
  std::size_t tiles = 0;         // read now
  std::size_t tiles_before = 0;  // found in the unfinished store of an earlier run
  std::size_t buildings = 0;     // in the whole store
  std::vector<std::string> warnings;
};

// Called after each tile: tiles done, tiles in all.
using CityStoreProgress = std::function<void(std::size_t, std::size_t)>;

// Reads the tiles (folders: every model file in them), a few at a time, and writes the store. A run
// that was killed goes on where it stopped, if the tiles are the same. Throws InputError for
// unreadable tiles, for tiles of different systems, and where the store cannot be written; the
// unfinished store stays for the next run.
CityStoreResult WriteCityStore(const std::vector<std::filesystem::path>& tiles,
                               const std::filesystem::path& store,
                               const CityOptions& options,
                               const CityStoreProgress& progress = {});

// Whether a path is a store's, by its name (*.gpkg).
bool IsCityStore(const std::filesystem::path& path);

// The buildings of a store that the region includes; all without a region. Throws InputError for a
// file that is not a whole store.
SourceModel ReadCityStore(const std::filesystem::path& store,
                          const std::optional<CityRegion>& region);

}  // namespace ridgeline
