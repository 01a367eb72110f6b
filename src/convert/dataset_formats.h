// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "convert/convert_options.h"
#include "input/dataset.h"

namespace ridgeline {

// Formats that are read: "dataset", "colmap", "egeniouss" (egenioussBench), "visloc"
// (visuallocalization.net), "lodloc", "opensfm", "opk" (omega, phi, kappa), "results".
const std::vector<std::string>& InputFormats();

// Formats that are written: "dataset", "colmap", "egeniouss" (a submission), "geojson", "kml",
// "tum".
const std::vector<std::string>& OutputFormats();

// The format of a file or folder by its name and beginning. Throws InputError if it is none of
// them.
std::string FormatOfInput(const std::filesystem::path& path);

// The format that an output's name asks for: dataset (.json), geojson, kml, tum (.tum, .txt),
// colmap (a folder: no extension). Throws InputError for others.
std::string FormatOfOutput(const std::filesystem::path& path);

// Reads one input of a format; "" finds it out. Queries get ids: their picture's name without
// folder and extension, or all of it where that is not enough to tell them apart.
Dataset ReadInput(const std::filesystem::path& path,
                  const std::string& format,
                  const ConvertOptions& options);

// Adds what `more` knows to the queries of `dataset` that it knows by id or picture name: cameras
// and priors where they lack, truths over those they have; and its system. Where `more` is results,
// the dataset's truths are dropped first, so that none of them passes for a result. Unknown queries
// are an InputError that names the first.
void Merge(const Dataset& more, bool is_results, Dataset& dataset);

// Writes a dataset in a format, whole or not at all. Returns the number of pictures written. Throws
// InputError if there is none, and where the file cannot be written.
std::size_t WriteOutput(const Dataset& dataset,
                        const std::string& format,
                        const ConvertOptions& options,
                        const std::filesystem::path& path);

}  // namespace ridgeline
