// SPDX-License-Identifier: Apache-2.0
#include "eval/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path RunsOf(const fs::path& folder) { return folder / "runs"; }

// Without files on their way.
std::size_t PiecesIn(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(RunsOf(folder), error)) {
    count += entry.path().filename().string().starts_with(".") ? 0 : 1;
  }
  return count;
}

std::string NameOf(const std::optional<Shard>& shard) {
  return shard ? "shard " + TextOf(*shard) : std::string("the whole");
}

// Throws InputError unless the results of a folder are of this work.
void CheckGoesOn(const fs::path& folder, const Provenance& provenance) {
  const fs::path file = folder / kProvenanceFile;
  if (!fs::exists(file)) {
    throw InputError("--out",
                     "",
                     folder.string() + ", which holds results without " + kProvenanceFile,
                     "another folder");
  }
  const Provenance there = ReadProvenance(file);
  CheckSame(there, provenance, file);
  if (there.shard == provenance.shard) return;
  throw InputError(file.string(),
                   "shard",
                   "results of " + NameOf(there.shard),
                   NameOf(provenance.shard) + " as asked for now, or another --out");
}

}  // namespace

bool HoldsResults(const fs::path& folder) {
  for (const char* name : {"results.csv", "summary.json", "summary.csv", "figures.csv"}) {
    std::error_code error;
    if (fs::exists(folder / name, error)) return true;
  }
  return PiecesIn(folder) > 0;
}

RunFolder::Lock::Lock(const fs::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const bool taken = errno == EWOULDBLOCK;
  ::close(descriptor_);
  descriptor_ = -1;
  if (!taken) return;
  throw InputError("--out",
                   "",
                   folder.string() + ", to which another process writes",
                   "another folder, or its end");
}

RunFolder::Lock::~Lock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

RunFolder::RunFolder(fs::path folder, const Provenance& provenance, bool resume)
    : folder_(std::move(folder)),
      lock_(folder_),
      provenance_(provenance),
      fingerprint_(FingerprintOf(provenance)) {
  if (HoldsResults(folder_)) {
    if (!resume) {
      throw InputError("--out",
                       "",
                       folder_.string() + ", which holds results",
                       "another folder, or --resume to go on with the same work");
    }
    CheckGoesOn(folder_, provenance);
  }
  if (resume) RemoveLeftovers(folder_);
  found_ = PiecesIn(folder_);
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (!HoldsResults(folder_)) {
    fs::remove(folder_ / kProvenanceFile, ignored);
    fs::remove(RunsOf(folder_), ignored);
  }
}

// First what the pieces are of, then pieces.
void RunFolder::Begin() const {
  if (!HoldsResults(folder_)) {
    WriteFileAtomically(folder_ / kProvenanceFile, ProvenanceJson(provenance_));
  }
  fs::create_directories(RunsOf(folder_));
}

std::optional<std::string> ReadPiece(const fs::path& folder,
                                     const std::string& fingerprint,
                                     const std::string& name) {
  const fs::path file = RunsOf(folder) / name;
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  const Json json = Json::parse(ReadFile(file), nullptr, false);
  const bool whole = json.is_object() && json.contains("fingerprint") && json.contains("piece");
  if (!whole) return std::nullopt;
  if (json["fingerprint"] != fingerprint) {
    throw InputError(file.string(),
                     "fingerprint",
                     json["fingerprint"].dump(),
                     "that of " + (folder / kProvenanceFile).string() + "; remove the file");
  }
  return json["piece"].dump();
}

std::optional<std::string> RunFolder::Find(const std::string& name) const {
  return ReadPiece(folder_, fingerprint_, name);
}

void RunFolder::Keep(const std::string& name, const std::string& json) const {
  WriteFileAtomically(RunsOf(folder_) / name,
                      "{\"fingerprint\":\"" + fingerprint_ + "\",\"piece\":" + json + "}\n");
}

std::string PieceName(std::size_t index, const std::string& what) {
  char number[24];
  std::snprintf(number, sizeof number, "%06zu_", index);
  constexpr std::size_t kMost = 80;
  std::string name = number + what.substr(0, kMost);
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return name + ".json";
}

void RemoveLeftovers(const fs::path& folder) {
  std::vector<fs::path> leftovers;
  for (const char* part : {"", "runs", "maps", "explored"}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / part, error)) {
      const std::string name = entry.path().filename();
      if (name.starts_with(".") && name.find(".part-") != std::string::npos) {
        leftovers.push_back(entry.path());
      }
    }
  }
  for (const fs::path& path : leftovers) fs::remove_all(path);
}

}  // namespace ridgeline
