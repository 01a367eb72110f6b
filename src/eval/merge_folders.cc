// SPDX-License-Identifier: Apache-2.0
#include "eval/merge_folders.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "eval/run_folder.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string Numbers(const std::set<int>& shards, int count) {
  std::string text;
  for (const int index : shards) {
    text += (text.empty() ? "" : ", ") + TextOf(Shard{index, count});
  }
  return text;
}

// Pieces are numbered within their kind: "000012_..." or "map_000012_...".
struct PieceNumber {
  std::string kind;
  std::size_t index = 0;
};
PieceNumber NumberOf(const std::string& name) {
  const std::size_t at = name.find_first_of("0123456789");
  PieceNumber number{name.substr(0, std::min(at, name.size())), 0};
  if (at != std::string::npos) {
    std::from_chars(name.data() + at, name.data() + name.size(), number.index);
  }
  return number;
}

// How many pieces each kind has, in all shards.
std::map<std::string, std::size_t> CountsOf(const Provenance& provenance) {
  const Json task = Json::parse(provenance.task);
  const std::size_t queries = task.at("queries").size();
  if (provenance.command == "bench") return {{"", queries * task.at("seeds").get<std::size_t>()}};
  const std::size_t maps = queries * task.at("scores").size();
  std::size_t levels = 0;
  for (const Json& variation : task.at("variations")) levels += variation.at(1).size();
  return {{"map_", maps}, {"varied_", levels * maps}};
}

std::vector<fs::path> PiecesOf(const fs::path& folder, const std::string& fingerprint) {
  std::vector<fs::path> pieces;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "runs", error)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".")) continue;
    if (ReadPiece(folder, fingerprint, name)) pieces.push_back(entry.path());
  }
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

// The pieces that a shard has and should have.
void CheckComplete(const fs::path& folder,
                   const Provenance& provenance,
                   const std::vector<fs::path>& pieces) {
  const Shard shard = provenance.shard.value_or(Shard{});
  std::map<std::string, std::set<std::size_t>> seen;
  for (const fs::path& piece : pieces) {
    const PieceNumber number = NumberOf(piece.filename());
    seen[number.kind].insert(number.index);
  }
  std::size_t missing = 0;
  std::size_t wanted = 0;
  for (const auto& [kind, count] : CountsOf(provenance)) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!shard.Takes(i)) continue;
      ++wanted;
      missing += seen[kind].contains(i) ? 0 : 1;
    }
  }
  if (missing == 0) return;
  throw InputError(folder.string(),
                   "runs",
                   std::to_string(wanted - missing) + " of " + std::to_string(wanted) +
                       " of shard " + TextOf(shard),
                   "all of them: go on with --resume");
}

}  // namespace

MergedFolders FindShards(const std::vector<fs::path>& folders) {
  MergedFolders merged;
  std::set<int> missing;
  int count = 0;
  for (const fs::path& folder : folders) {
    const fs::path file = folder / kProvenanceFile;
    if (!fs::exists(file)) {
      throw InputError(folder.string(), "", "no provenance.json", "a folder of bench or study");
    }
    const Provenance provenance = ReadProvenance(file);
    if (provenance.command != "bench" && provenance.command != "study") {
      throw InputError(file.string(), "command", provenance.command, "bench or study");
    }
    const Shard shard = provenance.shard.value_or(Shard{});
    if (merged.whole.command.empty()) {
      merged.whole = provenance;
      merged.whole.shard.reset();
      count = shard.count;
      for (int i = 1; i <= count; ++i) missing.insert(i);
    }
    CheckSame(provenance, merged.whole, file);
    if (shard.count != count) {
      throw InputError(file.string(),
                       "shard",
                       TextOf(shard),
                       "one of " + std::to_string(count) + ", as in the folders before");
    }
    missing.erase(shard.index);
    const std::vector<fs::path> pieces = PiecesOf(folder, FingerprintOf(provenance));
    CheckComplete(folder, provenance, pieces);
    merged.pieces.insert(merged.pieces.end(), pieces.begin(), pieces.end());
  }
  if (!missing.empty()) {
    throw InputError("merge",
                     "",
                     "no folder of shard " + Numbers(missing, count),
                     "all " + std::to_string(count) + " shards");
  }
  return merged;
}

void CopyPieces(const std::vector<fs::path>& pieces, const fs::path& folder) {
  const fs::path runs = folder / "runs";
  fs::create_directories(runs);
  for (const fs::path& piece : pieces) {
    WriteFileAtomically(runs / piece.filename(), ReadFile(piece));
  }
}

}  // namespace ridgeline
