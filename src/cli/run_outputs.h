// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <vector>

#include "cli/context.h"
#include "eval/bench.h"

namespace ridgeline {

// Pictures and maps of localized queries, besides the figures.
struct RunOutputs {
  std::string report;      // HTML file
  std::string map;         // .gpkg, .geojson or .kml
  std::string overlays;    // folder: one picture per run
  std::string energy_map;  // GeoTIFF, of the first run; offered where there is one run
};

// --report, --map, --overlay and --energy-map for one run; --report, --map and --overlays for many.
void AddRunOutputOptions(CLI::App& command, RunOutputs& outputs, bool many);

// Throws InputError for outputs that could not be written, before the work is done.
void CheckRunOutputs(const RunOutputs& outputs, bool many);

// What is said about the making of the runs.
struct RunOrigin {
  std::string title;
  std::string command;
  std::string options_json;
  Protocol protocol;
};

// Writes what was asked for and names each file on stderr.
void WriteRunOutputs(const RunOutputs& outputs,
                     bool many,
                     const RunOrigin& origin,
                     const std::vector<Query>& queries,
                     const Localizer& localizer,
                     std::span<const BenchRun> runs,
                     const Context& context);

}  // namespace ridgeline
