// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "eval/provenance.h"

namespace ridgeline {

// A folder of results that loses nothing that is finished: each piece of the work is a file of its
// own in runs/, which appears whole or not at all, and provenance.json says of what work they are.
// Pieces of different work are never mixed, and one process at a time writes.
//
//   RunFolder folder(out, provenance, resume);
//   folder.Begin();                                      // once the inputs are known to be good
//   if (const auto text = folder.Find(name)) ...         // finished before
//   else folder.Keep(name, text_of_the_finished_piece);
class RunFolder {
 public:
  // For a folder that holds no results, or to go on in one that holds results of the same
  // fingerprint; nothing is written yet. Throws InputError where there are results without `resume`, for results of other
  // work, naming the difference, and while another process has the folder.
  // @param folder  Exists.
  RunFolder(std::filesystem::path folder, const Provenance& provenance, bool resume);
  // Takes back what Begin() made if there is no piece and no result.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  // Writes provenance.json.
  void Begin() const;

  // The JSON of a finished piece; nullopt: none yet, or what a power cut left of it. Throws
  // InputError for a file of other work.
  std::optional<std::string> Find(const std::string& name) const;
  // Keeps the JSON of a finished piece.
  void Keep(const std::string& name, const std::string& json) const;

  const std::filesystem::path& path() const { return folder_; }
  // How many pieces were there at the start.
  std::size_t found() const { return found_; }

 private:
  // Of the folder itself, so that no file is left behind; goes with the process.
  class Lock {
   public:
    explicit Lock(const std::filesystem::path& folder);
    ~Lock();
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

   private:
    int descriptor_ = -1;  // -1: a file system without locks
  };

  std::filesystem::path folder_;
  Lock lock_;
  Provenance provenance_;
  std::string fingerprint_;
  std::size_t found_ = 0;
};

// Whether a folder holds results of any work: pieces or tables.
bool HoldsResults(const std::filesystem::path& folder);

// The JSON of a piece in the folder of results of a fingerprint, as RunFolder::Find().
std::optional<std::string> ReadPiece(const std::filesystem::path& folder,
                                     const std::string& fingerprint,
                                     const std::string& name);

// "000017_street_005_1.json": unique by the place in the list of work, and readable.
std::string PieceName(std::size_t index, const std::string& what);

// Files that processes left which were killed while they wrote them.
void RemoveLeftovers(const std::filesystem::path& folder);

}  // namespace ridgeline
