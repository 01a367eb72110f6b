// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "report/report_data.h"

namespace ridgeline {

// Writes runs as a map, whole or not at all: .gpkg (GeoPackage, a layer per kind), .geojson (one
// layer) or .kml; the last two in WGS 84, as web maps want them (RFC 7946), a .geojson of a model
// without a known CRS in its own coordinates. Kinds, also in the
// attribute "layer": poses (priors, results, truths), prior_boxes, view_cones, errors (result to
// truth), ellipses (95 %). Throws InputError for another extension, a KML of a model without a
// known CRS, or a file that cannot be written.
// @param epsg  Of all coordinates; 0: not known.
void WriteMap(std::span<const ReportRun> runs, int epsg, const std::filesystem::path& path);

// Throws InputError for a name that WriteMap() does not know by its extension.
void CheckMapName(const std::filesystem::path& path);

// Writes an energy map as GeoTIFF (float32, NaN: not admissible); pixel centres are its positions.
// Throws InputError if the file cannot be written.
void WriteEnergyMap(const ReportEnergyMap& map, int epsg, const std::filesystem::path& path);

}  // namespace ridgeline
