// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/shard.h"
#include "input/dataset.h"

namespace ridgeline {

// A file that results were made of.
struct HashedFile {
  std::string role;    // "dataset", "image", "lines", "model", "dtm", "world", "poses", ...
  std::string path;    // as it was named; relative to Provenance::folder
  std::string sha256;  // empty: no file of this machine (an address on a server)
};

// How results came about: enough to know whether two of them may be put together, and to make them
// again. In a folder of results it is the file provenance.json.
struct Provenance {
  std::string version;    // "ridgeline 0.1.0"
  std::string command;    // "bench", "study", ...
  std::string folder;     // that paths are relative to
  std::string arguments;  // JSON object: as given on the command line
  std::string task;       // JSON object: all that the results depend on besides the inputs
  std::vector<HashedFile> inputs;
  std::optional<Shard> shard;  // absent: the whole
};

inline constexpr const char* kProvenanceFile = "provenance.json";

std::string ProvenanceJson(const Provenance& provenance);
// Throws InputError for a file that is none.
Provenance ReadProvenance(const std::filesystem::path& file);

// SHA-256 over version, command, task and the inputs' roles and hashes; not over paths, arguments
// or shard. Results of one fingerprint belong together.
std::string FingerprintOf(const Provenance& provenance);

// Throws InputError naming the first thing in which the results that are there, by `file`, differ
// from what would be made now.
void CheckSame(const Provenance& there, const Provenance& now, const std::filesystem::path& file);

// The files of some queries of a dataset with its model and terrain, hashed. A folder of a model
// stands for all files in it, by name.
// @param role  Of the dataset's own file; its model's and terrain's begin with it where it is not
//              "dataset".
std::vector<HashedFile> HashInputs(const Dataset& dataset,
                                  const std::vector<std::size_t>& queries,
                                  const std::string& role);

// Of one file or folder.
void AddHashed(const std::string& role,
               const std::filesystem::path& path,
               std::vector<HashedFile>& inputs);

// Where a file of the inputs is: by the folder of the provenance, or else from here. Empty: nowhere.
std::filesystem::path PlaceOf(const HashedFile& input, const Provenance& provenance);

}  // namespace ridgeline
