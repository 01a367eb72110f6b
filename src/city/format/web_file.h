// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/limits.h"

namespace ridgeline {

// Files on web servers, kept in a cache on the disk. A copy that is there is used again if the
// server says that it is unchanged, or says nothing at all; a download that ends early is never
// kept.
struct WebOptions {
  // Empty: $RIDGELINE_CACHE, else $XDG_CACHE_HOME/ridgeline, else ~/.cache/ridgeline.
  std::filesystem::path cache;
  // A server is given up when it does not answer, or sends less than 1 kB a second, for so long [s].
  int patience_s = 20;
  // And in any case after so long [s]: a server may drip just fast enough.
  int most_s = 3600;
  // Longest file that is taken, unpacked [bytes].
  std::uint64_t most_bytes = limits::kFileBytes;
  // Repeated tries after an answer such as 503.
  int retries = 2;
};

// Whether a path is an address: "http://..." or "https://...".
bool IsWebAddress(const std::filesystem::path& path);

struct WebFile {
  std::filesystem::path path;  // of the copy
  std::string warning;         // if the server could not be asked whether the copy is current
};

// The local copy of a file; nullopt if the server has no such file (404, 410). Throws InputError,
// naming the address, for a server that cannot be reached, is too slow, answers with another error
// or sends half of the file, while there is no earlier copy.
std::optional<WebFile> FetchWebFile(const std::string& address, const WebOptions& options = {});

// Whether an address stands for many tiles: it has {east} and {north}, the kilometres of a tile's
// lower left corner, or {east/2} and {north/2} for tiles of 2 km, and so on.
bool IsTileAddress(const std::string& address);

// The addresses of the tiles that touch a box [m]. Throws InputError for a template that is none.
std::vector<std::string> TileAddresses(const std::string& address, const Eigen::AlignedBox2d& box);

}  // namespace ridgeline
