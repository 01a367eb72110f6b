// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "eval/provenance.h"

namespace ridgeline {

// Shards of one work, all there and of one fingerprint.
struct MergedFolders {
  Provenance whole;  // of the work without a shard
  std::vector<std::filesystem::path> pieces;
};

// Throws InputError for a folder without results, for results of different work, naming the
// difference, for shards of different counts, for missing shards, named, and for a shard with too
// few pieces.
MergedFolders FindShards(const std::vector<std::filesystem::path>& folders);

// Copies pieces into the folder's runs/, each whole or not at all.
void CopyPieces(const std::vector<std::filesystem::path>& pieces,
                const std::filesystem::path& folder);

}  // namespace ridgeline
