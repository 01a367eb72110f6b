// SPDX-License-Identifier: Apache-2.0
#include "base/atomic_file.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>

#include "base/error.h"
#include "base/limits.h"
#include "base/regular_file.h"

namespace ridgeline {

namespace fs = std::filesystem;

namespace {

// Temporaries handed out and not committed yet.
struct Pending {
  std::mutex mutex;
  std::set<fs::path> paths;
};

// Never destroyed: the thread that waits for Ctrl-C may outlive main().
Pending& PendingTemporaries() {
  static Pending* const pending = new Pending;
  return *pending;
}

void Forget(const fs::path& temporary) {
  Pending& pending = PendingTemporaries();
  const std::lock_guard lock(pending.mutex);
  pending.paths.erase(temporary);
}

void Drop(const fs::path& temporary) {
  std::error_code ignored;
  fs::remove_all(temporary, ignored);
  Forget(temporary);
}

// A finished temporary of a file.
fs::path WrittenBeside(const fs::path& path, std::string_view content) {
  const fs::path temporary = TemporaryBeside(path);
  std::ofstream stream(temporary, std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) {
    Drop(temporary);
    throw InputError(path.string(), "", "a failed write", "space and permission to write");
  }
  return temporary;
}

}  // namespace

fs::path TemporaryBeside(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError(path.string(), "", "no folder " + folder.string(), "an existing folder");
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw InputError(path.string(), "", "a folder that cannot be written", "write permission");
  }
  static std::atomic<unsigned> counter{0};
  fs::path temporary =
      folder / ("." + path.stem().string() + ".part-" + std::to_string(::getpid()) + "-" +
                std::to_string(counter++) + path.extension().string());
  Pending& pending = PendingTemporaries();
  const std::lock_guard lock(pending.mutex);
  pending.paths.insert(temporary);
  return temporary;
}

void CommitFile(const fs::path& temporary, const fs::path& path) {
  std::error_code error;
  fs::rename(temporary, path, error);
  Forget(temporary);
  if (!error) return;
  std::error_code ignored;
  fs::remove_all(temporary, ignored);
  throw InputError(path.string(), "", error.message(), "a file that can be replaced");
}

void RemoveTemporaries() noexcept {
  Pending& pending = PendingTemporaries();
  const std::lock_guard lock(pending.mutex);
  for (const fs::path& path : pending.paths) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  pending.paths.clear();
}

void WriteFileAtomically(const fs::path& path, std::string_view content) {
  CommitFile(WrittenBeside(path, content), path);
}

void WriteFilesAtomically(const std::vector<std::pair<fs::path, std::string>>& files) {
  std::vector<fs::path> temporaries;
  try {
    for (const auto& [path, content] : files) temporaries.push_back(WrittenBeside(path, content));
  } catch (...) {
    for (const fs::path& temporary : temporaries) Drop(temporary);
    throw;
  }
  for (std::size_t i = 0; i < files.size(); ++i) CommitFile(temporaries[i], files[i].first);
}

std::string ReadFile(const fs::path& path) {
  RequireRegularFile(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string(), "", "no readable file", "read permission");
  std::string content;
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  std::error_code error;
  if (const std::uintmax_t size = fs::file_size(path, error); !error) {
    content.reserve(std::min<std::uintmax_t>(size, limits::kFileBytes) + kChunk);
  }
  while (stream) {
    const std::size_t old_size = content.size();
    content.resize(old_size + kChunk);
    stream.read(content.data() + old_size, kChunk);
    content.resize(old_size + static_cast<std::size_t>(stream.gcount()));
    if (content.size() > limits::kFileBytes) {
      throw InputError(
          path.string(),
          "limit",
          "a file of more than " + std::to_string(limits::kFileBytes / 1'000'000) + " MB",
          "a smaller one, or several");
    }
  }
  if (stream.bad())
    throw InputError(path.string(), "", "a file that cannot be read", "a whole one");
  return content;
}

}  // namespace ridgeline
