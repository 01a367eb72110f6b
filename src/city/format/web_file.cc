// SPDX-License-Identifier: Apache-2.0
#include "city/format/web_file.h"

#include <cpl_http.h>
#include <cpl_string.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/random.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

fs::path CacheFolder(const WebOptions& options) {
  if (!options.cache.empty()) return options.cache;
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value != nullptr ? value : "");
  };
  if (!variable("RIDGELINE_CACHE").empty()) return variable("RIDGELINE_CACHE");
  if (!variable("XDG_CACHE_HOME").empty())
    return fs::path(variable("XDG_CACHE_HOME")) / "ridgeline";
  if (!variable("HOME").empty()) return fs::path(variable("HOME")) / ".cache" / "ridgeline";
  return fs::temp_directory_path() / "ridgeline-cache";
}

// The address's file name, which tells the format, behind what makes it unique.
std::string NameInCache(const std::string& address) {
  std::string name = address.substr(0, address.find_first_of("?#"));
  name = name.substr(name.find_last_of('/') + 1);
  char key[24];
  std::snprintf(key, sizeof(key), "%016llx-", static_cast<unsigned long long>(HashText(address)));
  return key + name;
}

struct Receiver {
  std::ofstream stream;
  std::uint64_t most_bytes = 0;
  std::uint64_t bytes = 0;

  bool IsTooMuch() const { return bytes > most_bytes; }
};

std::size_t Receive(void* data, std::size_t size, std::size_t count, void* argument) {
  auto& receiver = *static_cast<Receiver*>(argument);
  receiver.bytes += size * count;
  if (receiver.IsTooMuch()) return 0;
  receiver.stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(size * count));
  return receiver.stream ? count : 0;
}

struct ResultCloser {
  void operator()(CPLHTTPResult* result) const { CPLHTTPDestroyResult(result); }
};

struct Answer {
  bool unchanged = false;  // 304
  bool missing = false;    // 404, 410
  std::string error;       // in words; empty: the file is whole
  std::string date;        // Last-Modified
};

// Downloads to `file`, unless the server says that nothing has changed since `date`.
Answer Download(const std::string& address,
                const fs::path& file,
                const std::string& date,
                const WebOptions& options) {
  const std::string patience = std::to_string(options.patience_s);
  CPLStringList words;
  words.SetNameValue("CONNECTTIMEOUT", patience.c_str());
  words.SetNameValue("LOW_SPEED_TIME", patience.c_str());
  words.SetNameValue("LOW_SPEED_LIMIT", "1000");
  words.SetNameValue("TIMEOUT", std::to_string(options.most_s).c_str());
  words.SetNameValue("MAX_RETRY", std::to_string(options.retries).c_str());
  words.SetNameValue("RETRY_DELAY", "1");
  if (!date.empty()) words.SetNameValue("HEADERS", ("If-Modified-Since: " + date).c_str());
  Receiver receiver{std::ofstream(file, std::ios::binary), options.most_bytes, 0};
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const std::unique_ptr<CPLHTTPResult, ResultCloser> result(
      CPLHTTPFetchEx(address.c_str(), words.List(), nullptr, nullptr, Receive, &receiver));
  CPLPopErrorHandler();
  receiver.stream.close();
  Answer answer;
  if (result == nullptr) {
    answer.error = "no answer";
    return answer;
  }
  const std::string said = result->pszErrBuf != nullptr ? result->pszErrBuf : "";
  answer.missing = said.find("404") != std::string::npos || said.find("410") != std::string::npos;
  if (receiver.IsTooMuch()) {
    answer.error = "more than " + std::to_string(options.most_bytes) + " bytes (limit)";
  } else if (!receiver.stream) {
    answer.error = "a disk without room in the cache folder";
  } else if (!said.empty() || result->nStatus != 0) {
    answer.error = said.empty() ? "error " + std::to_string(result->nStatus) : said;
  }
  if (!answer.error.empty()) return answer;
  const CPLStringList headers(result->papszHeaders, FALSE);
  answer.date = headers.FetchNameValueDef("Last-Modified", "");
  const char* const length = headers.FetchNameValue("Content-Length");
  answer.unchanged = !date.empty() && receiver.bytes == 0;
  if (!answer.unchanged && length != nullptr &&
      std::strtoull(length, nullptr, 10) != receiver.bytes) {
    answer.error = std::to_string(receiver.bytes) + " of " + length + " bytes";
  }
  if (!answer.unchanged && receiver.bytes == 0 && answer.error.empty()) answer.error = "no bytes";
  return answer;
}

