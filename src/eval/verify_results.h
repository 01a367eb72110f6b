// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/provenance.h"
#include "input/dataset.h"

namespace ridgeline {

// Something that was looked at, and whether it is as the results say.
struct Check {
  std::string what;   // "model city.gml"
  bool ok = false;
  std::string found;  // where it is not ok, in words
};

// The hash of every input, computed anew. Addresses on servers are passed over.
std::vector<Check> CheckInputs(const Provenance& provenance);

// Of a folder of bench: whether results.csv and evidence.csv are those of the pieces in runs/, and
// every piece is of this work.
// @param dataset  With the truths that answers are judged by, as BenchQueries::dataset().
std::vector<Check> CheckTables(const std::filesystem::path& folder,
                               const Provenance& provenance,
                               const Dataset& dataset);

// The provenance of a folder: its provenance.json, or what report.json of localize says. Throws
// InputError if it has neither.
Provenance ProvenanceOfResults(const std::filesystem::path& folder);

}  // namespace ridgeline