// A placeholder such as {east} or {east/2}: where it stands and its kilometres.
struct Placeholder {
  std::size_t begin = std::string::npos;
  std::size_t size = 0;
  int kilometres = 1;
};

Placeholder Find(const std::string& address, const std::string& name) {
  Placeholder found;
  found.begin = address.find("{" + name);
  if (found.begin == std::string::npos) return found;
  const std::size_t end = address.find('}', found.begin);
  const std::size_t after = found.begin + 1 + name.size();
  const bool divided = after < address.size() && address[after] == '/';
  if (divided) found.kilometres = std::atoi(address.c_str() + after + 1);
  if (end == std::string::npos || found.kilometres < 1 || (!divided && end != after)) {
    throw InputError(
        "--model", "", address, "{east} and {north}, or {east/2} and {north/2} for tiles of 2 km");
  }
  found.size = end + 1 - found.begin;
  return found;
}

}  // namespace

bool IsWebAddress(const fs::path& path) {
  const std::string text = path.string();
  return text.starts_with("http://") || text.starts_with("https://");
}

std::optional<WebFile> FetchWebFile(const std::string& address, const WebOptions& options) {
  const fs::path folder = CacheFolder(options);
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path copy = folder / NameInCache(address);
  const fs::path dated = copy.string() + ".date";
  const bool have = fs::is_regular_file(copy, error);
  std::string date;
  if (have && fs::is_regular_file(dated, error)) date = ReadFile(dated);
  const fs::path temporary = TemporaryBeside(copy);
  const Answer answer = Download(address, temporary, date, options);
  if (answer.error.empty() && !answer.unchanged) {
    fs::remove(dated, error);  // a date never goes with another file
    CommitFile(temporary, copy);
    if (!answer.date.empty()) WriteFileAtomically(dated, answer.date);
    return WebFile{copy, ""};
  }
  fs::remove(temporary, error);
  if (answer.unchanged) return WebFile{copy, ""};
  if (answer.missing) return std::nullopt;
  if (have) {
    return WebFile{copy,
                   address + ": " + answer.error + "; the copy of an earlier run is used (" +
                       copy.string() + ")"};
  }
  throw InputError(address, "", answer.error, "a server that sends the whole file");
}

bool IsTileAddress(const std::string& address) {
  return address.find("{east") != std::string::npos && address.find("{north") != std::string::npos;
}

std::vector<std::string> TileAddresses(const std::string& address, const Eigen::AlignedBox2d& box) {
  constexpr double kMetresPerKilometre = 1000.0;
  constexpr std::size_t kMostTiles = 400;
  const int east_km = Find(address, "east").kilometres;
  const int north_km = Find(address, "north").kilometres;
  const auto index = [](double metres, int kilometres) {
    return static_cast<long>(std::floor(metres / (kMetresPerKilometre * kilometres)));
  };
  std::vector<std::string> addresses;
  for (long e = index(box.min().x(), east_km); e <= index(box.max().x(), east_km); ++e) {
    for (long n = index(box.min().y(), north_km); n <= index(box.max().y(), north_km); ++n) {
      std::string tile = address;
      Placeholder at = Find(tile, "east");
      tile.replace(at.begin, at.size, std::to_string(e * east_km));
      at = Find(tile, "north");
      tile.replace(at.begin, at.size, std::to_string(n * north_km));
      addresses.push_back(std::move(tile));
      if (addresses.size() > kMostTiles) {
        throw InputError(
            "--model", "", address + " for more than 400 tiles", "places closer together");
      }
    }
  }
  return addresses;
}

}  // namespace ridgeline
